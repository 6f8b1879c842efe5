#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bem/model/body_force.h"
#include "bem/model/derived_quantities.h"
#include "bem/model/surface_point.h"
#include "bem/problem/interior_evaluator.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

class ContactSurface;

/// Representation of displacements and tractions on a body's surface by coefficients, and the
/// results that depend on it. Two kinds: linear functions on triangles (TriangleDiscretisation),
/// whose coefficients are the values at nodes and slots, and splines on the patches of a solid
/// (SplineDiscretisation).
///
/// Both have a triangle mesh, which names surface points and shows results. For splines the mesh
/// represents the surface only; its edge length does not change the results.
///
/// Functions that take the bulk evaluate fields that its body force and the boundary data cause
/// together. Differences of such fields have no body force: pass the material alone.
///
/// Immutable; const use from several threads is safe.
class Discretisation {
 public:
  virtual ~Discretisation() = default;

  const BoundaryMesh& mesh() const { return mesh_; }
  /// Slots of the mesh: one per node and adjacent face.
  const TractionSlots& meshSlots() const { return meshSlots_; }

  /// The coefficients: one displacement coefficient per "node" of these slots, one traction
  /// coefficient per slot.
  virtual const TractionSlots& slots() const = 0;
  /// Position at which each displacement coefficient has the most weight, mm.
  virtual const std::vector<Eigen::Vector3d>& places() const = 0;
  /// Weights of the displacement coefficients at places: one row each.
  using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// Weights of the displacements at places(): the identity for triangles.
  virtual Weights placeWeights() const = 0;
  /// Number of elements of integration: triangles, or elements of splines.
  virtual int elementCount() const = 0;

  int displacementCount() const { return static_cast<int>(places().size()); }

  virtual DegreesOfFreedom degreesOfFreedom(const std::vector<SlotCondition>& conditions,
                                            const Material& material) const = 0;
  /// See bem::checkSolvable().
  virtual void checkSolvable(const std::vector<SlotCondition>& conditions,
                             const Material& material) const = 0;
  /// Writes everything that the operators depend on, for a hash.
  virtual void write(const ByteSink& sink) const = 0;

  /// Values at the nodes and slots of the mesh of a field in coefficients.
  virtual BoundaryField valuesOnMesh(const BoundaryField& field) const = 0;
  /// Weights of the displacement coefficients at any places.
  virtual Weights displacementWeights(std::span<const SurfacePoint> places) const = 0;

  /// Integral of the function of a displacement coefficient, mm^2: the force per unit of traction.
  virtual double area(int coefficient) const = 0;
  /// Force and moment of the traction coefficients `p` of some elements on the body.
  virtual Resultant resultant(const Eigen::VectorXd& p, std::span<const int> elements) const = 0;
  /// 1/2 ∫ p.u dΓ, mJ: the strain energy without a body force; half of bodyForceWork() must be
  /// added with one. For triangles ContactSurface::strainEnergy() is twenty times as fast.
  virtual double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const = 0;
  /// Cauchy stress at the slots of the mesh, MPa.
  virtual std::vector<Eigen::Matrix3d> surfaceStress(const Eigen::VectorXd& u,
                                                     const Eigen::VectorXd& p,
                                                     const Material& material) const = 0;
  /// Position of a place on the surface that the discretisation describes, mm: curved for quadratic
  /// triangles and splines.
  virtual Eigen::Vector3d position(const SurfacePoint& place) const = 0;
  /// Σ N_j u_j at a place, mm.
  virtual Eigen::Vector3d interpolate(const SurfacePoint& place,
                                      const Eigen::VectorXd& u) const = 0;
  /// Most accurate displacement at a place, mm: one more iterate.
  virtual Eigen::Vector3d displacementAt(const SurfacePoint& place, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& p, const Bulk& bulk) const = 0;
  virtual Eigen::Vector3d tractionAt(const SurfacePoint& place, const Eigen::VectorXd& p) const = 0;
  /// Defect of the displacement in the boundary integral equation at a place, mm: the change by one
  /// more iterate. Zero at collocation points by construction; between them an estimate of the
  /// error of u.
  virtual Eigen::Vector3d displacementDefect(const SurfacePoint& place, const Eigen::VectorXd& u,
                                             const Eigen::VectorXd& p, const Bulk& bulk) const = 0;
  /// Estimated error (exact minus computed) of a field that solves a problem of this
  /// discretisation: the part that the functions can represent, computed from the residual between
  /// the collocation points. displacementDefect() adds the part that varies within elements.
  /// Includes the soft modes of slender bodies (bending), which have almost no residual. One column
  /// per state. Zero for triangles. Throws Cancelled.
  virtual BoundaryField estimatedError(const ReferenceProblem& problem, const BoundaryField& field,
                                       const Bulk& bulk, const Job& job) const = 0;
  /// Empty for a point outside of the body.
  virtual std::optional<InteriorState> interiorState(const Eigen::VectorXd& u,
                                                     const Eigen::VectorXd& p, const Bulk& bulk,
                                                     const Eigen::Vector3d& point) const = 0;

  /// Evaluator of interior states at points inside the body, mm: many points, field after field.
  /// This object must outlive it. Throws Cancelled.
  virtual std::unique_ptr<InteriorEvaluator> makeInteriorEvaluator(
      std::vector<Eigen::Vector3d> points, const Bulk& bulk, const Job& job) const = 0;
  /// Volume and centroid of the body that the discretisation describes: of the polyhedron for
  /// triangles.
  virtual VolumeMoments volumeMoments() const = 0;
  /// Term of the body force in the equations of a problem, G p - H u + term = 0: one row per row of
  /// the operators (dofs.count()), mm. Costs a small part of an assembly. Throws Cancelled.
  virtual Eigen::VectorXd bodyForceTerm(const DegreesOfFreedom& dofs, const Bulk& bulk,
                                        const Job& job) const = 0;
  virtual BodyForceWork bodyForceWork(const Bulk& bulk) const = 0;

  /// The surface for contacts; this object and `dofs` must outlive it.
  virtual std::unique_ptr<ContactSurface> makeContactSurface(
      const DegreesOfFreedom& dofs) const = 0;

 protected:
  explicit Discretisation(BoundaryMesh mesh) : mesh_(std::move(mesh)), meshSlots_(mesh_) {}

 private:
  BoundaryMesh mesh_;
  TractionSlots meshSlots_;
};

}  // namespace palpa::bem
