#include "modeling/mesh/size_field.h"

#include <algorithm>
#include <cmath>

#include "modeling/mesh/mesh_refine.h"

namespace palpa::modeling {

void SizeField::addSource(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double length) {
  constexpr double kMaxLevels = 20.0;
  constexpr double kSlack = 1e-6;
  if (!(length < largest_ * (1.0 - kSlack))) return;
  const double level = std::ceil(2.0 * std::log2(largest_ / length) - kSlack);
  Level& at = levels_[static_cast<int>(std::clamp(level, 1.0, kMaxLevels))];
  at.segments.push_back({a, b});
  at.changed = true;
}

void SizeField::update() {
  for (auto& [k, level] : levels_)
    if (level.changed) {
      level.nearest = NearestOnSegments(level.segments);
      level.changed = false;
    }
}

double SizeField::at(const Eigen::Vector3d& point) const {
  double size = largest_;
  for (const auto& [k, level] : levels_) {
    const double own = largest_ * std::exp2(-0.5 * k);
    if (own < size) size = std::min(size, own + kSizeGrowth * level.nearest.distance(point));
  }
  return size;
}

}  // namespace palpa::modeling
