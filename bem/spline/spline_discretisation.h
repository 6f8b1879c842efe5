#pragma once

#include "base/lazy.h"
#include "bem/element/element_results.h"
#include "bem/problem/discretisation.h"
#include "bem/spline/spline_elements.h"
#include "bem/spline/spline_integrals.h"
#include "bem/spline/spline_mesh_stress.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

/// Discretisation with splines on the patches of a solid. Its elements are the elements of the
/// spline surface.
class SplineDiscretisation final : public Discretisation {
 public:
  /// `triangles`: one per triangle of the mesh, its position on the patches. Equal tags of
  /// triangles and elements denote the same part of the surface.
  SplineDiscretisation(BoundaryMesh mesh, SplineSurface surface,
                       std::vector<SplineMesh::Triangle> triangles);
  SplineDiscretisation(const SplineDiscretisation&) = delete;
  SplineDiscretisation& operator=(const SplineDiscretisation&) = delete;

  const SplineSurface& surface() const { return surface_; }
  const SplineTractions& tractions() const { return tractions_; }
  const SplineElements& elements() const { return elements_; }
  const SplineMesh& splineMesh() const { return splineMesh_; }

  const TractionSlots& slots() const override { return tractions_.slots; }
  const std::vector<Eigen::Vector3d>& places() const override { return places_; }
  Weights placeWeights() const override { return placeWeights_; }
  int elementCount() const override { return surface_.elementCount(); }

  DegreesOfFreedom degreesOfFreedom(const std::vector<SlotCondition>& conditions,
                                    const Material& material) const override;
  void checkSolvable(const std::vector<SlotCondition>& conditions,
                     const Material& material) const override;
  void write(const ByteSink& sink) const override { surface_.write(sink); }

  BoundaryField valuesOnMesh(const BoundaryField& field) const override;
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
  using Entry = Eigen::Triplet<double>;
  void addWeights(const SplineMesh::Point& at, int row, std::vector<Entry>& entries) const;
  const SplineIntegrals& integrals() const { return integrals_.get(surface_, tractions_); }
  ElementResults results() const {
    return {elements_, quadrature_.get(surface_, ElementResults::kTolerance)};
  }

  SplineSurface surface_;
  SplineTractions tractions_;
  SplineElements elements_;
  SplineMesh splineMesh_;
  std::vector<Eigen::Vector3d> places_;
  Weights placeWeights_;
  Lazy<SplineIntegrals> integrals_;
  Lazy<SplineMeshStress> stress_;
  Lazy<SplineQuadrature> quadrature_, interiorQuadrature_;
};

}  // namespace palpa::bem
