#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "modeling/mesh/mesh_focus.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/size_field.h"
#include "modeling/mesh/small_features.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Mean edge length after remeshing, of the length in a size field.
inline constexpr double kMeanEdge = 0.93;

/// What a mesh of a mesh body is made from.
struct MeshBodySurface {
  explicit MeshBodySurface(double edgeLength) : sizes(edgeLength / kMeanEdge) {}

  SimplifiedSurface simplified;
  double below = 0;  ///< mm, the smallest size of features away from strokes and foci; 0: all kept
  double partsBelow = 0;  ///< mm, the same of pins and holes
  /// The simplified surface, cut at the borders of all regions. Only faces named in a region have
  /// their number in the tags, all others have kOtherFace: the mesh need not follow their borders.
  TaggedSurface surface;
  SizeField sizes;    ///< wanted edge lengths over kMeanEdge
  LengthAt smallest;  ///< the shortest edges wanted anywhere
  /// Number of nodes of the mesh that was made from this surface; 0 before.
  mutable std::atomic<std::size_t> meshedNodes = 0;
};

inline constexpr int kOtherFace = -1;

/// Which features of a mesh body its mesh leaves out.
struct LeftOutFeatures {
  double below = 0;  ///< of the edge length there; 0: none
  ThinPlaces thin = ThinPlaces::kRemoved;
  bool operator==(const LeftOutFeatures&) const = default;
};

/// The surface of a mesh body for a mesh with these settings, without the features `leftOut`. The
/// last results are kept, so that a mesh after its estimate costs no more. Settings must be valid.
/// Throws ModelingError as distinctBorders(); Cancelled.
std::shared_ptr<const MeshBodySurface> meshBodySurface(
    const MeshBody& body, const MeshSettings& settings, std::span<const MeshRegion> regions,
    std::span<const MeshFocus> foci, const LeftOutFeatures& leftOut, const Job& job = {});

/// Expected number of nodes of a mesh with the sizes on the surface.
double expectedNodes(const TaggedSurface& surface, const SizeField& sizes);

}  // namespace palpa::modeling
