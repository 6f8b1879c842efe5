#pragma once

#include <vector>

#include "bem/compressed/compressed_order.h"
#include "bem/linalg/row_choice.h"

namespace palpa::bem {

/// Block columns of x, 3 rows of each, that are not zero: few for the load of a single mask.
class LoadedColumns {
 public:
  /// `order` must outlive this object.
  LoadedColumns(const CompressedOrder& order, const RowMatrixXf& x);

  /// True if any of a cluster is loaded.
  bool reaches(int cluster) const {
    const auto& c = tree_.cluster(cluster);
    return before_[c.begin] < before_[c.end];
  }
  /// If it pays to ask for single columns: 0 for each one that is zero; otherwise null.
  const char* few() const {
    const bool areFew = 4 * static_cast<std::size_t>(before_.back()) < before_.size();
    return areFew ? isLoaded_.data() : nullptr;
  }

 private:
  const ClusterTree& tree_;
  std::vector<char> isLoaded_;
  std::vector<int> before_{0};  // positions of nodes with loaded columns before each
};

}  // namespace palpa::bem
