#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// How narrow masks may be at the places of a spline surface: kMinWidth times how far basis
/// functions spread on even elements as long as those around (the standard deviation of a function:
/// of cubic elements h 0.58 h). That functions are narrower at borders of patches does not help: a
/// bump reaches over them onto the elements beside.
///
/// Elements change their size from patch to patch, and with a bend in it where patches meet, which
/// a finger slid over them would feel. So the field is a mean over the elements around the place,
///   w(x) = Σ_q a_q φ_q / w_q / Σ_q a_q φ_q / w_q^2,  φ_q = (1 - |x - x_q|^2 / (c w_q)^2)^2 within
///   c w_q,
/// over Gauss points x_q of areas a_q with the widths w_q of their elements: once continuously
/// differentiable in x, exact where w_q is constant, and between the smallest and the largest w_q
/// within the reach.
///
/// Immutable; about 0.3 µs per place.
class SplineMaskWidths {
 public:
  /// Of uniform cubic elements h the narrowest radius is 1.73 h, of quadratic ones 1.5 h.
  static constexpr double kMinWidth = 3;

  explicit SplineMaskWidths(const SplineSurface& surface);

  /// The mean width where a function is, per displacement coefficient, mm.
  const std::vector<double>& ofFunctions() const { return ofFunctions_; }
  /// At a point of the surface in an element, mm.
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
    double radius = 0;  // around the samples, mm
    double reach = 0;   // around all places that they reach, mm
    std::vector<Sample> list;
  };
  std::vector<double> ofFunctions_;
  std::vector<Samples> samples_;        // per element
  std::vector<std::vector<int>> near_;  // per element: those whose samples may reach it
};

}  // namespace palpa::bem
