#pragma once

#include <map>
#include <memory>

#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/size_field.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// The surface that a mesh is made of, for putting nodes back onto it: each smooth region by itself
/// (so that nodes do not jump through thin walls or over edges), and each feature line between two
/// tags. Immutable.
class OriginalSurface {
 public:
  explicit OriginalSurface(const TaggedSurface& surface);

  Eigen::Vector3d onRegion(int region, const Eigen::Vector3d& point) const;
  /// On the features between these two tags.
  Eigen::Vector3d onFeature(const SurfaceTag& one, const SurfaceTag& other,
                            const Eigen::Vector3d& point) const;

 private:
  using TagPair = std::pair<SurfaceTag, SurfaceTag>;
  std::vector<NearestOnTriangles> regions_;
  std::map<TagPair, NearestOnSegments> features_;
};

/// Local changes of a tagged surface: split, collapse, flip, relax. Feature edges are neither
/// destroyed nor left by their nodes. Corners are nodes where features meet, end or turn.
class SurfaceEditor {
 public:
  SurfaceEditor(const TaggedSurface& surface, const OriginalSurface& original,
                const SizeField& sizes);

  /// The surface without the gaps that collapses leave.
  TaggedSurface result() const;

  int nodeCount() const { return static_cast<int>(positions_.size()); }
  int triangleCount() const { return static_cast<int>(triangles_.size()); }
  bool isAlive(int triangle) const { return triangles_[triangle][0] >= 0; }
  const std::array<int, 3>& triangle(int t) const { return triangles_[t]; }
  const Eigen::Vector3d& position(int node) const { return positions_[node]; }

  /// The triangle left of the directed edge a → b; -1 when there is none.
  int leftOf(int a, int b) const;
  bool isFeature(int a, int b) const;
  /// Tags of the triangles left and right of a → b.
  std::pair<SurfaceTag, SurfaceTag> tagsBeside(int a, int b) const {
    return {tags_[leftOf(a, b)], tags_[leftOf(b, a)]};
  }
  double length(int a, int b) const { return (positions_[a] - positions_[b]).norm(); }
  /// Length of the edge a–b over that wanted there.
  double relativeLength(int a, int b) const;
  /// Cosine of the smallest angle of a triangle.
  double smallestAngleCosine(int triangle) const;
  /// Neighbours over edges of any kind, and over feature edges only; ascending.
  std::vector<int> neighbours(int node) const;
  std::vector<int> featureNeighbours(int node) const;
  bool isCorner(int node) const { return corner_[node]; }
  bool isUsed(int node) const { return !around_[node].empty(); }
  /// Distance of the middle of the edge a–b from the original surface or feature line.
  double sag(int a, int b) const;
  /// Asks the size field again, after it has changed.
  void updateSizes();

  void split(int a, int b);
  /// Each returns whether it changed the mesh; it does not when a triangle would turn over, a
  /// feature or corner be lost, or nothing be gained.
  bool collapse(int from, int to);
  bool flip(int a, int b);
  bool relax(int node);

 private:
  Eigen::Vector3d normal(const std::array<int, 3>& triangle) const;
  Eigen::Vector3d normalWith(const std::array<int, 3>& triangle, int node,
                             const Eigen::Vector3d& there) const;
  Eigen::Vector3d onOriginal(int a, int b, const Eigen::Vector3d& point) const;
  bool isFlat(int node) const;
  bool wouldSag(int from, int to, int other) const;
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
