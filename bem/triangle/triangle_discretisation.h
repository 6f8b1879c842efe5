#pragma once

#include "base/lazy.h"
#include "bem/problem/discretisation.h"

namespace palpa::bem {

class TriangleBodyForce;

/// Linear displacements and tractions on the flat triangles of the mesh: the coefficients are the
/// values at the nodes and slots.
class TriangleDiscretisation final : public Discretisation {
 public:
  explicit TriangleDiscretisation(BoundaryMesh mesh);
  ~TriangleDiscretisation() override;

  const TractionSlots& slots() const override { return meshSlots(); }
  const std::vector<Eigen::Vector3d>& places() const override { return mesh().nodes; }
  Weights placeWeights() const override;
  int elementCount() const override { return mesh().triangleCount(); }

  DegreesOfFreedom degreesOfFreedom(const std::vector<SlotCondition>& conditions,
                                    const Material& material) const override;
  void checkSolvable(const std::vector<SlotCondition>& conditions,
                     const Material& material) const override;
  void write(const ByteSink& sink) const override;

  BoundaryField valuesOnMesh(const BoundaryField& field) const override { return field; }
  Weights displacementWeights(std::span<const SurfacePoint> places) const override;

  double area(int coefficient) const override { return nodalArea(mesh(), coefficient); }
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
  /// Null without a body force.
  const TriangleBodyForce* bodyForce(const Bulk& bulk) const;

  Lazy<TriangleBodyForce> bodyForce_;
};

}  // namespace palpa::bem
