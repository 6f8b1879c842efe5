#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include "bem/spline/bspline_basis.h"

namespace palpa::bem {

/// One tensor-product B-spline patch. Its control points are indices into the surface's list;
/// patches share those on their common edges, so fields are continuous across.
struct SplinePatch {
  std::array<BsplineBasis, 2> basis;  ///< along u and v
  std::vector<int> net;               ///< point of (i, j) at i + j basis[0].count()
  /// Patches of one group meet smoothly: the traction is continuous across their common edges.
  int smoothingGroup = 0;
};

/// A rectangle between knots of a patch. Tags as in BoundaryMesh.
struct SplineElement {
  int patch;
  std::array<int, 2> span;
  std::array<double, 2> lower, upper;  ///< parameters
  int tag = 0;
};

/// A place on the surface by its parameters.
struct SplinePlace {
  int element;
  double u, v;
};

/// Position and first derivatives, mm per unit of the parameters.
struct SplineJet {
  Eigen::Vector3d position, du, dv;
  /// Outward; its length is the area per unit of the parameters.
  Eigen::Vector3d areaVector() const { return du.cross(dv); }
};

/// A closed surface of B-spline patches with outward normals du × dv: geometry and basis of the
/// spline discretisation. The control points are the places of the displacement coefficients: the
/// displaced body is the surface with points P_j + u_j. Const use from several threads is safe.
class SplineSurface {
 public:
  /// The caller vouches that the surface is closed and oriented (modeling::Solid is); throws
  /// std::invalid_argument when sizes or indices do not fit.
  SplineSurface(std::vector<Eigen::Vector3d> controlPoints, std::vector<SplinePatch> patches);

  const std::vector<Eigen::Vector3d>& controlPoints() const { return controlPoints_; }
  const std::vector<SplinePatch>& patches() const { return patches_; }
  const std::vector<SplineElement>& elements() const { return elements_; }
  int coefficientCount() const { return static_cast<int>(controlPoints_.size()); }
  int elementCount() const { return static_cast<int>(elements_.size()); }
  double boundingSize() const;  ///< diagonal of the control points' box, mm
  /// Closed pieces of the surface: 1 and one per cavity.
  int closedSurfaceCount() const;

  /// Declares the part of the surface an element belongs to.
  void setTag(int element, int tag) { elements_[element].tag = tag; }
  int smoothingGroup(int element) const {
    return patches_[elements_[element].patch].smoothingGroup;
  }

  /// Indices of an element in its patch, u fastest.
  int elementAt(int patch, int spanU, int spanV) const {
    return firstElement_[patch] +
           spanV * static_cast<int>(patches_[patch].basis[0].spans().size()) + spanU;
  }

  /// Coefficients of the functions that are not zero on an element, (degree u + 1) (degree v + 1),
  /// u fastest. Some appear twice where an edge is collapsed.
  const std::vector<int>& functions(int element) const { return functions_[element]; }
  /// The values of these functions.
  void evaluateBasis(const SplinePlace& place, std::vector<double>& values) const;

  SplineJet evaluate(const SplinePlace& place) const;
  /// Unit outward normal; a little inside the element where the derivatives are parallel.
  Eigen::Vector3d normal(const SplinePlace& place) const;

 private:
  std::vector<Eigen::Vector3d> controlPoints_;
  std::vector<SplinePatch> patches_;
  std::vector<int> firstElement_;
  std::vector<SplineElement> elements_;
  std::vector<std::vector<int>> functions_;
};

}  // namespace palpa::bem
