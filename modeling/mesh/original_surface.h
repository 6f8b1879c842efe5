#pragma once

#include <map>
#include <utility>
#include <vector>

#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Original surface of a mesh, for projecting nodes back onto it. Smooth regions are searched
/// separately, so that nodes do not jump through thin walls or over edges, and so are the feature
/// lines between two tags. Immutable.
class OriginalSurface {
 public:
  explicit OriginalSurface(const TaggedSurface& surface);

  /// Nearest point on a smooth region.
  Eigen::Vector3d onRegion(int region, const Eigen::Vector3d& point) const;
  /// Nearest point on the features between two tags.
  Eigen::Vector3d onFeature(const SurfaceTag& one, const SurfaceTag& other,
                            const Eigen::Vector3d& point) const;

 private:
  using TagPair = std::pair<SurfaceTag, SurfaceTag>;
  std::vector<NearestOnTriangles> regions_;
  std::map<TagPair, NearestOnSegments> features_;
};

}  // namespace palpa::modeling
