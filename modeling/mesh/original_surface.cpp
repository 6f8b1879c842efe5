#include "modeling/mesh/original_surface.h"

#include <array>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {

using Eigen::Vector3d;

OriginalSurface::OriginalSurface(const TaggedSurface& surface) {
  const auto& p = surface.positions;
  std::vector<std::vector<std::array<Vector3d, 3>>> regions;
  std::map<TagPair, std::vector<std::array<Vector3d, 2>>> features;
  const auto neighbours = triangleNeighbours(surface.triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& n = surface.triangles[t];
    const SurfaceTag& tag = surface.tags[t];
    if (static_cast<int>(regions.size()) <= tag.region) regions.resize(tag.region + 1);
    regions[tag.region].push_back({p[n[0]], p[n[1]], p[n[2]]});
    for (int k = 0; k < 3; ++k) {
      const SurfaceTag& other = surface.tags[neighbours[t][k]];
      if (tag < other) features[{tag, other}].push_back({p[n[k]], p[n[(k + 1) % 3]]});
    }
  }
  for (const auto& triangles : regions) regions_.emplace_back(triangles);
  for (const auto& [pair, segments] : features) features_.emplace(pair, segments);
}

Vector3d OriginalSurface::onRegion(int region, const Vector3d& point) const {
  return regions_[region].nearest(point);
}

Vector3d OriginalSurface::onFeature(const SurfaceTag& one, const SurfaceTag& other,
                                    const Vector3d& point) const {
  const auto found = features_.find(one < other ? TagPair{one, other} : TagPair{other, one});
  return found == features_.end() ? point : found->second.nearest(point);
}

}  // namespace palpa::modeling
