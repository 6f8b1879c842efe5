#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/core/model/build_touch_model.h"
#include "app/core/setup/project_geometry.h"
#include "bem/compressed/make_problem.h"

namespace palpa::app {

/// The steps of buildTouchModel() and updateTouchModel(), which call them in the order of the
/// declarations. Every step writes its share of the BuildReport. Project, options and job must
/// outlive it. Steps throw as buildTouchModel().
class ModelBuilder {
 public:
  ModelBuilder(const modeling::Project& project, const BuildOptions& options, const Job& job);

  /// All steps of a full rebuild before the problem: expected memory, mesh(), check(), setUp(),
  /// memory. Throws ModelTooLarge if the model will not fit into memory, as early as it is known.
  void prepare();
  /// The mesh of an update: with triangles the former mesh, moved with the control points. False if
  /// the body must be remeshed. Splines do not depend on the mesh.
  bool moveMesh(const modeling::Solid& formerSolid, const TouchModel& former);
  void check();
  void setUp();
  /// Takes the problem of `former` (may be null) or of the cache if it is the same, or solves it.
  void makeProblem(const TouchModel* former);
  /// False if the conditions of `former` differ or if an update does not pay.
  bool updateProblem(const TouchModel& former);
  void solveAtRest();
  /// solveAtRest() with the factors of `former`. False if the residual is too large.
  bool solveUpdateAtRest(const TouchModel& former);
  std::shared_ptr<const TouchModel> finish();

 private:
  void checkExpectedMemory() const;
  void mesh();
  /// checkExpectedMemory() with the numbers of the setup; chooses how the operators are stored.
  void checkMemory();
  bem::Precision checkFits(const bem::ProblemSize& size) const;
  /// Computes the parts of the model that the body force determines, once it has its problem.
  void addBodyForce();
  bem::ProblemInputs problemInputs() const;
  /// Takes the problem of BuildOptions::storedModel if it fits.
  void readStored(const bem::ProblemInputs& inputs);
  double lap();

  const BuildOptions& options_;
  const Job& job_;
  std::chrono::steady_clock::time_point lapStart_ = std::chrono::steady_clock::now();
  modeling::MeshSettings settings_;
  ProjectGeometry geometry_;
  bem::Precision precision_;
  modeling::SurfaceMesh mesh_;         // until setUp(), which moves it into the model
  std::shared_ptr<TouchModel> model_;  // from setUp() on
  BuildReport report_;
};

}  // namespace palpa::app
