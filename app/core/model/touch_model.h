#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/geometry_error.h"
#include "app/core/model/model_cache.h"
#include "app/core/model/surface_offsets.h"
#include "app/core/setup/boundary_setup.h"
#include "base/lazy.h"
#include "bem/contact/contact_simulation.h"
#include "bem/contact/contact_surface.h"
#include "bem/problem/reference_problem.h"
#include "modeling/mesh/surface_mesh.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// Times and figures of a build.
struct BuildReport {
  int nodes = 0, triangles = 0;
  modeling::MeshQuality quality;
  double meshSeconds = 0;  ///< mesh and setup
  double checkSeconds = 0, solveSeconds = 0;
  double assembleSeconds = 0, factoriseSeconds = 0;  ///< 0 if the problem came from the cache
  double readSeconds = 0;                            ///< 0 if it did not
  double memory = 0;                                 ///< bytes of the operators and factors
  std::string storage;                               ///< of the operators: "dense", "compressed"
  /// Largest residual over the largest term of the equations, for an incremental update
  /// (updateTouchModel()), which has no factors.
  std::optional<double> residual;
  GeometryError::Findings warnings;  ///< of the geometry check; never null in a model
  std::string notice;                ///< a sentence for the user; mostly empty
};

/// One solution of the static problem, with or without touches: displacements and tractions on the
/// whole boundary, forces, energy and balance.
struct TouchState {
  using Status = bem::ContactSimulation::Status;
  /// One column, in the coefficients of the model's discretisation.
  bem::BoundaryField field;
  struct Force {
    std::string name;
    bem::Resultant resultant;  ///< on the body, N and N mm about the origin
  };
  std::vector<Force> supports;
  struct Contact {
    Eigen::Vector3d at;            ///< mm, on the unloaded surface
    double radius;                 ///< mm, of the mask or ball; 0 for a single node
    Eigen::Vector3d force;         ///< N, exerted by the contact on the body
    Eigen::Vector3d displacement;  ///< mm, of the middle, from all causes
    /// mm, part of the displacement that the force of this contact causes: without loads and the
    /// forces of other contacts.
    Eigen::Vector3d deflection;
    double stiffness;  ///< |force| / |deflection|, N/mm; 0 if there is no force
    std::optional<modeling::TouchKind> kind = modeling::TouchKind::kGrab;  ///< none: a single node
    std::string name{};                                 ///< of the touch; may be empty
    Status status = Status::kGrabbed;                   ///< of pushes and balls at rest: see Path
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, unit, at `at` as unloaded
    double friction = 0;                                ///< Coulomb's coefficient
    Eigen::Vector3d tool = Eigen::Vector3d::Zero();     ///< mm, in space: fingertip, ball's centre
    std::vector<bem::ContactSimulation::PatchForce> patch{};  ///< of a push or ball
    /// Estimated relative error of the force (error_estimate.h); empty if it was not requested.
    std::optional<double> errorEstimate{};
    /// mm/N: displacement of the place by unit forces on it, of a place that a grab moves.
    std::optional<Eigen::Matrix3d> compliance{};

    bool presses() const { return kind && modeling::infoOf(*kind).presses; }
    bool isBall() const { return kind && modeling::infoOf(*kind).isBall; }
    bool hasGivenForce() const { return kind && modeling::infoOf(*kind).isForce; }
    /// N, positive into the body.
    double normalForce() const { return 0.0 - force.dot(normal); }
    /// N, along the surface.
    Eigen::Vector3d tangentialForce() const { return force + normalForce() * normal; }
    /// mm, from `at` to half-way into the outermost mask of the patch; 0 without one.
    double patchRadius() const;
  };
  std::vector<Contact> contacts;
  /// Convergence of the trajectories of pushes and balls.
  struct Path {
    int steps = 0;          ///< along the trajectories; a divided step counts as several
    int settlingSteps = 0;  ///< at the end, until no force changed any more
    double change = 0;      ///< of the forces in the last settling step, over the largest force
    double residual = 0;    ///< of the laws of contact, over the largest force
  };
  std::optional<Path> path;  ///< none without pushes and balls
  double energy = 0;         ///< strain energy, mJ
  /// Norm of the sum of all forces on the body, N: an error indicator, as it is zero for the exact
  /// solution.
  double balance = 0;
  /// `balance` over the largest of these forces (of a moment: BoundarySetup::LoadPart::couple); 0
  /// if there are none.
  double relativeBalance = 0;
  /// Estimated relative error of displacements and forces, the largest one (error_estimate.h);
  /// empty if it was not requested.
  std::optional<double> errorEstimate;
  /// The same of forces alone: of contacts, or without these of the field.
  std::optional<double> forceErrorEstimate{};
};

/// A project that is meshed, assembled, factorised and solved for its supports and loads, ready to
/// be touched. Immutable, so that threads can share it. Made by buildTouchModel() and
/// updateTouchModel().
class TouchModel {
 public:
  /// The body that surface() is a mesh of.
  const modeling::Body& body() const { return body_; }
  const modeling::SurfaceMesh& surface() const { return surface_; }
  const BoundarySetup& setup() const { return setup_; }
  const std::shared_ptr<const bem::ReferenceProblem>& problem() const { return problem_; }
  /// Term of the body force in the equations of problem(); empty without a body force.
  const Eigen::VectorXd& bodyForceTerm() const { return bodyForceTerm_; }
  /// The state without touches.
  const TouchState& rest() const { return rest_; }
  const BuildReport& report() const { return report_; }
  /// Key of problem() in a cache.
  const ModelCache::Key& key() const { return key_; }

  /// SurfaceOffsets::ofTriangle, computed at the first call. Throws Cancelled.
  const std::vector<double>& surfaceOffsets(const Job& job) const {
    return offsets_.get(body_, *setup_.discretisation, setup_.splines != nullptr, job).ofTriangle;
  }

  /// Adds forces, energy and balance to a field and its contacts. About ten times as fast with a
  /// `surface` of this model.
  TouchState describe(bem::BoundaryField field, std::vector<TouchState::Contact> contacts,
                      const bem::ContactSurface* surface = nullptr) const;

 private:
  friend class ModelBuilder;
  TouchModel(modeling::Body body, modeling::SurfaceMesh surface, BoundarySetup setup)
      : body_(std::move(body)), surface_(std::move(surface)), setup_(std::move(setup)) {}

  modeling::Body body_;
  modeling::SurfaceMesh surface_;
  BoundarySetup setup_;
  std::shared_ptr<const bem::ReferenceProblem> problem_;
  Eigen::VectorXd bodyForceTerm_;
  bem::BodyForceWork bodyForceWork_;
  TouchState rest_;
  BuildReport report_;
  ModelCache::Key key_;
  Lazy<SurfaceOffsets> offsets_;
};

}  // namespace palpa::app
