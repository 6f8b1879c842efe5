#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace palpa::modeling {

/// Face, smooth region and half spaces of a triangle of a mesh body. Edges between triangles with
/// different tags are *features*: sharp edges, borders of faces, borders of half spaces. The mesh
/// preserves them.
struct SurfaceTag {
  int face = 0;             ///< of the body
  int region = 0;           ///< smooth region: a part between sharp edges
  std::uint64_t sides = 0;  ///< bit k: lies in half space k

  auto operator<=>(const SurfaceTag&) const = default;
};

/// A closed, oriented, manifold triangle surface with a tag per triangle.
struct TaggedSurface {
  std::vector<Eigen::Vector3d> positions;  ///< mm
  std::vector<std::array<int, 3>> triangles;
  std::vector<SurfaceTag> tags;
};

}  // namespace palpa::modeling
