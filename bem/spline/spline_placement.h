#pragma once

#include <array>
#include <vector>

#include "bem/element/element_points.h"
#include "bem/spline/spline_kernel.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Rectangle in the local coordinates of an element.
struct SplineCell {
  std::array<double, 2> lower, upper;

  std::array<SplineCell, 2> halves(int direction) const;
  /// True if a place of the element lies in the cell or on its border.
  bool contains(const ElementPlace& place) const;
};
inline SplineCell cellOf(const SplineElement& element) {
  return {element.lower, element.upper};
}

/// Adds the points of a tensor Gauss rule on a cell, u fastest.
void addTensor(const SplineCell& cell, int pointsPerDirection, ElementRule& rule);

/// Places quadrature points on the elements of a surface, many at once. Const use from several
/// threads is safe; the surface must outlive it.
class SplinePlacement {
 public:
  explicit SplinePlacement(const SplineSurface& surface);

  const SplineSurface& surface() const { return surface_; }
  /// Number of functions in the tables of an element: of its net, or as BorderFunctions say.
  int functionCount(int element) const { return elements_[element].functions; }
  /// Distance between the values of consecutive points in ElementPoints::basis.
  int stride(int element) const { return roundUpToLanes(elements_[element].functions); }
  /// Larger degree of the two directions.
  int degree(int element) const;

  /// Number of functions along u (0) or v (1).
  int functionsAlong(int element, int direction) const {
    return elements_[element].direction[direction].degree + 1;
  }

  /// Places the points of `rule`, with a table of products. On return `rule` holds parameters of
  /// the patch and is padded.
  void place(int element, ElementRule& rule, ElementPoints& points) const;
  /// Places a tensor Gauss rule with at most kElementLanes points per direction, with separate
  /// functions along u and v unless the element is cut or weighted. `rule` is scratch memory.
  void placeTensor(int element, const SplineCell& cell, int pointsPerDirection, ElementRule& rule,
                   ElementPoints& points) const;
  /// Positions and sizes of area vectors only, without the functions.
  void placeGeometry(int element, ElementRule& rule, ElementPoints& points) const {
    place(element, rule, points, false);
  }

 private:
  void place(int element, ElementRule& rule, ElementPoints& points, bool withBasis) const;
  static void applyWeights(const BorderFunctions& functions, ElementPoints& points, bool withBasis);

  struct Element {
    SpanPolynomials direction[2];
    std::vector<double> controlPoints;
    int functions;
  };
  const SplineSurface& surface_;
  SplineKernel kernel_;
  std::vector<Element> elements_;
};

}  // namespace palpa::bem
