#pragma once

#include "base/lazy.h"
#include "bem/element/element_results.h"
#include "bem/problem/discretisation.h"
#include "bem/quadratic/quadratic_integrals.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

/// Quadratic displacements and tractions on curved six-node triangles. The coefficients are the
/// values at the nodes of the mesh, whose triangles are the quarters of the elements
/// (quarteredMesh()), and at its slots.
class QuadraticDiscretisation final : public Discretisation {
 public:
  /// `supportTags`: of the triangles in supports. Throws SolverError (kBadMesh) as
  /// QuadraticSurface.
  explicit QuadraticDiscretisation(BoundaryMesh mesh, const std::vector<int>& supportTags = {});
  QuadraticDiscretisation(const QuadraticDiscretisation&) = delete;
  QuadraticDiscretisation& operator=(const QuadraticDiscretisation&) = delete;

  const QuadraticSurface& surface() const { return surface_; }
  const QuadraticIntegrals& integrals() const { return integrals_.get(surface_); }

  /// The slots of the mesh with the normals of the curved surface.
  const TractionSlots& slots() const override { return slots_; }
  const std::vector<Eigen::Vector3d>& places() const override { return mesh().nodes; }
  Weights placeWeights() const override;
  int elementCount() const override { return surface_.elementCount(); }

  DegreesOfFreedom degreesOfFreedom(const std::vector<SlotCondition>& conditions,
                                    const Material& material) const override;
  void checkSolvable(const std::vector<SlotCondition>& conditions,
                     const Material& material) const override;
  void write(const ByteSink& sink) const override;

  BoundaryField valuesOnMesh(const BoundaryField& field) const override { return field; }
  Weights displacementWeights(std::span<const SurfacePoint> places) const override;

  double area(int coefficient) const override { return integrals().area(coefficient); }
  Resultant resultant(const Eigen::VectorXd& p, std::span<const int> elements) const override;
  double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const override;
  std::vector<Eigen::Matrix3d> surfaceStress(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                             const Material& material) const override;
  Eigen::Vector3d position(const SurfacePoint& place) const override;
  Eigen::Vector3d interpolate(const SurfacePoint& place, const Eigen::VectorXd& u) const override;
  Eigen::Vector3d displacementAt(const SurfacePoint& place, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& p, const Bulk& bulk) const override;
  Eigen::Vector3d tractionAt(const SurfacePoint& place, const Eigen::VectorXd& p) const override;
  Eigen::Vector3d displacementDefect(const SurfacePoint& place, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& p, const Bulk& bulk) const override;
  BoundaryField estimatedError(const ReferenceProblem& problem, const BoundaryField& field,
                               const Bulk& bulk, const Job& job) const override;
  std::optional<InteriorState> interiorState(const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                             const Bulk& bulk,
                                             const Eigen::Vector3d& point) const override;
  std::unique_ptr<InteriorEvaluator> makeInteriorEvaluator(std::vector<Eigen::Vector3d> points,
                                                           const Bulk& bulk,
                                                           const Job& job) const override;
  VolumeMoments volumeMoments() const override;
  Eigen::VectorXd bodyForceTerm(const DegreesOfFreedom& dofs, const Bulk& bulk,
                                const Job& job) const override;
  BodyForceWork bodyForceWork(const Bulk& bulk) const override;
  std::unique_ptr<ContactSurface> makeContactSurface(const DegreesOfFreedom& dofs) const override;

 private:
  ElementResults results() const {
    return {surface_, quadrature_.get(surface_, ElementResults::kTolerance)};
  }

  QuadraticSurface surface_;
  TractionSlots slots_;
  Lazy<QuadraticIntegrals> integrals_;
  Lazy<QuadraticQuadrature> quadrature_, interiorQuadrature_;
};

}  // namespace palpa::bem
