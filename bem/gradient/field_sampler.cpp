#include "bem/gradient/field_sampler.h"

#include <utility>

namespace palpa::bem {

void FieldSampler::add(Block block) {
  blocks_.push_back({pointCount(), static_cast<int>(block.points.size()),
                     std::move(block.coefficients), std::move(block.slots),
                     std::move(block.displacement), std::move(block.traction)});
  points_.insert(points_.end(), block.points.begin(), block.points.end());
}

double FieldSampler::area() const {
  double sum = 0;
  for (const SampledPoint& point : points_) sum += point.weight;
  return sum;
}

}  // namespace palpa::bem
