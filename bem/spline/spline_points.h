#pragma once

#include <array>
#include <vector>

#include "bem/spline/spline_kernel.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Rectangle in the local coordinates of an element.
struct SplineCell {
  std::array<double, 2> lower, upper;
};
inline SplineCell cellOf(const SplineElement& element) {
  return {element.lower, element.upper};
}

/// Quadrature points in local coordinates of an element, with their weights in that plane.
struct SplineRule {
  std::vector<double> u, v, weight;

  void clear();
  void add(double atU, double atV, double ofWeight);
  /// Adds the points of a tensor Gauss rule on a cell, u fastest.
  void addTensor(const SplineCell& cell, int pointsPerDirection);
};

/// Quadrature points on one element with the values of its functions, in the memory layout of
/// spline_kernel.h.
struct SplinePoints {
  int used = 0;                  ///< number of points with a weight
  int count = 0;                 ///< number including padding
  std::vector<double> geometry;  ///< [kPointValues][count]
  /// Points per direction of a tensor rule whose functions are given separately along u and v. 0:
  /// `basis` is a table of their products, [point][stride].
  int perDirection = 0;
  std::vector<double> basis;  ///< of a tensor rule: [point along u][function], then the same for v

  const double* position(int component) const { return at(component); }
  const double* area(int component) const { return at(3 + component); }
  const double* areaSize() const { return at(6); }

 private:
  const double* at(int value) const {
    return geometry.data() + static_cast<std::ptrdiff_t>(value) * count;
  }
};

/// Places quadrature points on the elements of a surface, many at once. Const use from several
/// threads is safe; the surface must outlive it.
class SplinePlacement {
 public:
  explicit SplinePlacement(const SplineSurface& surface);

  const SplineSurface& surface() const { return surface_; }
  /// Number of functions that are nonzero on an element.
  int functionCount(int element) const { return elements_[element].functions; }
  /// Distance between the values of consecutive points in SplinePoints::basis.
  int stride(int element) const { return roundUpToLanes(elements_[element].functions); }
  /// Larger degree of the two directions.
  int degree(int element) const;

  /// Number of functions along u (0) or v (1).
  int functionsAlong(int element, int direction) const {
    return elements_[element].direction[direction].degree + 1;
  }

  /// Places the points of `rule`, with a table of products. On return `rule` holds parameters of
  /// the patch and is padded.
  void place(int element, SplineRule& rule, SplinePoints& points) const;
  /// Places a tensor Gauss rule with at most kSplineLanes points per direction, with separate
  /// functions along u and v unless the element is cut. `rule` is scratch memory.
  void placeTensor(int element, const SplineCell& cell, int pointsPerDirection, SplineRule& rule,
                   SplinePoints& points) const;
  /// Positions and sizes of area vectors only, without the functions.
  void placeGeometry(int element, SplineRule& rule, SplinePoints& points) const {
    place(element, rule, points, false);
  }

 private:
  void place(int element, SplineRule& rule, SplinePoints& points, bool withBasis) const;

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
