#include "app/core/touch_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>

#include "app/core/analysis_net.h"
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

/// What to say of a model that would need so many times the memory there is.
using Advice = std::function<std::string(double excess, double count)>;

/// Memory grows with the square of the number of unknowns, which grows with 1 / length squared.
double fittingLength(double length, double excess) {
  return length * std::pow(excess, 0.25) * 1.05;
}

Advice edgeLengthAdvice(const modeling::MeshSettings& settings) {
  return [length = settings.edgeLength](double excess, double count) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "an edge length of %.4g mm needs about %.3g nodes; take %.2g mm or more", length,
                  count, fittingLength(length, excess));
    return std::string(text);
  };
}

Advice splineAdvice(const modeling::Project& project) {
  return [mesh = project.mesh](double excess, double count) {
    char text[200];
    if (mesh.elementLength)
      std::snprintf(text, sizeof text,
                    "spline elements of %.4g mm need about %.3g coefficients; take %.2g mm or more",
                    *mesh.elementLength, count, fittingLength(*mesh.elementLength, excess));
    else
      std::snprintf(
          text, sizeof text,
          "an accuracy of %.2g %% needs about %.3g spline coefficients; wish for less, or "
          "set the size of the elements",
          100 * mesh.accuracy, count);
    return std::string(text);
  };
}

/// Refuses a model that does not fit into memory, with the numbers and what would.
void checkMemory(double nodes, double slots, const BuildOptions& options, const Advice& advice) {
  const double limit = options.memoryLimit > 0 ? options.memoryLimit : 0.85 * availableMemory();
  if (limit <= 0) return;
  // Numbers beyond the range of int are still to be reported.
  const double chosenNodes = std::min(nodes, 1e8), chosenSlots = std::min(slots, 1e8);
  const double bytes = bem::estimateBytes(static_cast<int>(chosenNodes),
                                          static_cast<int>(chosenSlots), options.precision) *
                       (nodes / chosenNodes) * (nodes / chosenNodes);
  if (bytes <= limit) return;
  throw bem::SolverError(bem::SolverError::Kind::kTooLarge,
                         "the model needs " + formatBytes(bytes) + " of memory, and " +
                             formatBytes(limit) + " can be used: " + advice(bytes / limit, nodes));
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
  state.energy = surface ? surface->strainEnergy(u, p) : setup_.discretisation->strainEnergy(u, p);
  return state;
}

std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options,
                                                  const bem::Job& job) {
  modeling::MeshSettings settings = project.mesh;
  if (options.edgeLength) settings.edgeLength = *options.edgeLength;
  Stopwatch watch;
  const auto regions = modeling::meshRegions(project);
  const bool hasSplines = usesSplines(project);
  std::optional<AnalysisNet> net;
  if (hasSplines) {
    // Half again as many traction coefficients is what bodies with many sharp edges have.
    net = analysisNet(project);
    const double expected = net->coefficients;
    checkMemory(expected, 1.5 * expected, options, splineAdvice(project));
  } else {
    const double expected = modeling::estimateNodeCount(project.body, settings, regions);
    checkMemory(expected, expected, options, edgeLengthAdvice(settings));
  }
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
  job.report("setup", 0);
  BoundarySetup setup = makeBoundarySetup(project, surface, net ? &*net : nullptr);
  checkMemory(setup.discretisation->displacementCount(), setup.discretisation->slots().count(),
              options, hasSplines ? splineAdvice(project) : edgeLengthAdvice(settings));
  std::shared_ptr<TouchModel> model(
      new TouchModel(project.body, std::move(surface), std::move(setup)));
  report.meshSeconds += watch.lap();
  job.report("setup", 1);

  const BoundarySetup& parts = model->setup_;
  const bem::AssemblyOptions assembly = options.assembly.value_or(
      hasSplines ? bem::AssemblyOptions{1e-3 * project.mesh.accuracy} : bem::AssemblyOptions{});
  model->key_ = ModelCache::keyOf(parts, assembly, options.precision);
  if (options.cache)
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
