#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

namespace palpa::bem {

/// Closed surface of flat triangles, the geometry of boundary elements. Orientation: the corners
/// run counter-clockwise seen from outside. Hollow bodies have several closed components, of which
/// the inner ones are also oriented away from the material.
struct BoundaryMesh {
  std::vector<Eigen::Vector3d> nodes;         ///< positions, mm
  std::vector<std::array<int, 3>> triangles;  ///< node indices
  /// Per triangle: triangles of one group meet smoothly, so the traction is continuous across their
  /// common edges; across the border of two groups (a sharp edge) it may jump.
  std::vector<int> smoothingGroups;
  /// Per triangle: part of the surface with one kind of boundary condition; 0 by default. The
  /// traction may also jump where two parts meet, for instance at the border of a support.
  std::vector<int> tags;

  int nodeCount() const { return static_cast<int>(nodes.size()); }
  int triangleCount() const { return static_cast<int>(triangles.size()); }

  /// Area vector of a triangle: outward normal times area, mm^2.
  Eigen::Vector3d areaVector(int triangle) const;
  double area(int triangle) const { return areaVector(triangle).norm(); }
  Eigen::Vector3d normal(int triangle) const { return areaVector(triangle).normalized(); }
  /// Point with barycentric coordinates `weights` in a triangle.
  Eigen::Vector3d point(int triangle, const Eigen::Vector3d& weights) const;

  double surfaceArea() const;     ///< mm^2
  double volume() const;          ///< mm^3, positive for outward orientation
  double boundingSize() const;    ///< diagonal of the bounding box, mm
  double meanEdgeLength() const;  ///< mm

  /// Throws SolverError (kBadMesh) if sizes differ, an index is out of range, a number is not
  /// finite, a triangle has no area, an edge is not used exactly once in each direction, or the
  /// enclosed volume is not positive.
  void validate() const;
};

/// Coefficients of the traction field: one slot per (node, smoothing group, tag). Ordered by node,
/// then group, then tag.
struct TractionSlots {
  struct Slot {
    int node;
    int smoothingGroup;
    int tag;
    Eigen::Vector3d
        normal;  ///< unit mean normal of the slot's triangles at the node, weighted by angle
  };
  std::vector<Slot> slots;
  std::vector<std::array<int, 3>> ofCorner;  ///< per triangle: slot of each corner
  std::vector<int> firstOfNode;  ///< slots of node k are firstOfNode[k] … firstOfNode[k+1]-1

  TractionSlots() = default;
  explicit TractionSlots(const BoundaryMesh& mesh);
  int count() const { return static_cast<int>(slots.size()); }
};

/// Area that a nodal traction acts on, mm^2: the force of a traction p at one node (linear basis)
/// is p times this.
double nodalArea(const BoundaryMesh& mesh, int node);

}  // namespace palpa::bem
