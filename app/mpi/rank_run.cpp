#include "app/mpi/rank_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

#include "app/core/model/content_hash.h"
#include "app/core/model/model_memory.h"
#include "app/core/model/stored_model.h"
#include "app/core/system/memory.h"
#include "bem/base/error.h"
#include "bem/compressed/make_problem.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"

namespace palpa::mpi {

using Json = nlohmann::ordered_json;

namespace {

/// No limit for a model on one machine: checkMemory() knows the ranks.
constexpr double kUnlimited = 1e30;

Json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

std::string toText(const Eigen::Vector3d& v) {
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", v.x(), v.y(), v.z());
  return text.data();
}

std::string secondsText(double seconds) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.2f s", seconds);
  return text.data();
}

}  // namespace

template <class Work>
RankRun::Seconds RankRun::timed(const Work& work) const {
  const auto waitForAll = [this] {
    const MpiTeam::Waiting waiting(team_);
    MPI_Barrier(team_.communicator());
  };
  waitForAll();
  const auto start = std::chrono::steady_clock::now();
  const double begin = team_.workSeconds();
  work();
  const double worked = team_.workSeconds() - begin;
  waitForAll();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), worked};
}

void RankRun::run() {
  const modeling::Project project = modeling::readProject(options_.project);
  if (modeling::engineOf(project) != modeling::Engine::kQuadratic)
    throw modeling::ModelingError(options_.project +
                                  ": the project is not computed with curved triangles, which "
                                  "palpa-mpi needs; set its engine "
                                  "to \"quadratic\" (mesh.engine)");
  app::BuildOptions build;
  build.edgeLength = options_.edgeLength;
  build.precision = bem::Precision::kCompressed;
  build.memoryLimit = kUnlimited;
  build.makeProblem = [this](const auto&... arguments) { return makeProblem(arguments...); };
  model_ = app::buildTouchModel(project, build, job_);
  computeColumns(project);
  if (!project.touches.empty())
    touchSeconds_ = timed([&] { touched_ = app::playTouches(*model_, project.touches, 0, job_); });
  storeSeconds_ = timed([&] { store(); });
  gatherFigures();
}

void RankRun::gatherFigures() {
  peaks_.resize(static_cast<std::size_t>(team_.count()));
  const double peak = app::peakMemory();
  MPI_Gather(&peak, 1, MPI_DOUBLE, peaks_.data(), 1, MPI_DOUBLE, 0, team_.communicator());
  for (double* work : {&assembleWork_, &factoriseWork_, &columnSeconds_.work}) {
    const double own = *work;
    MPI_Reduce(&own, work, 1, MPI_DOUBLE, MPI_MAX, 0, team_.communicator());
  }
}

void RankRun::checkSameMesh(const bem::Discretisation& on) const {
  app::ContentHash hash;
  on.write([&](std::span<const std::byte> bytes) { hash.add(bytes.data(), bytes.size()); });
  const XXH128_hash_t value = hash.value();
  const std::array<std::uint64_t, 2> key{value.high64, value.low64};
  std::array<std::uint64_t, 2> ofFirst = key;
  MPI_Bcast(ofFirst.data(), 2, MPI_UINT64_T, 0, team_.communicator());
  if (key != ofFirst)
    throw bem::SolverError(bem::SolverError::Kind::kBadMesh,
                           "this rank has another mesh than rank 0; run palpa-mpi on machines with "
                           "the same processors and the same installation");
}

void RankRun::checkMemory(const bem::Discretisation& on) const {
  // Every rank has the factors and its part of the operators, rank 0 all of them in the end.
  constexpr double kOfFactors = 0.5;
  // Ranks store right factors as they are.
  constexpr double kWithoutBases = 1.25;
  const double whole =
      kWithoutBases * bem::expectedBytes(bem::sizeOf(on), true, bem::Precision::kCompressed);
  double mine = whole * (kOfFactors + (1 - kOfFactors) / team_.count());
  if (team_.index() == 0) mine = whole;
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(team_.communicator(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  double here = 0, usable = app::usableMemory(0);
  int ranks = 0;
  MPI_Comm_size(machine, &ranks);
  MPI_Allreduce(&mine, &here, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Bcast(&usable, 1, MPI_DOUBLE, 0, machine);
  MPI_Comm_free(&machine);
  if (usable > 0 && here > usable)
    throw bem::SolverError(
        bem::SolverError::Kind::kTooLarge,
        "the model needs " + app::formatBytes(here) + " for " + std::to_string(ranks) +
            " ranks on this machine, and " + app::formatBytes(usable) +
            " can be used; start fewer ranks on each machine, or take a longer edge length");
}

std::unique_ptr<bem::ReferenceProblem> RankRun::makeProblem(const bem::Discretisation& on,
                                                            const bem::ProblemInputs& inputs,
                                                            const Job& job,
                                                            bem::ReferenceProblemTimes* times) {
  checkSameMesh(on);
  checkMemory(on);
  inputs_ = inputs;
  bem::CompressionOptions compression;
  compression.operators = options_.tolerance;
  const double begin = team_.workSeconds();
  double assembled = begin;
  Job noting = job;
  noting.progress = [&](Phase phase, double fraction) {
    if (phase == Phase::kAssemble) assembled = team_.workSeconds();
    job.report(phase, fraction);
  };
  auto share =
      bem::makeCompressedReferenceProblem(dynamic_cast<const bem::QuadraticDiscretisation&>(on),
                                          inputs, compression, noting, times, &team_);
  assembleWork_ = assembled - begin;
  factoriseWork_ = team_.workSeconds() - assembled;
  auto problem = std::make_unique<SharedProblem>(std::move(share), team_);
  problem_ = problem.get();
  operatorBytes_ = static_cast<double>(problem->operatorBytes());
  return problem;
}

void RankRun::computeColumns(const modeling::Project& project) {
  if (options_.columns == 0 || project.touches.empty()) return;
  bem::GreensColumns columns(model_->problem());
  const auto& places = model_->setup().discretisation->places();
  std::vector<int> nodes;
  for (const modeling::Touch& touch : project.touches) {
    std::vector<int> near = columns.nodesNear(places, touch.at);
    near.resize(std::min<std::size_t>(near.size(), static_cast<std::size_t>(options_.columns)));
    nodes.insert(nodes.end(), near.begin(), near.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  columnSeconds_ = timed([&] { columns.compute(nodes, job_); });
  columns_ = columns.copyOf(nodes);
}

void RankRun::store() {
  const auto whole = problem_->whole();
  problem_ = nullptr;
  if (!whole) return;
  whole->setKnownColumns(columns_);
  app::writeStoredModel(options_.model, *model_->setup().discretisation, inputs_, *whole, job_);
}

Json RankRun::json() const {
  const app::BuildReport& build = model_->report();
  Json report{{"ranks", team_.count()},
              {"nodes", build.nodes},
              {"unknowns", model_->problem()->dofs().count()},
              {"model", options_.model}};
  report["supports"] = Json::array();
  const app::TouchState& state = touched_ ? *touched_ : model_->rest();
  for (const auto& support : state.supports)
    report["supports"].push_back(
        {{"name", support.name}, {"force_N", toJson(support.resultant.force)}});
  report["contacts"] = Json::array();
  for (const auto& contact : state.contacts)
    report["contacts"].push_back({{"name", contact.name}, {"force_N", toJson(contact.force)}});
  report["columns"] = columns_.values.cols();
  report["seconds"] = {{"mesh", build.meshSeconds},         {"check", build.checkSeconds},
                       {"assemble", build.assembleSeconds}, {"factorise", build.factoriseSeconds},
                       {"solve", build.solveSeconds},       {"columns", columnSeconds_.wall},
                       {"touch", touchSeconds_.wall},       {"store", storeSeconds_.wall}};
  report["work_seconds"] = {
      {"assemble", assembleWork_}, {"factorise", factoriseWork_}, {"columns", columnSeconds_.work}};
  report["memory_bytes"] = {
      {"operators", operatorBytes_}, {"factors", build.memory - operatorBytes_}, {"peaks", peaks_}};
  return report;
}

std::string RankRun::text() const {
  const app::BuildReport& build = model_->report();
  std::string text = "ranks      " + std::to_string(team_.count()) + ", " +
                     std::to_string(build.nodes) + " nodes, " +
                     std::to_string(model_->problem()->dofs().count()) + " unknowns\n";
  text += "time       mesh " + secondsText(build.meshSeconds + build.checkSeconds) + ", assemble " +
          secondsText(build.assembleSeconds) + ", factorise " +
          secondsText(build.factoriseSeconds) + ", solve " + secondsText(build.solveSeconds);
  if (columns_.values.cols() > 0)
    text += ", " + std::to_string(columns_.values.cols()) + " columns " +
            secondsText(columnSeconds_.wall);
  text += "\nmemory     " + app::formatBytes(*std::max_element(peaks_.begin(), peaks_.end())) +
          " at most on a rank\n";
  const app::TouchState& state = touched_ ? *touched_ : model_->rest();
  for (const auto& support : state.supports)
    text += "support    " + support.name + ": force " + toText(support.resultant.force) + " N\n";
  for (const auto& contact : state.contacts)
    text += "contact    " + contact.name + ": force " + toText(contact.force) + " N\n";
  return text + "written    " + options_.model + "\n";
}

}  // namespace palpa::mpi
