#pragma once

#include <map>

#include "modeling/mesh/nearest_point.h"

namespace palpa::modeling {

/// Wanted edge length at a place (mm): that of the nearest sources plus kSizeGrowth times the
/// distance from them, at most `largest`.
class SizeField {
 public:
  explicit SizeField(double largest) : largest_(largest) {}

  /// A line segment along which edges shall have this length. Lengths are rounded down to
  /// largest / 2^(k/2) and not below largest / 2^10; without effect from `largest` on.
  void addSource(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double length);
  /// Makes the sources added so far count.
  void update();

  double largest() const { return largest_; }
  double at(const Eigen::Vector3d& point) const;

 private:
  struct Level {
    std::vector<std::array<Eigen::Vector3d, 2>> segments;
    NearestOnSegments nearest{{}};
    bool changed = false;
  };
  double largest_;
  std::map<int, Level> levels_;  // by k
};

}  // namespace palpa::modeling
