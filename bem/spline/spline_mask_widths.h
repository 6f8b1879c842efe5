#pragma once
#include <Eigen/Dense>
#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// How narrow masks may be at the places of a spline surface: kNarrowest times how far the basis
/// functions around spread, as a smooth field.
///
/// The functions themselves spread by other amounts from patch to patch, and less at borders and
/// corners of patches, where fewer elements carry them: interpolated by the splines that is
/// continuous, but bent where patches meet (by up to 1.3 mm per mm on a sphere), and a finger slid
/// over it feels each bend. So the field is the mean of that interpolation around the place,
///   w(x) = Σ_q a_q φ(|x - x_q| / (kReach w_q)) w_q / Σ_q a_q φ(...),  φ(t) = (1 - t^2)^2 below 1,
/// over Gauss points x_q of areas a_q where the interpolation is w_q: once continuously
/// differentiable in x, exact where w_q is constant, and between the smallest and the largest w_q
/// within the reach.
///
/// Immutable; about 0.3 µs per place.
class SplineMaskWidths {
 public:
  /// Of uniform cubic elements h the narrowest radius is 1.73 h, of quadratic ones 1.5 h.
  static constexpr double kNarrowest = 3;

  explicit SplineMaskWidths(const SplineSurface& surface);

  /// Per displacement coefficient: kNarrowest times its spread, mm.
  const std::vector<double>& ofFunctions() const { return ofFunctions_; }
  /// At a point of the surface in an element, mm.
  double at(int element, const Eigen::Vector3d& x) const;

 private:
  struct Sample {
    Eigen::Vector3d position;
    double inverseSquare;  // of the reach, 1/mm^2
    double area;           // mm^2
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
