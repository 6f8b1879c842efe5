#pragma once

#include "bem/element/element_quadrature.h"
#include "bem/model/bulk.h"
#include "bem/problem/interior_evaluator.h"
#include "bem/triangle/interior_sources.h"

namespace palpa::bem {

/// Interior states of fields on curved elements: Somigliana's identities for the field minus
/// the linear field of the nearest surface point, as ElementResults::interiorState(), with stored
/// quadrature points for the elements far from a point. The states converge to the surface states.
///
/// Surface and quadrature must outlive it.
class ElementInterior final : public InteriorEvaluator {
 public:
  /// Tolerance of the quadrature for which stresses have errors of about 1e-4 of the largest.
  static constexpr double kTolerance = 1e-4;

  /// `points`: inside the body, mm. Takes about 50 µs per point and core. Throws Cancelled.
  ElementInterior(const ElementSurface& surface, const ElementQuadrature& quadrature,
                  const Bulk& bulk, std::vector<Eigen::Vector3d> points, const Job& job);

 private:
  std::vector<InteriorState> evaluateAll(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                         const Job& job) const override;

  struct Scratch {
    std::unique_ptr<ElementQuadrature::Workspace> quadrature;
    InteriorSources near;
  };
  void addSources(int element, const ElementPoints& points, const Eigen::VectorXd& u,
                  const Eigen::VectorXd& p, std::size_t first, InteriorSources& sources) const;
  InteriorState sumAt(std::size_t point, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                      const InteriorSources& far, Scratch& scratch) const;

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  Bulk bulk_;
  Eigen::Vector3d centre_;  // of the particular state of the body force, anywhere near the body
  InteriorConstants constants_;
  SumInterior sum_;
  std::vector<ElementFoot> feet_;
  std::vector<std::size_t> firstSource_;  // per element and kept rule
};

}  // namespace palpa::bem
