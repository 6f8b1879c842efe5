#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Widths of the narrowest masks at the points of a spline surface: kMinWidth times the spread of
/// basis functions on uniform elements of the local size (the standard deviation of a function:
/// 0.58 h for cubic elements of size h). Functions are narrower at the borders of patches, but this
/// does not allow narrower masks: a bump extends over the border onto the adjacent elements.
///
/// Element sizes differ between patches and have a kink where patches meet; a user who slides a
/// finger over it would feel it. The width is therefore a mean over the elements around the point,
///   w(x) = Σ_q a_q φ_q / w_q / Σ_q a_q φ_q / w_q^2,  φ_q = (1 - |x - x_q|^2 / (c w_q)^2)^2 within
///   c w_q,
/// over Gauss points x_q of areas a_q with the widths w_q of their elements. It is once
/// continuously differentiable in x, exact where w_q is constant, and lies between the smallest and
/// the largest w_q within reach.
///
/// Immutable. A query takes about 0.3 µs.
class SplineMaskWidths {
 public:
  /// The narrowest radius is 1.73 h for uniform cubic elements of size h, and 1.5 h for quadratic
  /// ones.
  static constexpr double kMinWidth = 3;

  explicit SplineMaskWidths(const SplineSurface& surface);

  /// Mean width over the support of the function of each displacement coefficient, mm.
  const std::vector<double>& ofFunctions() const { return ofFunctions_; }
  /// Width at a surface point x (mm) in an element, mm.
  double at(int element, const Eigen::Vector3d& x) const;

 private:
  struct Sample {
    Eigen::Vector3d position;
    double inverseSquare;  // of the reach, 1/mm^2
    double weight;         // a_q / w_q^2
    double width;          // mm
  };
  struct Samples {  // of an element
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0;  // bounding sphere of the samples, mm
    double reach = 0;   // bounding sphere of all points that they reach, mm
    std::vector<Sample> list;
  };
  std::vector<double> ofFunctions_;
  std::vector<Samples> samples_;        // per element
  std::vector<std::vector<int>> near_;  // per element: elements whose samples may reach it
};

}  // namespace palpa::bem
