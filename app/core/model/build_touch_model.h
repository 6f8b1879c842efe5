#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/core/model/touch_model.h"

namespace palpa::app {

struct BuildOptions {
  std::optional<double> edgeLength;  ///< mm; replaces the project's edge length
  bem::Precision precision = bem::Precision::kAutomatic;
  /// Nodes of quadratic triangles from which an automatic precision is kCompressed, unless most of
  /// the body is thin; absent: bem::kCompressedFrom.
  std::optional<int> compressedFrom;
  /// If absent, the default of the engine: for splines a thousandth of the requested accuracy.
  std::optional<bem::AssemblyOptions> assembly;
  /// Bytes that the model may take; 0: 85 % of the available memory.
  double memoryLimit = 0;
  /// Store of solved models that is searched; null: none. Nothing is written to it.
  std::shared_ptr<ModelCache> cache;
  /// Stored model (stored_model.h) that is taken if it belongs to the project; empty: none.
  std::filesystem::path storedModel;
  /// Fail with ModelingError if there is no such model, instead of computing it.
  bool needsStoredModel = false;
  /// Makes the problem; null: bem::makeReferenceProblem().
  std::function<std::unique_ptr<bem::ReferenceProblem>(const bem::Discretisation&,
                                                       const bem::ProblemInputs&, const Job&,
                                                       bem::ReferenceProblemTimes*)>
      makeProblem;
};

/// Builds the model of a project. Phases of progress: "mesh", "check", "setup" (supports, loads and
/// spline elements), then "assemble" and "factorise", or "read" if the cache or a file has the
/// solved problem, and "solve". `former`: an earlier model, whose solved problem is used again if
/// nothing that it depends on has changed (loads changed, or a change of shape was undone). Throws
/// ModelingError (bad project; GeometryError if the surface does not bound a body), SolverError
/// (cannot be solved; kTooLarge, with the estimate, before memory is taken), Cancelled.
std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job,
                                                  const TouchModel* former = nullptr);

/// Incremental update: the model of a project that differs from `formerProject`, the project of
/// `former`, in the places of control points. Only moved elements are integrated again, and the
/// equations are solved with the former factors as a preconditioner
/// (bem::updateDenseReferenceProblem()). The update can be touched much sooner than a full rebuild,
/// which should replace it: solutions take longer and are exact to report().residual. With
/// triangles the mesh is the former one, moved with the control points.
///
/// Null if something else differs, if the update does not pay, is not exact enough (1e-4) or would
/// take memory that the full model needs, or if `former` is an update itself. Phase of progress:
/// "update". Throws as buildTouchModel().
std::shared_ptr<const TouchModel> updateTouchModel(const modeling::Project& project,
                                                   const modeling::Project& formerProject,
                                                   const TouchModel& former,
                                                   const BuildOptions& options, const Job& job);

}  // namespace palpa::app
