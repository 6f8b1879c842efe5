#include "app/core/touch_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>

#include "app/core/memory.h"

namespace palpa::app {
namespace {

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

/// Refuses a model that does not fit into memory, with the numbers and with an edge length that
/// would.
void checkMemory(double nodes, double slots, double edgeLength, const BuildOptions& options) {
  const double limit = options.memoryLimit > 0 ? options.memoryLimit : 0.85 * availableMemory();
  if (limit <= 0) return;
  // Numbers beyond the range of int are still to be reported.
  const double chosenNodes = std::min(nodes, 1e8), chosenSlots = std::min(slots, 1e8);
  const double bytes = bem::estimateBytes(static_cast<int>(chosenNodes),
                                          static_cast<int>(chosenSlots), options.precision) *
                       (nodes / chosenNodes) * (nodes / chosenNodes);
  if (bytes <= limit) return;
  // Memory grows with the square of the number of nodes, which grows with 1 / edge length squared.
  const double fitting = edgeLength * std::pow(bytes / limit, 0.25) * 1.05;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "an edge length of %.4g mm needs about %.3g nodes and %s of memory; %s can be used. "
      "Take an edge length of %.2g mm or more",
      edgeLength, nodes, formatBytes(bytes).c_str(), formatBytes(limit).c_str(), fitting);
  throw bem::SolverError(bem::SolverError::Kind::kTooLarge, text);
}

/// Work of modeling under a job of bem: the same stop token and progress, the same Cancelled.
template <class Work>
auto underJob(const bem::Job& job, const Work& work) {
  try {
    return work(modeling::Job{job.stop, job.progress});
  } catch (const modeling::Cancelled&) {
    throw bem::Cancelled{};
  }
}

/// The warnings; throws GeometryError when there are errors.
GeometryError::Findings checkSurface(const modeling::SurfaceMesh& surface,
                                     const modeling::Body& body, const bem::Job& job) {
  job.report("check", 0);
  auto findings = std::make_shared<const std::vector<modeling::GeometryFinding>>(underJob(
      job,
      [&](const modeling::Job& inner) { return modeling::checkGeometry(surface, body, inner); }));
  job.report("check", 1);
  if (!findings->empty() && findings->front().isError) throw GeometryError(std::move(findings));
  return findings;
}

}  // namespace

double TouchState::Contact::patchRadius() const {
  double reach = 0;
  for (const auto& mask : patch)
    reach = std::max(reach, (mask.point.position - at).norm() + 0.5 * mask.radius);
  return reach;
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
  state.energy =
      surface ? surface->strainEnergy(u, p) : setup_.discretisation->strainEnergy(u, p);
  return state;
}

std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options,
                                                  const bem::Job& job) {
  modeling::MeshSettings settings = project.mesh;
  if (options.edgeLength) settings.edgeLength = *options.edgeLength;
  Stopwatch watch;
  const auto regions = modeling::meshRegions(project);
  const double expected = modeling::estimateNodeCount(project.body, settings, regions);
  checkMemory(expected, expected, settings.edgeLength, options);
  modeling::SurfaceMesh surface = underJob(job, [&](const modeling::Job& inner) {
    return modeling::mesh(project.body, settings, regions, inner);
  });
  job.throwIfCancelled();
  BuildReport report;
  report.meshSeconds = watch.lap();
  report.warnings = checkSurface(surface, project.body, job);
  report.checkSeconds = watch.lap();
  report.nodes = static_cast<int>(surface.positions.size());
  report.triangles = static_cast<int>(surface.triangles.size());
  report.quality = modeling::measureQuality(surface);
  BoundarySetup setup = makeBoundarySetup(project, surface);
  checkMemory(report.nodes, setup.discretisation->slots().count(), settings.edgeLength, options);
  std::shared_ptr<TouchModel> model(
      new TouchModel(project.body, std::move(surface), std::move(setup)));
  report.meshSeconds += watch.lap();

  const BoundarySetup& parts = model->setup_;
  model->key_ = ModelCache::keyOf(parts, options.assembly, options.precision);
  if (options.cache)
    model->problem_ =
        options.cache->read(model->key_, parts, options.precision, job, report.notice);
  if (model->problem_) {
    report.readSeconds = watch.lap();
  } else {
    bem::ReferenceProblemTimes times;
    model->problem_ = parts.discretisation->makeProblem(
        parts.conditions.ofSlot, parts.material, options.assembly, options.precision, job, &times);
    report.assembleSeconds = times.assemble;
    report.factoriseSeconds = times.factorise;
  }
  report.memory = static_cast<double>(model->problem_->bytes());
  watch.lap();
  job.throwIfCancelled();
  job.report("solve", 0);
  const bem::DegreesOfFreedom& dofs = model->problem_->dofs();
  model->rest_ =
      model->describe(model->problem_->solveField(dofs.knownField(parts.conditions),
                                                  bem::ReferenceProblem::Effort::kRefined, job),
                      {});
  report.solveSeconds = watch.lap();
  job.report("solve", 1);
  model->report_ = report;
  return model;
}

}  // namespace palpa::app
