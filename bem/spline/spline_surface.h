#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <set>
#include <vector>

#include "base/byte_stream.h"
#include "bem/spline/bspline_basis.h"
#include "bem/spline/cut_map.h"

namespace palpa::bem {

/// One tensor-product B-spline patch. Its control points are indices into the surface's list;
/// patches share those on their common edges, so fields are continuous across.
struct SplinePatch {
  std::array<BsplineBasis, 2> basis;  ///< along u and v
  std::vector<int> net;               ///< point of (i, j) at i + j basis[0].count()
  /// Patches of one group meet smoothly: the traction is continuous across their common edges.
  int smoothingGroup = 0;

  bool operator==(const SplinePatch&) const = default;
};

/// A rectangle between knots of a patch, or a piece of one that the border of a part bounds. Tags
/// as in BoundaryMesh.
struct SplineElement {
  int patch;
  std::array<int, 2> span;
  std::array<double, 2> lower, upper;  ///< local coordinates: parameters, or those of the CutMap
  int tag = 0;
  int cut = -1;  ///< index of the CutMap; -1: none
};

/// A place on the surface by an element and its local coordinates.
struct SplinePlace {
  int element;
  double u, v;
};

/// Position and first derivatives, mm per unit of the local coordinates.
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

  /// The elements between two knots in either direction: one, or the pieces of a cut one.
  const std::vector<int>& elementsAt(int patch, int spanU, int spanV) const {
    return elementsOfCell_[firstCell_[patch] +
                           spanV * static_cast<int>(patches_[patch].basis[0].spans().size()) +
                           spanU];
  }
  /// The place in an element of parameters in its knot rectangle; none when they are not in it.
  std::optional<SplinePlace> placeIn(int element, double u, double v) const;
  /// Parameters of a place, and their derivatives by the local coordinates.
  CutMap::Image parameters(const SplinePlace& place) const;
  bool isCut(int element) const { return elements_[element].cut >= 0; }

  /// Replaces an element by pieces of it, in its local coordinates where they have no map and by
  /// maps into them; the first takes its index.
  void replaceElement(int element, const std::vector<SplineElement>& pieces,
                      const std::vector<std::optional<CutMap>>& maps);
  /// Gives a function another coefficient on some elements, one flag per element; returns it.
  int tear(int coefficient, const std::vector<bool>& elements);
  /// The coefficient of the net that stands for one: itself, or the one it was torn from.
  int tornFrom(int coefficient) const { return tornFrom_[coefficient]; }
  bool isTorn(int coefficient) const { return isTorn_[coefficient]; }
  /// Marks a function that reaches into the part with a tag, on the faces of a smoothing group, by
  /// so little that the part does not count there.
  void setBarelyReaches(int coefficient, int tag, int group) {
    barelyReaches_.insert({coefficient, tag, group});
  }
  bool barelyReaches(int coefficient, int tag, int group) const {
    return barelyReaches_.contains({coefficient, tag, group});
  }

  /// Coefficients of the functions that are not zero on an element, (degree u + 1) (degree v + 1),
  /// u fastest. Some appear twice where an edge is collapsed.
  const std::vector<int>& functions(int element) const { return functions_[element]; }
  /// The values of these functions.
  void evaluateBasis(const SplinePlace& place, std::vector<double>& values) const;
  /// The same by parameters of the patch, also outside of the element: its polynomials go on.
  void evaluateBasis(int element, const Eigen::Vector2d& parameters,
                     std::vector<double>& values) const;
  /// Values, and derivatives by the parameters of the patch.
  struct BasisJet {
    std::vector<double> values, du, dv;
  };
  void evaluateBasis(int element, const Eigen::Vector2d& parameters, BasisJet& jet) const;

  SplineJet evaluate(const SplinePlace& place) const;
  /// Unit outward normal; a little inside the element where the derivatives are parallel.
  Eigen::Vector3d normal(const SplinePlace& place) const;

  /// The elements whose geometry differs in any bit from that of the same surface with other
  /// control points; none at all when patches, knots, elements, tags or tears differ.
  std::optional<std::vector<int>> movedElements(const SplineSurface& before) const;

  /// All of it, byte by byte, for a hash.
  void write(const ByteSink& sink) const;

 private:
  std::vector<Eigen::Vector3d> controlPoints_;
  std::vector<SplinePatch> patches_;
  std::vector<int> firstCell_;
  std::vector<std::vector<int>> elementsOfCell_;
  std::vector<SplineElement> elements_;
  /// Inside the coordinates of another cut when the piece was cut before; -1: of the patch.
  struct Cut {
    CutMap map;
    int inside;
  };
  bool isSameCut(int cut, const SplineSurface& other, int otherCut) const;
  std::optional<Eigen::Vector2d> invert(int cut, double u, double v, double slack) const;

  std::vector<Cut> cuts_;
  std::vector<int> tornFrom_;
  std::vector<bool> isTorn_;
  std::set<std::array<int, 3>> barelyReaches_;  ///< coefficient, tag, smoothing group
  std::vector<std::vector<int>> functions_;
};

}  // namespace palpa::bem
