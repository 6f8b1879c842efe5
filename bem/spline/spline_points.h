#pragma once
#include <array>
#include <vector>

#include "bem/spline/spline_kernel.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// A rectangle in an element, in its local coordinates.
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

/// Quadrature points on one element with the values of its functions, in the layout of
/// spline_kernel.h.
struct SplinePoints {
  int used = 0;   ///< that have a weight
  int count = 0;  ///< with those that fill up
  std::array<std::vector<double>, 3> position, area;
  std::vector<double> areaSize, basis;
};

/// Places quadrature points on the elements of a surface, many at once. Const use from several
/// threads is safe; the surface must outlive it.
class SplinePlacement {
 public:
  explicit SplinePlacement(const SplineSurface& surface);

  const SplineSurface& surface() const { return surface_; }
  /// Of functions that are not zero on an element.
  int functionCount(int element) const { return elements_[element].functions; }
  /// Between the values of one point and the next in SplinePoints::basis.
  int stride(int element) const { return roundUpToLanes(elements_[element].functions); }
  /// The larger of both directions.
  int degree(int element) const;

  /// `rule` is left as parameters of the patch and filled up.
  void place(int element, SplineRule& rule, SplinePoints& points) const;

 private:
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
