#include "app/core/model/touch_model.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "app/core/model/model_memory.h"
#include "app/core/setup/spline_refinement.h"
#include "app/core/system/memory.h"
#include "modeling/editing/change.h"
#include "modeling/mesh/mesh_follow.h"

namespace palpa::app {
namespace {

/// An update that fulfils its equations worse than this is not shown: its motion was too large.
constexpr double kMaxResidual = 1e-4;

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The warnings; throws GeometryError when there are errors.
GeometryError::Findings checkSurface(const modeling::SurfaceMesh& surface,
                                     const modeling::Body& body, const Job& job) {
  job.report("check", 0);
  auto findings = std::make_shared<const std::vector<modeling::GeometryFinding>>(
      modeling::checkGeometry(surface, body, job));
  job.report("check", 1);
  if (!findings->empty() && findings->front().isError) throw GeometryError(std::move(findings));
  return findings;
}

modeling::MeshSettings meshSettings(const modeling::Project& project, const BuildOptions& options) {
  modeling::MeshSettings settings = project.mesh;
  if (options.edgeLength) settings.edgeLength = *options.edgeLength;
  return settings;
}

bem::AssemblyOptions assemblyOptions(const modeling::Project& project,
                                     const BuildOptions& options) {
  return options.assembly.value_or(usesSplines(project)
                                       ? bem::AssemblyOptions{1e-3 * project.mesh.accuracy}
                                       : bem::AssemblyOptions{});
}

/// A mesh of a solid whose control points have moved, for an update: with triangles that of the
/// former shape, carried along; none when it has to be made anew. Splines do not depend on it.
std::optional<modeling::SurfaceMesh> followed(const modeling::Project& project,
                                              const modeling::Solid& solid,
                                              const modeling::Project& formerProject,
                                              const TouchModel& former, const BuildOptions& options,
                                              const Job& job) {
  const auto regions = modeling::meshRegions(project);
  if (usesSplines(project))
    return modeling::mesh(project.body, meshSettings(project, options), regions, job);
  auto followed = modeling::followSolid(
      former.surface(), std::get<modeling::Solid>(formerProject.body), solid, regions, {}, job);
  if (!followed.update) return std::nullopt;
  return std::move(followed.update->mesh);
}

/// Unit tractions (scaled) on the free coefficient whose place differs most from the former one.
bem::BoundaryField forceOnMoved(const bem::Discretisation& now, const bem::Discretisation& former,
                                const bem::DegreesOfFreedom& dofs) {
  int most = -1;
  double largest = -1;
  for (int k = 0; k < now.displacementCount(); ++k)
    if (const double way = (now.places()[k] - former.places()[k]).squaredNorm();
        dofs.isFree(k) && way > largest) {
      most = k;
      largest = way;
    }
  Eigen::VectorXd known = Eigen::VectorXd::Zero(dofs.nodalCount());
  if (most >= 0) known.segment<3>(3 * static_cast<Eigen::Index>(most)).setOnes();
  return dofs.expand(Eigen::VectorXd::Zero(dofs.count()), known);
}

}  // namespace

double TouchState::Contact::patchRadius() const {
  double reach = 0;
  for (const auto& mask : patch)
    reach = std::max(reach, (mask.point.position - at).norm() + 0.5 * mask.radius);
  return reach;
}

void TouchModel::setReport(BuildReport report) {
  report_ = std::move(report);
  report_.nodes = static_cast<int>(surface_.positions.size());
  report_.triangles = static_cast<int>(surface_.triangles.size());
  report_.quality = modeling::measureQuality(surface_);
  report_.memory = static_cast<double>(problem_->bytes());
}

TouchState TouchModel::describe(bem::BoundaryField field, std::vector<TouchState::Contact> contacts,
                                const bem::ContactSurface* surface) const {
  TouchState state;
  state.field = std::move(field);
  state.contacts = std::move(contacts);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double largest = 0;
  const auto count = [&](const Eigen::Vector3d& force) {
    sum += force;
    largest = std::max(largest, force.norm());
  };
  // The tractions on a support are what it and any load there exert together.
  const Eigen::VectorXd reaction = state.field.p.col(0) - setup_.conditions.traction;
  for (const auto& support : setup_.supports) {
    state.supports.push_back(
        {support.name, setup_.discretisation->resultant(reaction, support.elements)});
    count(state.supports.back().resultant.force);
  }
  for (const auto& load : setup_.loads) count(load.resultant.force);
  for (const auto& contact : state.contacts) count(contact.force);
  state.balance = sum.norm();
  state.relativeBalance = largest > 0 ? state.balance / largest : 0;
  const auto u = state.field.u.col(0), p = state.field.p.col(0);
  state.energy = surface ? surface->strainEnergy(u, p) : setup_.discretisation->strainEnergy(u, p);
  return state;
}

std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job,
                                                  const TouchModel* former) {
  const modeling::MeshSettings settings = meshSettings(project, options);
  Stopwatch watch;
  const auto regions = modeling::meshRegions(project);
  const bool hasSplines = usesSplines(project);
  const auto checkFits = [&](double coefficients, double slots) {
    checkMemory(settings, hasSplines, coefficients, slots, options.precision, options.memoryLimit);
  };
  std::optional<SplineRefinement> net;
  if (hasSplines) {
    // Half again as many traction coefficients is what bodies with many sharp edges have.
    net = splineRefinement(project);
    checkFits(net->coefficients, 1.5 * net->coefficients);
  } else {
    const double expected = modeling::estimateNodeCount(project.body, settings, regions);
    checkFits(expected, expected);
  }
  modeling::SurfaceMesh surface = modeling::mesh(project.body, settings, regions, job);
  job.throwIfCancelled();
  BuildReport report;
  report.meshSeconds = watch.lap();
  report.warnings = checkSurface(surface, project.body, job);
  report.checkSeconds = watch.lap();
  job.report("setup", 0);
  BoundarySetup setup = makeBoundarySetup(project, surface, net ? &*net : nullptr);
  checkFits(setup.discretisation->displacementCount(), setup.discretisation->slots().count());
  std::shared_ptr<TouchModel> model(
      new TouchModel(project.body, std::move(surface), std::move(setup)));
  report.meshSeconds += watch.lap();
  job.report("setup", 1);

  const BoundarySetup& parts = model->setup_;
  const bem::AssemblyOptions assembly = assemblyOptions(project, options);
  model->key_ = ModelCache::keyOf(parts, assembly, options.precision);
  if (former && former->key_ == model->key_ && !former->report_.residual)
    model->problem_ = former->problem_;
  else if (options.cache)
    model->problem_ =
        options.cache->read(model->key_, parts, options.precision, job, report.notice);
  if (model->problem_) {
    report.readSeconds = watch.lap();
  } else {
    bem::ReferenceProblemTimes times;
    model->problem_ = parts.discretisation->makeProblem(parts.conditions.ofSlot, parts.material,
                                                        assembly, options.precision, job, &times);
    report.assembleSeconds = times.assemble;
    report.factoriseSeconds = times.factorise;
  }
  watch.lap();
  job.throwIfCancelled();
  job.report("solve", 0);
  model->rest_ = model->describe(
      model->problem_->solveField(model->problem_->dofs().knownField(parts.conditions),
                                  bem::ReferenceProblem::Effort::kRefined, job),
      {});
  report.solveSeconds = watch.lap();
  job.report("solve", 1);
  model->setReport(std::move(report));
  return model;
}

std::shared_ptr<const TouchModel> updateTouchModel(const modeling::Project& project,
                                                   const modeling::Project& formerProject,
                                                   const TouchModel& former,
                                                   const BuildOptions& options, const Job& job) {
  const auto* solid = std::get_if<modeling::Solid>(&project.body);
  const modeling::Change change = modeling::compare(formerProject, project);
  const bool hasSplines = usesSplines(project);
  if (!solid || former.report_.residual || change.topology || change.edges || change.patchNames ||
      change.material || change.supports || change.loads || change.mesh ||
      (hasSplines && change.touches))
    return nullptr;
  // Beside the update, which is never larger than the former model, its own must find place.
  if (const double available = availableMemory();
      available > 0 && 2 * former.report_.memory > 0.85 * available)
    return nullptr;
  Stopwatch watch;
  job.report("update", 0);
  const Job inner{job.stop, {}, job.threads};
  std::optional<modeling::SurfaceMesh> surface =
      followed(project, *solid, formerProject, former, options, inner);
  if (!surface) return nullptr;
  BuildReport report;
  report.meshSeconds = watch.lap();
  report.warnings = checkSurface(*surface, project.body, inner);
  report.checkSeconds = watch.lap();
  BoundarySetup setup = makeBoundarySetup(project, *surface);
  if (setup.conditions.ofSlot != former.setup_.conditions.ofSlot) return nullptr;
  std::shared_ptr<TouchModel> model(
      new TouchModel(project.body, std::move(*surface), std::move(setup)));
  report.meshSeconds += watch.lap();
  job.report("update", 0.2);

  const BoundarySetup& parts = model->setup_;
  const bem::AssemblyOptions assembly = assemblyOptions(project, options);
  model->key_ = ModelCache::keyOf(parts, assembly, options.precision);
  bem::ReferenceProblemTimes times;
  model->problem_ = parts.discretisation->updateProblem(
      former.problem_, *former.setup_.discretisation, parts.conditions.ofSlot, parts.material,
      assembly, inner, &times);
  if (!model->problem_) return nullptr;
  report.assembleSeconds = times.assemble;
  watch.lap();
  job.report("update", 0.5);
  // With the state at rest, whose equations may be easy or trivial, that of a force where the
  // surface moved most.
  const bem::ReferenceProblem& problem = *model->problem_;
  const bem::BoundaryField rest = problem.dofs().knownField(parts.conditions),
                           force = forceOnMoved(*parts.discretisation,
                                                *former.setup_.discretisation, problem.dofs());
  bem::BoundaryField known{Eigen::MatrixXd(rest.u.rows(), 2), Eigen::MatrixXd(rest.p.rows(), 2)};
  known.u << rest.u, force.u;
  known.p << rest.p, force.p;
  bem::BoundaryField field = problem.solveField(known, bem::ReferenceProblem::Effort::kFast, inner);
  report.residual = problem.relativeResidual(field, inner);
  if (!(*report.residual <= kMaxResidual)) return nullptr;
  model->rest_ = model->describe({field.u.leftCols<1>(), field.p.leftCols<1>()}, {});
  report.solveSeconds = watch.lap();
  job.report("update", 1);
  model->setReport(std::move(report));
  return model;
}

}  // namespace palpa::app
