#pragma once

#include <cstddef>
#include <vector>

namespace palpa::bem {

/// Processes (or threads) that make one problem together, each a share of it. Functions are
/// collective: all members call the same ones in the same order. Called from one thread of each
/// member.
class Team {
 public:
  using Bytes = std::vector<std::byte>;

  virtual ~Team() = default;
  virtual int index() const = 0;  ///< of this member, 0 … count() - 1
  virtual int count() const = 0;  ///< at least 1

  /// Sends `to[m]` to each member m; returns what each sent to this one.
  virtual std::vector<Bytes> exchange(const std::vector<Bytes>& to) const = 0;
  /// Returns the bytes of all members.
  virtual std::vector<Bytes> gather(const Bytes& own) const = 0;
};

}  // namespace palpa::bem
