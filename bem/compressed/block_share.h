#pragma once

#include <cstddef>

#include "bem/base/team.h"

namespace palpa::bem {

/// The share of a team's member in the blocks of compressed operators. All positions of the cluster
/// tree are divided evenly among the members; the blocks of a cluster belong to the members in
/// whose parts it lies, in turn. The operators are the sum of all shares.
class BlockShare {
 public:
  /// Null: everything.
  explicit BlockShare(const Team* team)
      : index_(team ? team->index() : 0), count_(team ? team->count() : 1) {}
  BlockShare(int index, int count) : index_(index), count_(count) {}

  bool isWhole() const { return count_ == 1; }
  /// True if block `block` of a cluster of points is in the share.
  bool hasBlock(int cluster, std::size_t block) const;
  /// True if what belongs to single rows of a leaf is in the share.
  bool hasRows(int leaf) const { return hasBlock(leaf, 0); }

 private:
  int index_, count_;
};

}  // namespace palpa::bem
