#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/element/kelvin_sums.h"

namespace palpa::bem {

/// Quadrature points in local coordinates of an element, with their weights in that plane.
struct ElementRule {
  std::vector<double> u, v, weight;

  void clear();
  void add(double atU, double atV, double ofWeight);
  /// Adds points of weight zero until their number is a multiple of kElementLanes; returns it.
  int pad();
};

/// Quadrature points on one element with the values of its functions, in the memory layout of
/// kelvin_sums.h.
struct ElementPoints {
  int used = 0;                  ///< number of points with a weight
  int count = 0;                 ///< number including padding
  std::vector<double> geometry;  ///< [kPointValues][count]
  /// Points per direction of a tensor rule whose functions are given separately along u and v. 0:
  /// `basis` is a table of their products, [point][stride].
  int perDirection = 0;
  int functions[2] = {0, 0};  ///< along u and v of a tensor rule; otherwise the first counts all
  int stride = 0;             ///< between the values of consecutive points in the table
  std::vector<double> basis;  ///< of a tensor rule: [point along u][function], then the same for v

  int functionCount() const {
    return perDirection > 0 ? functions[0] * functions[1] : functions[0];
  }
  const double* position(int component) const { return at(component); }
  const double* area(int component) const { return at(3 + component); }
  /// Size of the area vectors; beside the border of a support, times the factor that all traction
  /// functions of the element share (ElementSurface::tractionFactors()).
  const double* tractionArea() const { return at(6); }

  Eigen::Vector3d positionOf(int point) const { return vectorAt(0, point); }
  Eigen::Vector3d areaOf(int point) const { return vectorAt(3, point); }
  /// Values of the functions at a point; `values` has functionCount() entries.
  void basisAt(int point, Eigen::VectorXd& values) const;

  /// Task of summing the kernels for the collocation point `x`.
  SumKernelsTask sumTask(const Eigen::Vector3d& x, KernelSums* sums) const;

 private:
  const double* at(int value) const {
    return geometry.data() + static_cast<std::ptrdiff_t>(value) * count;
  }
  Eigen::Vector3d vectorAt(int value, int point) const {
    return {at(value)[point], at(value + 1)[point], at(value + 2)[point]};
  }
};

}  // namespace palpa::bem
