#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"

// A touch on finer and finer meshes, until the stated error of its forces is small enough.
namespace palpa::app {

/// When to stop.
struct ErrorGoal {
  double error = 0.05;  ///< relative, of the forces (StateError::ofForces()), > 0
  double seconds = 60;  ///< no finer mesh that is expected to end later is begun, or awaited longer
  int maxMeshes = 6;    ///< the first one is the project's
};

/// A mesh and what it gave.
struct RefinementStep {
  modeling::MeshSettings mesh;
  int nodes = 0;            ///< of the surface mesh
  double coefficients = 0;  ///< of displacement
  double error = 0;         ///< stated, of the forces, relative
  double seconds = 0;       ///< from the mesh to the error
  double bytes = 0;         ///< of the operators and factors
};

/// The best of the meshes, and why there is no better one.
struct RefinedTouch {
  enum class End {
    kReached,  ///< the error is at most the goal
    kMeshes,   ///< ErrorGoal::maxMeshes
    kNoFiner,  ///< shorter elements give no finer mesh
    kTime,     ///< the next mesh would end too late, or did
    kMemory,   ///< the next mesh does not fit
    kFailed,   ///< the next mesh could not be made or solved: `reason`
  };

  // Of the mesh with the smallest error:
  std::shared_ptr<const TouchModel> model;
  TouchState state;           ///< with errors
  modeling::Project project;  ///< with the settings of the mesh
  std::size_t taken = 0;      ///< its number in `steps`
  // Of all:
  std::vector<RefinementStep> steps;  ///< at least one
  End end = End::kReached;
  std::string reason;  ///< of End::kFailed: the message for users
};

/// Plays a touch on a model and adds the errors of the state. Throws Cancelled.
using PlayTouch =
    std::function<TouchState(const TouchModel&, const modeling::Project&, const Job&)>;

/// Builds the model of `project`, plays, and repeats this with shorter elements everywhere until
/// the forces have the wished error. The length follows from the error, which is assumed to fall
/// with the observed order of convergence. The error may grow, too: a finer mesh has gaps and pins
/// that the former one was made over. `options`: as for buildTouchModel(). Throws what the
/// first mesh throws, and Cancelled.
RefinedTouch refineTouch(const modeling::Project& project, const ErrorGoal& goal,
                         const BuildOptions& options, const PlayTouch& play, const Job& job);

}  // namespace palpa::app
