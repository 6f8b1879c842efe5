#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <set>
#include <vector>

#include "base/byte_stream.h"
#include "bem/element/element_surface.h"
#include "bem/spline/border_functions.h"
#include "bem/spline/bspline_basis.h"
#include "bem/spline/cut_map.h"

namespace palpa::bem {

/// Tensor-product B-spline patch. Its control points are indices into the list of the surface;
/// patches share the points on common edges, so fields are continuous across them.
struct SplinePatch {
  std::array<BsplineBasis, 2> basis;  ///< along u and v
  std::vector<int> net;               ///< point of (i, j) at i + j basis[0].count()
  /// Patches of one group join smoothly: the traction is continuous across their common edges.
  int smoothingGroup = 0;

  bool operator==(const SplinePatch&) const = default;
};

/// Knot rectangle of a patch, or a piece of one bounded by the border of a part. Tags as in
/// BoundaryMesh.
struct SplineElement {
  int patch;
  std::array<int, 2> span;
  std::array<double, 2> lower, upper;  ///< in patch parameters, or in CutMap coordinates
  int tag = 0;
  int cut = -1;  ///< index of the CutMap; -1: none
};

/// Closed surface of B-spline patches with outward normals du × dv: geometry and basis of the
/// spline discretisation. Control point P_j is the position of displacement coefficient u_j: the
/// displaced body is the surface with points P_j + u_j. Const use from several threads is safe.
class SplineSurface {
 public:
  /// Surface with the given control points, mm. The caller must ensure that the surface is closed
  /// and oriented (modeling::Solid is). Throws std::invalid_argument if sizes or indices do not
  /// fit.
  SplineSurface(std::vector<Eigen::Vector3d> controlPoints, std::vector<SplinePatch> patches);

  const std::vector<Eigen::Vector3d>& controlPoints() const { return controlPoints_; }
  const std::vector<SplinePatch>& patches() const { return patches_; }
  const std::vector<SplineElement>& elements() const { return elements_; }
  int coefficientCount() const { return static_cast<int>(controlPoints_.size()); }
  int elementCount() const { return static_cast<int>(elements_.size()); }
  double boundingSize() const;  ///< diagonal of the bounding box of the control points, mm
  /// Number of closed pieces of the surface: 1 plus one per cavity.
  int closedSurfaceCount() const;

  /// Assigns an element to the part of the surface with the given tag.
  void setTag(int element, int tag) { elements_[element].tag = tag; }
  int smoothingGroup(int element) const {
    return patches_[elements_[element].patch].smoothingGroup;
  }

  /// Elements of the knot rectangle (spanU, spanV) of a patch: one, or the pieces of a cut one.
  const std::vector<int>& elementsAt(int patch, int spanU, int spanV) const {
    return elementsOfCell_[firstCell_[patch] +
                           spanV * static_cast<int>(patches_[patch].basis[0].spans().size()) +
                           spanU];
  }
  /// Place in an element of the parameters (u, v) of its patch; none if they lie outside the
  /// element.
  std::optional<ElementPlace> placeIn(int element, double u, double v) const;
  /// Parameters of a place, and their derivatives with respect to the local coordinates.
  CutMap::Image parameters(const ElementPlace& place) const;
  bool isCut(int element) const { return elements_[element].cut >= 0; }

  /// Replaces an element by its pieces. A piece without a map is given in the local coordinates of
  /// the element, a piece with a map by the map into them. The first piece takes the index of the
  /// element.
  void replaceElement(int element, const std::vector<SplineElement>& pieces,
                      const std::vector<std::optional<CutMap>>& maps);
  /// Tears a function: gives it a second coefficient on the elements whose flag is set, one flag
  /// per element. Returns the new coefficient.
  int tear(int coefficient, const std::vector<bool>& elements);
  /// Coefficient of the control net that corresponds to `coefficient`: itself, or the coefficient
  /// it was torn from.
  int tornFrom(int coefficient) const { return tornFrom_[coefficient]; }
  /// True if the border of a part separates the coefficient's function into two sides.
  bool isTorn(int coefficient) const { return isTorn_[coefficient]; }
  /// Marks a function whose share of the part with tag `tag`, on the faces of smoothing group
  /// `group`, is so small that the part is ignored for it.
  void setBarelyReaches(int coefficient, int tag, int group) {
    barelyReaches_.insert({coefficient, tag, group});
  }
  bool barelyReaches(int coefficient, int tag, int group) const {
    return barelyReaches_.contains({coefficient, tag, group});
  }

  /// Control points of an element, (degree u + 1) (degree v + 1), u fastest. Where an edge is
  /// collapsed, some appear twice. Torn functions have the points of their coefficients.
  const std::vector<int>& net(int element) const {
    return borderFunctions(element) ? borderNet_[bordersOf_[element]] : functions_[element];
  }
  /// Coefficients of the functions that are nonzero on an element: its net's, except beside
  /// a border with borderFunctions().
  const std::vector<int>& functions(int element) const { return functions_[element]; }
  /// Functions beside the border of a support; null elsewhere.
  const BorderFunctions* borderFunctions(int element) const {
    return bordersOf_[element] < 0 ? nullptr : &borderFunctions_[bordersOf_[element]];
  }
  /// True if the sums of an element's functions come from a table (BorderFunctions) with
  /// weights.
  bool isWeighted(int element) const {
    const BorderFunctions* functions = borderFunctions(element);
    return functions && functions->isWeighted;
  }
  /// Values of the functions at a place.
  void evaluateBasis(const ElementPlace& place, std::vector<double>& values) const;
  /// Values at the patch parameters, also outside the element: its polynomials are extrapolated.
  void evaluateBasis(int element, const Eigen::Vector2d& parameters,
                     std::vector<double>& values) const;
  /// Values, and derivatives with respect to the patch parameters.
  struct BasisJet {
    std::vector<double> values, du, dv;
  };
  void evaluateBasis(int element, const Eigen::Vector2d& parameters, BasisJet& jet) const;
  void evaluateNet(int element, const Eigen::Vector2d& parameters, BasisJet& jet) const;
  /// Values of the B-splines of the element's net at the patch parameters.
  void evaluateNet(int element, const Eigen::Vector2d& parameters,
                   std::vector<double>& values) const;
  /// Values of the functions that carry the tractions. In supports beside borders, where these are
  /// unbounded, weights below `leastWeight` are replaced by it.
  void evaluateTractionBasis(int element, const Eigen::Vector2d& parameters, double leastWeight,
                             std::vector<double>& values) const;
  void evaluateTractionBasis(const ElementPlace& place, std::vector<double>& values) const {
    evaluateTractionBasis(place.element, parameters(place).parameters, 0, values);
  }
  /// Positive shares of the functions in a mean value around each coefficient; they sum to 1.
  /// Beside a border only functions that belong to the element's side have one.
  void evaluateShares(const ElementPlace& place, std::vector<double>& shares) const;
  /// Position of the surface at parameters of the element's patch, mm.
  Eigen::Vector3d positionAt(int element, const Eigen::Vector2d& parameters) const;

  /// Side of borders on which an element lies: kFree, kFixedPatch or the index of a cutBorders().
  static constexpr int kFree = -1, kFixedPatch = -2;
  int side(int element) const { return sides_[element]; }
  void setSide(int element, int side) { sides_[element] = side; }
  /// Side to which the function of a coefficient belongs; empty without cutBorders().
  const std::vector<int>& owners() const { return owners_; }
  const std::vector<CutBorder>& cutBorders() const { return *cutBorders_; }
  /// Replaces all functions beside borders. `functions`: per element; none: the net's.
  struct ElementFunctions {
    std::vector<int> coefficients;
    BorderFunctions functions;
  };
  void setBorders(std::vector<CutBorder> borders, std::vector<int> owners,
                  std::vector<std::optional<ElementFunctions>> functions);

  SurfaceJet evaluate(const ElementPlace& place) const;
  /// Unit outward normal; evaluated slightly inside the element where the derivatives are parallel.
  Eigen::Vector3d normal(const ElementPlace& place) const;

  /// Elements whose geometry differs in any bit from `before`, the same surface with other control
  /// points; none if patches, knots, elements, tags or torn functions differ.
  std::optional<std::vector<int>> movedElements(const SplineSurface& before) const;

  /// Writes all data byte by byte, for a hash.
  void write(const ByteSink& sink) const;

 private:
  Eigen::Vector3d sumOfNet(int element, const std::vector<double>& values) const;

  std::vector<Eigen::Vector3d> controlPoints_;
  std::vector<SplinePatch> patches_;
  std::vector<int> firstCell_;
  std::vector<std::vector<int>> elementsOfCell_;
  std::vector<SplineElement> elements_;
  /// `inside`: the cut whose coordinates contain this one, if the piece was cut before; -1 for the
  /// coordinates of the patch.
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
  std::vector<int> sides_;
  std::vector<int> owners_;
  std::shared_ptr<const std::vector<CutBorder>> cutBorders_;
  std::vector<int> bordersOf_;  ///< per element: index into the next two; -1: none
  std::vector<BorderFunctions> borderFunctions_;
  std::vector<std::vector<int>> borderNet_;
};

}  // namespace palpa::bem
