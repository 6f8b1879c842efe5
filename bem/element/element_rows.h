#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/job.h"
#include "bem/element/element_quadrature.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Rows of the regularised identity at one surface point x: Kelvin's kernels times every function,
/// integrated over all elements,
///   T_j = ∫ T(x, y) [N_j(y) - N_j(x)] dΓ,  U_s = ∫ U(x, y) N_s(y) dΓ.
/// At a collocation point these are the three rows of the operators. All references must outlive
/// the object; const use from several threads is safe.
class ElementRows {
 public:
  /// Numbers of sums per displacement and per traction coefficient, see kelvin_sums.h.
  static constexpr int kSumsT = kKernelSumsT, kSumsU = kKernelSumsU;

  ElementRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
              const Material& material);

  /// Sums of a point; reusable for other points.
  struct Sums {
    std::vector<double> T, U;  ///< [coefficient][sum], plus kSumsPadding numbers
    double total[kSumsT];      ///< sum of T before N_j(x) is subtracted; not of integrateOver()
    std::unique_ptr<ElementQuadrature::Workspace> quadrature;
    std::vector<double> basis;
  };
  /// Computes the sums over all elements. Throws Cancelled if the job was stopped.
  void integrate(const CollocationPlace& point, Sums& sums, const Job& job) const;
  /// Computes the sums ∫ T N_j and ∫ U N_s over some elements that do not contain the point,
  /// without subtraction. Throws Cancelled if the job was stopped.
  void integrateOver(std::span<const int> elements, const CollocationPlace& point, Sums& sums,
                     const Job& job) const;

  /// Computes the sums ∫ T N_j and ∫ U N_s, without subtraction, over all elements, or an
  /// ascending list of elements, except `leftOut` (ascending), which hold all elements with the
  /// point. Throws Cancelled if the job was stopped.
  void integrateOutside(std::span<const int> leftOut,
                        const std::optional<std::span<const int>>& elements,
                        const CollocationPlace& point, Sums& sums, const Job& job) const;

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
  void setTotal(Sums& sums) const;
  void add(int element, const CollocationPlace& point, const ElementPlace* inside,
           Sums& sums) const;
  void subtractTranslation(const CollocationPlace& point, Sums& sums) const;

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  KelvinSumLoops loops_;
  KelvinConstants constants_;
};

}  // namespace palpa::bem
