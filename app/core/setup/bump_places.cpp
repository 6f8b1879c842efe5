#include "app/core/setup/bump_places.h"

namespace palpa::app {

std::vector<BumpPlace> placesUnder(const modeling::SurfaceEvaluator& surface,
                                   const Eigen::Vector3d& center, double radius) {
  constexpr int kSamples = 24;
  std::vector<BumpPlace> places;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int j = 0; j <= kSamples; ++j)
      for (int i = 0; i <= kSamples; ++i) {
        const auto [u0, u1] = surface.range(patch, 0);
        const auto [v0, v1] = surface.range(patch, 1);
        const double u = u0 + (u1 - u0) * i / kSamples, v = v0 + (v1 - v0) * j / kSamples;
        if ((surface.position(patch, u, v) - center).norm() < 0.5 * radius)
          places.push_back({patch, {u, v}, radius});
      }
  return places;
}

}  // namespace palpa::app
