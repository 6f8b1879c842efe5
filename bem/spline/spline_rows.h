#pragma once

#include <span>
#include <vector>

#include "bem/model/material.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// The regularised identity at one point x of the surface: Kelvin's kernels times every function,
/// integrated over all elements,
///   T_j = ∫ T(x, y) [N_j(y) - N_j(x)] dΓ,  U_s = ∫ U(x, y) N_s(y) dΓ.
/// At a collocation point these are its three rows of the operators. All references must outlive
/// it; const use from several threads is safe.
class SplineRows {
 public:
  /// Sums per displacement and per traction coefficient, see spline_kernel.h.
  static constexpr int kSumsT = kKernelSumsT, kSumsU = kKernelSumsU;

  SplineRows(const SplineSurface& surface, const SplineTractions& tractions,
             const Material& material, const SplineQuadrature& quadrature);

  /// The sums of a point; used again from point to point.
  struct Sums {
    std::vector<double> T, U;  ///< [coefficient][sum], and kSumsPadding numbers
    double total[kSumsT];      ///< of T before N_j(x) was subtracted
    SplineQuadrature::Workspace quadrature;
    std::vector<double> basis;
  };
  void integrate(const SplineCollocationPoint& point, Sums& sums, const Job& job) const;
  /// The sums over some elements that do not contain the point, ∫ T N_j and ∫ U N_s: nothing is
  /// subtracted.
  void integrateOver(std::span<const int> elements, const SplineCollocationPoint& point, Sums& sums,
                     const Job& job) const;

  const KelvinConstants& constants() const { return constants_; }

  /// r(x) = ∫ U p - ∫ T [u(y) - u(x)] of fields in coefficients: 3 rows, a column for each.
  Eigen::Matrix3Xd residual(const Sums& sums, const Eigen::MatrixXd& u,
                            const Eigen::MatrixXd& p) const;

  /// C in C u(x) = ∫ U p - ⨍ T u, 1/2 at smooth points: what T integrates to around x. Its
  /// antisymmetric part, -∮ dl / R along a closed line around x by Stokes's theorem, is zero.
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
