#pragma once

#include <array>
#include <vector>

#include "modeling/mesh/original_surface.h"
#include "modeling/mesh/size_field.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Editor of a tagged surface by local operations: split, collapse, flip, relax. Operations
/// preserve feature edges and keep their nodes on them. Corners are nodes where features meet, end
/// or turn; they do not move. `original` and `sizes` must outlive the editor.
class SurfaceEditor {
 public:
  SurfaceEditor(const TaggedSurface& surface, const OriginalSurface& original,
                const SizeField& sizes);

  /// The surface without the removed nodes and triangles.
  TaggedSurface result() const;

  int nodeCount() const { return static_cast<int>(positions_.size()); }
  int triangleCount() const { return static_cast<int>(triangles_.size()); }
  bool isAlive(int triangle) const { return triangles_[triangle][0] >= 0; }
  const std::array<int, 3>& triangle(int t) const { return triangles_[t]; }
  const Eigen::Vector3d& position(int node) const { return positions_[node]; }

  /// The triangle left of the directed edge a → b; -1 if there is none.
  int leftOf(int a, int b) const;
  bool isFeature(int a, int b) const;
  /// Tags of the triangles left and right of a → b.
  std::pair<SurfaceTag, SurfaceTag> tagsBeside(int a, int b) const {
    return {tags_[leftOf(a, b)], tags_[leftOf(b, a)]};
  }
  double length(int a, int b) const { return (positions_[a] - positions_[b]).norm(); }
  /// Length of the edge a–b divided by the wanted edge length there.
  double relativeLength(int a, int b) const;
  /// Cosine of the smallest angle of a triangle.
  double smallestAngleCosine(int triangle) const;
  /// Neighbours over all edges, and over feature edges only; both ascending.
  std::vector<int> neighbours(int node) const;
  std::vector<int> featureNeighbours(int node) const;
  bool isCorner(int node) const { return corner_[node]; }
  bool isUsed(int node) const { return !around_[node].empty(); }
  /// Distance (mm) of the middle of the edge a–b from the original surface or feature line.
  double sag(int a, int b) const;
  /// Evaluates the size field again after a change.
  void updateSizes();

  void split(int a, int b);
  /// The next three return whether they changed the mesh. They do nothing if a triangle would be
  /// inverted, a feature or corner would be lost, or the mesh would not improve.
  bool collapse(int from, int to);
  bool flip(int a, int b);
  bool relax(int node);

 private:
  /// Of the length of an edge: a projection that jumps farther is wrong.
  static constexpr double kFarOff = 0.5;

  Eigen::Vector3d normal(const std::array<int, 3>& triangle) const;
  Eigen::Vector3d normalWith(const std::array<int, 3>& triangle, int node,
                             const Eigen::Vector3d& there) const;
  Eigen::Vector3d onOriginal(int a, int b, const Eigen::Vector3d& point) const;
  bool isFlat(int node) const;
  bool wouldSag(int from, int to, int other) const;
  bool mayCollapse(int from, int to) const;
  bool starStays(int node, const Eigen::Vector3d& there) const;
  double worstAngleCosine(int node) const;
  bool tryMove(int node, const Eigen::Vector3d& there);
  Eigen::Vector3d relaxedInside(int node) const;
  void replace(int triangle, const std::array<int, 3>& nodes);

  const OriginalSurface& original_;
  const SizeField& field_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::array<int, 3>> triangles_;  // first node -1: removed
  std::vector<SurfaceTag> tags_;
  std::vector<double> sizes_;
  std::vector<bool> corner_;
  std::vector<std::vector<int>> around_;  // live triangles around each node
};

}  // namespace palpa::modeling
