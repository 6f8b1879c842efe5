#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/geometry_error.h"
#include "app/core/model/model_cache.h"
#include "app/core/setup/boundary_setup.h"
#include "bem/contact/contact_simulation.h"
#include "bem/contact/contact_surface.h"
#include "bem/problem/reference_problem.h"
#include "modeling/project/project.h"

namespace palpa::app {

struct BuildOptions {
  std::optional<double> edgeLength;  ///< mm; replaces that of the project
  bem::Precision precision = bem::Precision::kAutomatic;
  /// When absent, what the engine needs: for splines a thousandth of the accuracy wished for.
  std::optional<bem::AssemblyOptions> assembly;
  /// Bytes the model may take; 0: 85 % of what is available now.
  double memoryLimit = 0;
  /// Where solved models are looked for; null: nowhere. Nothing is written there.
  std::shared_ptr<ModelCache> cache;
};

struct BuildReport {
  int nodes = 0, triangles = 0;
  modeling::MeshQuality quality;
  double meshSeconds = 0, checkSeconds = 0, solveSeconds = 0;
  double assembleSeconds = 0, factoriseSeconds = 0;  ///< 0 when it was read from the cache
  double readSeconds = 0;                            ///< 0 when it was not
  double memory = 0;                                 ///< bytes of the operators and factors
  /// Of an update (updateTouchModel()), which has no factors of its own: how well it fulfils its
  /// equations, largest residual over the largest term.
  std::optional<double> residual;
  GeometryError::Findings warnings;  ///< of the geometry check; never null in a model
  std::string notice;                ///< what else a person should know, a sentence; mostly empty
};

/// Displacements and tractions on the whole boundary with everything a person wants to read off:
/// what one solution of the static problem or of a touch is.
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
    Eigen::Vector3d displacement;  ///< mm
    /// N/mm, along the displacement that the contact causes; of pushes and probes along the one
    /// that all contacts cause there.
    double stiffness;
    std::string kind = "grab";         ///< as in project files; "node": a single one
    std::string name{};                ///< of the touch; may be empty
    Status status = Status::kHolding;  ///< of pushes and probes at rest: see Path
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, unit, at `at` as unloaded
    double friction = 0;                                ///< Coulomb's coefficient
    Eigen::Vector3d tool = Eigen::Vector3d::Zero();     ///< mm, in space: fingertip, ball's centre
    std::vector<bem::ContactSimulation::PatchForce> patch{};  ///< of a push or probe

    /// N, positive into the body.
    double normalForce() const { return 0.0 - force.dot(normal); }
    /// N, along the surface.
    Eigen::Vector3d tangentialForce() const { return force + normalForce() * normal; }
    /// mm, from `at` to half-way into the outermost mask of the patch; 0 without one.
    double patchRadius() const;
  };
  std::vector<Contact> contacts;
  /// How pushes and probes got where they are.
  struct Path {
    int steps = 0;          ///< along the ways, those that were divided counted more than once
    int settlingSteps = 0;  ///< at the end, until nothing changed any more
    double change = 0;      ///< of the forces in the last of these, over the largest
    double residual = 0;    ///< of the laws of contact, over the largest force
  };
  std::optional<Path> path;  ///< none without pushes and probes
  double energy = 0;         ///< strain energy, mJ
  /// Norm of the sum of all forces on the body (N): zero for the exact solution, so an honest error
  /// indicator.
  double balance = 0;
  /// The same over the largest of these forces; 0 when there are none.
  double relativeBalance = 0;
  /// Relative error of displacements and forces, estimated (see error_estimate.h); empty when it
  /// was not asked for.
  std::optional<double> errorEstimate;
};

/// What a project becomes: meshed, assembled, factorised, solved for its own supports and loads,
/// ready to be touched. Immutable, so that it can be shared between threads.
class TouchModel {
 public:
  /// What surface() is a mesh of.
  const modeling::Body& body() const { return body_; }
  const modeling::SurfaceMesh& surface() const { return surface_; }
  const BoundarySetup& setup() const { return setup_; }
  const std::shared_ptr<const bem::ReferenceProblem>& problem() const { return problem_; }
  /// The state without touches.
  const TouchState& rest() const { return rest_; }
  const BuildReport& report() const { return report_; }
  /// What problem() is found by in a cache.
  const ModelCache::Key& key() const { return key_; }

  /// Forces, energy and balance that belong to a field and its contacts. With a `surface` of this
  /// model some ten times as fast.
  TouchState describe(bem::BoundaryField field, std::vector<TouchState::Contact> contacts,
                      const bem::ContactSurface* surface = nullptr) const;

 private:
  friend std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project&,
                                                           const BuildOptions&, const Job&,
                                                           const TouchModel*);
  friend std::shared_ptr<const TouchModel> updateTouchModel(const modeling::Project&,
                                                            const modeling::Project&,
                                                            const TouchModel&, const BuildOptions&,
                                                            const Job&);
  TouchModel(modeling::Body body, modeling::SurfaceMesh surface, BoundarySetup setup)
      : body_(std::move(body)), surface_(std::move(surface)), setup_(std::move(setup)) {}
  void setReport(BuildReport report);

  modeling::Body body_;
  modeling::SurfaceMesh surface_;
  BoundarySetup setup_;
  std::shared_ptr<const bem::ReferenceProblem> problem_;
  TouchState rest_;
  BuildReport report_;
  ModelCache::Key key_;
};

/// Runs the whole way from project to model. Phases of progress: "mesh", "check", "setup" (of
/// supports, loads and spline elements), then "assemble" and "factorise", or "read" when the cache
/// has the solved problem, and "solve". `former`: an earlier model, whose solved problem is used
/// again when nothing that it depends on has changed (loads, or a shape that was taken back).
/// Throws ModelingError (bad project; GeometryError when the surface does not bound a body),
/// SolverError (cannot be solved; kTooLarge with the estimate before memory is taken), Cancelled.
std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job,
                                                  const TouchModel* former = nullptr);

/// The model of a project that differs from another, `formerProject`, in the places of control
/// points, from the model of that: only what moved is integrated anew, and equations are solved
/// with the former factors as a preconditioner (bem::updateDenseReferenceProblem()). So it can be
/// touched much sooner than a model of its own, and is to be replaced by one: solutions take longer
/// and are exact to report().residual. With triangles the mesh is the former one, carried along.
///
/// Null when something else differs, when it does not pay, is not exact enough (1e-4) or would take
/// memory that the model of its own needs, or `former` is an update itself. Phase of progress:
/// "update". Throws as buildTouchModel().
std::shared_ptr<const TouchModel> updateTouchModel(const modeling::Project& project,
                                                   const modeling::Project& formerProject,
                                                   const TouchModel& former,
                                                   const BuildOptions& options, const Job& job);

}  // namespace palpa::app
