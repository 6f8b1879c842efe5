#pragma once

#include "bem/model/bulk.h"
#include "bem/problem/interior_evaluator.h"
#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/triangle/interior_sources.h"

namespace palpa::bem {

/// Interior states of fields in spline coefficients: Somigliana's identities for the field minus
/// the linear field of the nearest surface point, as SplineResults::interiorState(), with stored
/// quadrature points for the elements far from a point. The states converge to the surface states.
///
/// Surface, tractions and quadrature must outlive it.
class SplineInterior final : public InteriorEvaluator {
 public:
  /// Tolerance of the quadrature for which stresses have errors of about 1e-4 of the largest.
  static constexpr double kTolerance = 1e-4;

  /// `points`: inside the body, mm. Takes about 50 µs per point and core. Throws Cancelled.
  SplineInterior(const SplineSurface& surface, const SplineTractions& tractions,
                 const SplineQuadrature& quadrature, const Bulk& bulk,
                 std::vector<Eigen::Vector3d> points, const Job& job);

 private:
  std::vector<InteriorState> evaluateAll(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                         const Job& job) const override;

  struct Foot {
    SplineMesh::Point at;
    double distance;
  };
  struct Scratch {
    SplineQuadrature::Workspace quadrature;
    InteriorSources near;
  };
  void addSources(int element, const SplinePoints& points, const Eigen::VectorXd& u,
                  const Eigen::VectorXd& p, std::size_t first, InteriorSources& sources) const;
  InteriorState sumAt(std::size_t point, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                      const InteriorSources& far, Scratch& scratch) const;

  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  const SplineQuadrature& quadrature_;
  Bulk bulk_;
  Eigen::Vector3d centre_;  // of the particular state of the body force, anywhere near the body
  InteriorConstants constants_;
  SumInterior sum_;
  std::vector<Foot> feet_;
  std::vector<std::size_t> firstSource_;  // per element and kept rule
};

}  // namespace palpa::bem
