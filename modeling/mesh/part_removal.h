#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "modeling/mesh/faced_triangles.h"

namespace palpa::modeling {

/// A part of a closed surface and the closed chains of edges about it.
struct SurfacePart {
  std::vector<int> triangles;
  /// Vertices of each chain in the direction of the part's triangles, each vertex once.
  std::vector<std::vector<int>> loops;
};

/// Removes parts of a closed, oriented, manifold surface one after the other and closes the surface
/// with triangles between the vertices of their chains.
class PartRemoval {
 public:
  /// The flat end of a part gets the face around it, or the part's own if that one is in
  /// `keptFaces`. Both arguments must live as long as this object.
  PartRemoval(const FacedTriangles& surface, const std::set<int>& keptFaces);

  /// The part must not share triangles with another one. False, without a change, if the surface
  /// would not stay manifold.
  bool remove(const SurfacePart& part);

  FacedTriangles result() const;

 private:
  using Triangle = std::array<int, 3>;

  int faceAround(const std::vector<int>& loop) const;
  int faceAt(int from, int to) const;

  const FacedTriangles& surface_;
  const std::set<int>& keptFaces_;
  std::vector<bool> isGone_;
  std::map<std::pair<int, int>, int> triangleAt_;  ///< by directed edge; kEnd: of an end
  std::vector<Triangle> ends_;
  std::vector<int> facesOfEnds_;
};

}  // namespace palpa::modeling
