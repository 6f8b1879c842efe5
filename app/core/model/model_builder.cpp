#include "app/core/model/model_builder.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/core/model/model_memory.h"
#include "app/core/model/stored_model.h"
#include "bem/compressed/make_problem.h"
#include "bem/dense/update_reference_problem.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::app {
namespace {

/// Largest residual of an update that is shown; above it the motion was too large.
constexpr double kMaxResidual = 1e-4;
/// Traction slots per coefficient of a spline problem, for a body with many sharp edges.
constexpr double kSlotsPerCoefficient = 1.5;

/// Integrals follow the wished accuracy where it counts. Forces of quadratic triangles on four CAD
/// parts change by at most 4e-6 of themselves if their integrals are a hundred times as accurate.
bem::AssemblyOptions assemblyFor(modeling::Engine engine, double accuracy) {
  if (engine == modeling::Engine::kTriangles) return {};
  if (engine == modeling::Engine::kQuadratic) return {std::min(1e-2 * accuracy, 1e-4)};
  return {1e-3 * accuracy};
}

modeling::MeshSettings meshSettings(const modeling::Project& project, const BuildOptions& options) {
  modeling::MeshSettings settings = project.mesh;
  if (options.edgeLength) settings.edgeLength = *options.edgeLength;
  return settings;
}

/// Unit tractions (scaled) on the free coefficient that moved farthest.
bem::BoundaryField forceOnMoved(const bem::Discretisation& now, const bem::Discretisation& former,
                                const bem::DegreesOfFreedom& dofs) {
  int farthest = -1;
  double largest = -1;
  for (int k = 0; k < now.displacementCount(); ++k)
    if (const double distance = (now.places()[k] - former.places()[k]).squaredNorm();
        dofs.isFree(k) && distance > largest) {
      farthest = k;
      largest = distance;
    }
  Eigen::VectorXd known = Eigen::VectorXd::Zero(dofs.nodalCount());
  if (farthest >= 0) known.segment<3>(3 * static_cast<Eigen::Index>(farthest)).setOnes();
  return dofs.expand(Eigen::VectorXd::Zero(dofs.count()), known);
}

}  // namespace

ModelBuilder::ModelBuilder(const modeling::Project& project, const BuildOptions& options,
                           const Job& job)
    : options_(options),
      job_(job),
      settings_(meshSettings(project, options)),
      geometry_(project),
      precision_(options.precision) {}

double ModelBuilder::lap() {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - std::exchange(lapStart_, now)).count();
}

bem::Precision ModelBuilder::checkFits(const bem::ProblemSize& size) const {
  const modeling::Engine engine = modeling::engineOf(geometry_.project());
  bem::Precision precision =
      fittingPrecision(size, engine, options_.precision, options_.memoryLimit);
  if (precision == bem::Precision::kAutomatic &&
      choosesCompressed(size, engine, options_.compressedFrom))
    precision = bem::Precision::kCompressed;
  app::checkMemory(settings_, engine, size, precision, options_.memoryLimit);
  return precision;
}

void ModelBuilder::prepare() {
  checkExpectedMemory();
  mesh();
  check();
  setUp();
  checkMemory();
}

void ModelBuilder::checkExpectedMemory() const {
  if (geometry_.usesSplines()) {
    const double coefficients = geometry_.refinement().coefficients;
    checkFits({coefficients, kSlotsPerCoefficient * coefficients});
  } else {
    const double nodes =
        modeling::estimateNodeCount(geometry_.project().body, settings_, geometry_.regions(),
                                    modeling::meshFoci(geometry_.project()));
    checkFits({nodes, nodes});
  }
}

void ModelBuilder::mesh() {
  mesh_ = modeling::mesh(geometry_.project().body, settings_, geometry_.regions(), job_,
                         modeling::meshFoci(geometry_.project()));
  job_.throwIfCancelled();
  report_.meshSeconds = lap();
}

bool ModelBuilder::moveMesh(const modeling::Solid& formerSolid, const TouchModel& former) {
  if (geometry_.usesSplines()) {
    mesh();
    return true;
  }
  auto followed = modeling::followSolid(former.surface(), formerSolid, geometry_.solid(),
                                        geometry_.regions(), {}, job_);
  if (!followed.update) return false;
  mesh_ = std::move(followed.update->mesh);
  report_.meshSeconds = lap();
  return true;
}

void ModelBuilder::check() {
  job_.report(Phase::kCheck, 0);
  report_.warnings = std::make_shared<const std::vector<modeling::GeometryFinding>>(
      modeling::checkGeometry(mesh_, geometry_.project().body, job_));
  job_.report(Phase::kCheck, 1);
  if (!report_.warnings->empty() && report_.warnings->front().isError)
    throw GeometryError(report_.warnings, geometry_.project().body);
  report_.checkSeconds = lap();
}

void ModelBuilder::setUp() {
  job_.report(Phase::kSetup, 0);
  BoundarySetup setup = makeBoundarySetup(geometry_, mesh_);
  model_.reset(new TouchModel(geometry_.project().body, std::move(mesh_), std::move(setup)));
  report_.meshSeconds += lap();
  job_.report(Phase::kSetup, 1);
}

bem::ProblemInputs ModelBuilder::problemInputs() const {
  const BoundarySetup& setup = model_->setup();
  return {setup.conditions.ofSlot, setup.material,
          options_.assembly.value_or(assemblyFor(setup.engine, geometry_.project().mesh.accuracy)),
          precision_};
}

void ModelBuilder::checkMemory() {
  precision_ = checkFits(bem::sizeOf(*model_->setup().discretisation));
}

void ModelBuilder::makeProblem(const TouchModel* former) {
  const bem::Discretisation& discretisation = *model_->setup().discretisation;
  const bem::ProblemInputs inputs = problemInputs();
  model_->key_ = ModelCache::keyOf(discretisation, inputs);
  if (former && former->key() == model_->key() && !former->report().residual)
    model_->problem_ = former->problem();
  else if (!options_.storedModel.empty())
    readStored(inputs);
  if (!model_->problem_ && options_.cache)
    model_->problem_ =
        options_.cache->read(model_->key(), discretisation, inputs, job_, report_.notice);
  if (model_->problem_) {
    report_.readSeconds = lap();
    return;
  }
  bem::ReferenceProblemTimes times;
  const auto make = options_.makeProblem ? options_.makeProblem : bem::makeReferenceProblem;
  model_->problem_ = make(discretisation, inputs, job_, &times);
  report_.assembleSeconds = times.assemble;
  report_.factoriseSeconds = times.factorise;
}

void ModelBuilder::readStored(const bem::ProblemInputs& inputs) {
  const bem::Discretisation& discretisation = *model_->setup().discretisation;
  const std::string name = options_.storedModel.string();
  StoredModel stored = readStoredModel(options_.storedModel, discretisation, inputs, job_);
  if (stored.fit == StoredModelFit::kFits) {
    model_->problem_ = std::move(stored.problem);
    bem::ProblemInputs compressed = inputs;
    compressed.precision = bem::Precision::kCompressed;
    model_->key_ = ModelCache::keyOf(discretisation, compressed);
    return;
  }
  const bool isDamaged = stored.fit == StoredModelFit::kDamaged;
  if (isDamaged) report_.notice = name + ": is not a complete stored model and was not used";
  if (!options_.needsStoredModel) return;
  if (isDamaged)
    throw modeling::ModelingError(
        name + ": is not a complete stored model of this version; compute it again with palpa-mpi");
  if (stored.fit == StoredModelFit::kMissing)
    throw modeling::ModelingError(name + ": cannot be read",
                                  modeling::ModelingError::Kind::kNotFound);
  throw modeling::ModelingError(
      name +
      ": was computed for another mesh, other supports or another material; compute it "
      "again with palpa-mpi, with the same options of the mesh");
}

bool ModelBuilder::updateProblem(const TouchModel& former) {
  const BoundarySetup& setup = model_->setup();
  if (setup.conditions.ofSlot != former.setup().conditions.ofSlot) return false;
  const bem::ProblemInputs inputs = problemInputs();
  model_->key_ = ModelCache::keyOf(*setup.discretisation, inputs);
  bem::ReferenceProblemTimes times;
  model_->problem_ =
      bem::updateDenseReferenceProblem(former.problem(), *former.setup().discretisation,
                                       *setup.discretisation, inputs, job_, &times);
  report_.assembleSeconds = times.assemble;
  return model_->problem_ != nullptr;
}

void ModelBuilder::addBodyForce() {
  const BoundarySetup& setup = model_->setup();
  const bem::Bulk bulk = setup.bulk();
  if (!bulk.hasBodyForce()) return;
  model_->bodyForceTerm_ =
      setup.discretisation->bodyForceTerm(model_->problem()->dofs(), bulk, job_);
  model_->bodyForceWork_ = setup.discretisation->bodyForceWork(bulk);
}

void ModelBuilder::solveAtRest() {
  lap();
  job_.throwIfCancelled();
  job_.report(Phase::kSolve, 0);
  addBodyForce();
  const bem::ReferenceProblem& problem = *model_->problem();
  model_->rest_ = model_->describe(
      problem.solveField(problem.dofs().knownField(model_->setup().conditions),
                         bem::ReferenceProblem::Effort::kRefined, job_, model_->bodyForceTerm()),
      {});
  report_.solveSeconds = lap();
  job_.report(Phase::kSolve, 1);
}

bool ModelBuilder::solveUpdateAtRest(const TouchModel& former) {
  lap();
  // Two fields, because the equations of the state at rest may be easy or trivial: the residual
  // must also be small for a force where the surface moved farthest.
  const bem::ReferenceProblem& problem = *model_->problem();
  const bem::BoundaryField rest = problem.dofs().knownField(model_->setup().conditions),
                           force = forceOnMoved(*model_->setup().discretisation,
                                                *former.setup().discretisation, problem.dofs());
  bem::BoundaryField known{Eigen::MatrixXd(rest.u.rows(), 2), Eigen::MatrixXd(rest.p.rows(), 2)};
  known.u << rest.u, force.u;
  known.p << rest.p, force.p;
  addBodyForce();
  Eigen::MatrixXd term;
  if (model_->bodyForceTerm().size() > 0) {
    term = Eigen::MatrixXd::Zero(problem.dofs().count(), 2);
    term.col(0) = model_->bodyForceTerm();
  }
  bem::BoundaryField field =
      problem.solveField(known, bem::ReferenceProblem::Effort::kFast, job_, term);
  report_.residual = problem.relativeResidual(field, job_, term);
  if (!(*report_.residual <= kMaxResidual)) return false;
  model_->rest_ = model_->describe({field.u.leftCols<1>(), field.p.leftCols<1>()}, {});
  report_.solveSeconds = lap();
  return true;
}

std::shared_ptr<const TouchModel> ModelBuilder::finish() {
  const modeling::SurfaceMesh& mesh = model_->surface();
  report_.nodes = static_cast<int>(mesh.positions.size());
  report_.triangles = static_cast<int>(mesh.triangles.size());
  report_.quality = modeling::measureQuality(mesh);
  report_.memory = static_cast<double>(model_->problem()->bytes());
  report_.storage = model_->problem()->storageName();
  model_->report_ = std::move(report_);
  return std::move(model_);
}

}  // namespace palpa::app
