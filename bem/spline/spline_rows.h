#pragma once

#include <span>
#include <vector>

#include "bem/model/material.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Rows of the regularised identity at one surface point x: Kelvin's kernels times every function,
/// integrated over all elements,
///   T_j = ∫ T(x, y) [N_j(y) - N_j(x)] dΓ,  U_s = ∫ U(x, y) N_s(y) dΓ.
/// At a collocation point these are the three rows of the operators. All references must outlive
/// the object; const use from several threads is safe.
class SplineRows {
 public:
  /// Numbers of sums per displacement and per traction coefficient, see spline_kernel.h.
  static constexpr int kSumsT = kKernelSumsT, kSumsU = kKernelSumsU;

  SplineRows(const SplineSurface& surface, const SplineTractions& tractions,
             const Material& material, const SplineQuadrature& quadrature);

  /// Sums of a point; reusable for other points.
  struct Sums {
    std::vector<double> T, U;  ///< [coefficient][sum], plus kSumsPadding numbers
    double total[kSumsT];      ///< sum of T before N_j(x) is subtracted
    SplineQuadrature::Workspace quadrature;
    std::vector<double> basis;
  };
  /// Computes the sums over all elements. Throws Cancelled if the job was stopped.
  void integrate(const SplineCollocationPoint& point, Sums& sums, const Job& job) const;
  /// Computes the sums ∫ T N_j and ∫ U N_s over some elements that do not contain the point,
  /// without subtraction. Throws Cancelled if the job was stopped.
  void integrateOver(std::span<const int> elements, const SplineCollocationPoint& point, Sums& sums,
                     const Job& job) const;

  const KelvinConstants& constants() const { return constants_; }

  /// r(x) = ∫ U p - ∫ T [u(y) - u(x)], mm, of fields in coefficients: 3 rows, one column per field.
  Eigen::Matrix3Xd residual(const Sums& sums, const Eigen::MatrixXd& u,
                            const Eigen::MatrixXd& p) const;

  /// Free term C in C u(x) = ∫ U p - ⨍ T u, 1/2 at smooth points: the integral of T around x. Its
  /// antisymmetric part is zero, because by Stokes's theorem it equals -∮ dl / R along a closed
  /// line around x.
  Eigen::Matrix3d freeTerm(const Sums& sums) const;

 private:
  void clear(Sums& sums) const;
  void add(int element, const SplineCollocationPoint& point, const SplinePlace* inside,
           Sums& sums) const;
  void subtractTranslation(const SplineCollocationPoint& point, Sums& sums) const;

  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  const SplineQuadrature& quadrature_;
  KelvinConstants constants_;
};

}  // namespace palpa::bem
