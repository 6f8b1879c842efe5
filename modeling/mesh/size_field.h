#pragma once

#include <map>

#include "modeling/mesh/nearest_point.h"

namespace palpa::modeling {

/// Field of the wanted edge length (mm): the smallest sum, over all sources, of the edge length of
/// the source and kSizeGrowth times the distance from it; at most `largest`.
class SizeField {
 public:
  explicit SizeField(double largest) : largest_(largest) {}

  /// Adds a line segment with the wanted edge length (mm) along it. The length is rounded down to
  /// largest / 2^(k/2), but not below largest / 2^10. A source with at least `largest` has no
  /// effect.
  void addSource(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double length);
  /// Must be called after addSource(), before at(): includes the new sources.
  void update();

  double largest() const { return largest_; }
  /// True if there are no sources.
  bool isUniform() const { return levels_.empty(); }
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
