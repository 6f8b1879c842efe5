#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bem/model/derived_quantities.h"
#include "bem/model/surface_point.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

class ContactSurface;

/// How displacements and tractions on a body's surface are made of coefficients, and all that
/// depends on it: the operators, and the results. Two kinds: linear functions on triangles
/// (TriangleDiscretisation), whose coefficients are the values at nodes and slots, and splines on
/// the patches of a solid (SplineDiscretisation).
///
/// Either has a triangle mesh: places on the surface are named by it, and results are shown on it.
/// For splines it is the surface alone; how fine it is does not change what is computed.
///
/// Immutable; const use from several threads is safe.
class Discretisation {
 public:
  virtual ~Discretisation() = default;

  const BoundaryMesh& mesh() const { return mesh_; }
  /// Of the mesh: sides of its nodes.
  const TractionSlots& meshSlots() const { return meshSlots_; }

  /// The coefficients: one displacement coefficient per "node" of these slots, one traction
  /// coefficient per slot.
  virtual const TractionSlots& slots() const = 0;
  /// Where each displacement coefficient weighs most, mm.
  virtual const std::vector<Eigen::Vector3d>& places() const = 0;
  /// Weights of the displacement coefficients at places: one row each.
  using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// Those of the displacements at places(): the identity for triangles.
  virtual Weights placeWeights() const = 0;
  /// Elements that coefficients are integrated over: triangles, or elements of splines.
  virtual int elementCount() const = 0;

  int displacementCount() const { return static_cast<int>(places().size()); }

  virtual DegreesOfFreedom degreesOfFreedom(const std::vector<SlotCondition>& conditions,
                                            const Material& material) const = 0;
  /// See bem::checkSolvable().
  virtual void checkSolvable(const std::vector<SlotCondition>& conditions,
                             const Material& material) const = 0;
  /// All that the operators depend on, for a hash.
  virtual void write(const ByteSink& sink) const = 0;

  /// Values at the nodes and slots of the mesh of a field in coefficients.
  virtual BoundaryField valuesOnMesh(const BoundaryField& field) const = 0;
  /// Weights of the displacement coefficients at any places.
  virtual Weights displacementWeights(std::span<const SurfacePoint> places) const = 0;

  /// ∫ of the function of a displacement coefficient, mm^2: the force per unit of its traction.
  virtual double area(int coefficient) const = 0;
  /// Of the traction coefficients `p` over some elements, on the body.
  virtual Resultant resultant(const Eigen::VectorXd& p, std::span<const int> elements) const = 0;
  /// Strain energy 1/2 ∫ p.u dΓ, mJ. ContactSurface has it, too, for triangles twenty times as
  /// fast.
  virtual double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const = 0;
  /// Cauchy stress at the slots of the mesh, MPa.
  virtual std::vector<Eigen::Matrix3d> surfaceStress(const Eigen::VectorXd& u,
                                                     const Eigen::VectorXd& p,
                                                     const Material& material) const = 0;
  /// Σ N_j u_j at a place, mm.
  virtual Eigen::Vector3d interpolate(const SurfacePoint& place,
                                      const Eigen::VectorXd& u) const = 0;
  /// As accurately as it is known, mm: one more iterate.
  virtual Eigen::Vector3d displacementAt(const SurfacePoint& place, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& p,
                                         const Material& material) const = 0;
  virtual Eigen::Vector3d tractionAt(const SurfacePoint& place, const Eigen::VectorXd& p) const = 0;
  /// How far the displacement at a place misses the boundary integral equation there, mm: what one
  /// more iterate would change it by. The residual between the collocation points, where it is not
  /// zero by construction, so an estimate of the error of u.
  virtual Eigen::Vector3d displacementDefect(const SurfacePoint& place, const Eigen::VectorXd& u,
                                             const Eigen::VectorXd& p,
                                             const Material& material) const = 0;
  /// Estimated error of a field that solves a problem of this discretisation, exact less computed,
  /// as far as functions can carry it: the unknowns that the residual between the collocation
  /// points calls for. With displacementDefect(), which tells what varies within elements, an
  /// estimate of the whole error, also of the soft modes of slender bodies (bending), which leave
  /// almost no residual. A column per state. Zero for triangles. Throws Cancelled.
  virtual BoundaryField estimatedError(const ReferenceProblem& problem, const BoundaryField& field,
                                       const Material& material, const Job& job) const = 0;
  /// Empty for a point outside of the body.
  virtual std::optional<InteriorState> interiorState(const Eigen::VectorXd& u,
                                                     const Eigen::VectorXd& p,
                                                     const Material& material,
                                                     const Eigen::Vector3d& point) const = 0;

  /// What contacts need to know of the surface; this and `dofs` must outlive it.
  virtual std::unique_ptr<ContactSurface> makeContactSurface(
      const DegreesOfFreedom& dofs) const = 0;

 protected:
  explicit Discretisation(BoundaryMesh mesh) : mesh_(std::move(mesh)), meshSlots_(mesh_) {}

 private:
  BoundaryMesh mesh_;
  TractionSlots meshSlots_;
};

}  // namespace palpa::bem
