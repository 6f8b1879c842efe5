#include "app/core/session/rebuild_pipeline.h"

#include <algorithm>
#include <utility>

#include "app/core/model/suggest_mesh.h"
#include "app/core/results/press_error.h"
#include "app/core/system/destroy_in_background.h"
#include "app/core/system/priority.h"
#include "bem/base/error.h"
#include "modeling/editing/change.h"
#include "modeling/project/missing_density.h"

namespace palpa::app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The same model. The thread that releases it last, such as the window's, does not wait until its
/// memory is returned.
std::shared_ptr<const TouchModel> withBackgroundDestruction(
    std::shared_ptr<const TouchModel> model) {
  const TouchModel* const same = model.get();
  return {same, [held = std::move(model)](const TouchModel*) mutable {
            destroyInBackground(std::move(held));
          }};
}

}  // namespace

RebuildPipeline::RebuildPipeline(BuildOptions options, int threads, std::function<void()> changed)
    : options_(std::move(options)),
      threads_(threads),
      changed_(std::move(changed)),
      worker_(lowerThreadPriority) {}

std::uint64_t RebuildPipeline::submit(modeling::Project snapshot, std::chrono::milliseconds quiet) {
  std::uint64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    revision = ++status_.revision;
    status_.state = RebuildStatus::State::kBuilding;
    status_.phase.reset();
    status_.fraction = 0;
    status_.progress = 0;
    status_.stages.clear();
    progress_.restart();
    status_.error.clear();
    status_.reason = {};
    isKeepDue_ = false;
    notBefore_ = Clock::now() + quiet;
    worker_.replace([this, revision, project = std::move(snapshot)](const std::stop_token& stop) {
      build(revision, project, stop);
    });
  }
  notify();
  return revision;
}

void RebuildPipeline::startPending() {
  {
    const std::lock_guard lock(mutex_);
    notBefore_ = Clock::now();
  }
  due_.notify_one();
}

void RebuildPipeline::cancel() {
  {
    const std::lock_guard lock(mutex_);
    if (status_.state != RebuildStatus::State::kBuilding) return;
    status_.state = RebuildStatus::State::kCancelled;
    closeStage();
    worker_.cancel();
  }
  settled_.notify_all();
  notify();
}

void RebuildPipeline::keepModel() {
  if (!options_.cache) return;
  const std::lock_guard lock(mutex_);
  isKeepDue_ = true;
  if (status_.state == RebuildStatus::State::kUpToDate) postKeep();
}

void RebuildPipeline::postKeep() {
  worker_.post([this](const std::stop_token& stop) { keep(stop); });
}

std::shared_ptr<const TouchModel> RebuildPipeline::model() const {
  const std::lock_guard lock(mutex_);
  return model_;
}

RebuildStatus RebuildPipeline::status() const {
  const std::lock_guard lock(mutex_);
  RebuildStatus status = status_;
  if (status.phase && !status.stages.empty())
    status.stages.back().seconds = secondsSince(stageBegan_);
  return status;
}

bool RebuildPipeline::waitUntilSettled(std::chrono::milliseconds limit) const {
  using State = RebuildStatus::State;
  std::unique_lock lock(mutex_);
  return settled_.wait_for(lock, limit, [&] {
    return status_.state != State::kBuilding &&
           !(status_.state == State::kUpToDate && isKeepDue_) && !isKeeping_;
  });
}

void RebuildPipeline::closeStage() {
  if (!status_.phase || status_.stages.empty()) return;
  status_.stages.back().seconds = secondsSince(stageBegan_);
  status_.phase.reset();
}

void RebuildPipeline::advance(std::uint64_t revision, Phase phase, double fraction) {
  {
    const std::lock_guard lock(mutex_);
    if (!isCurrent(revision)) return;
    if (status_.phase != phase) {
      closeStage();
      if (!status_.stages.empty()) status_.stages.back().fraction = 1;
      status_.stages.push_back({phase, 0, 0});
      status_.phase = phase;
      stageBegan_ = Clock::now();
    }
    status_.fraction = fraction;
    status_.stages.back().fraction = fraction;
    status_.progress = std::max(status_.progress, progress_.at(phase, fraction));
  }
  notify();
}

bool RebuildPipeline::isCurrent(std::uint64_t revision) const {
  return revision == status_.revision && status_.state == RebuildStatus::State::kBuilding;
}

bool RebuildPipeline::waitUntilDue(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested() && Clock::now() < notBefore_)
    due_.wait_until(lock, stop, Clock::time_point(notBefore_),
                    [this] { return Clock::now() >= notBefore_; });
  return !stop.stop_requested();
}

void RebuildPipeline::build(std::uint64_t revision, const modeling::Project& project,
                            const std::stop_token& stop) {
  using State = RebuildStatus::State;
  if (!waitUntilDue(stop)) return;
  const Job job{stop,
                [this, revision](Phase phase, double done) { advance(revision, phase, done); },
                threads_};
  const auto suggestLater = [&] {
    worker_.post([this, revision, project](const std::stop_token& later) {
      suggest(revision, project, later);
    });
  };
  try {
    offerUpdate(revision, project, job);
    auto model = withBackgroundDestruction(buildTouchModel(project, options_, job, former_.get()));
    auto warnings = model->report().warnings;
    former_ = model;
    formerProject_ = project;
    finish(revision, State::kUpToDate, {}, std::move(model), std::move(warnings));
  } catch (const Cancelled&) {
    finish(revision, State::kCancelled, {}, nullptr);
  } catch (const std::bad_alloc&) {
    finish(revision, State::kFailed,
           "there is not enough memory; take a larger edge length or close other programs",
           nullptr);
  } catch (const GeometryError& error) {
    finish(revision, State::kFailed, error.what(), nullptr, error.findings());
    suggestLater();
  } catch (const SupportConflictError& error) {
    finish(revision, State::kFailed, error.what(), nullptr, nullptr,
           {.conflict = error.conflict()});
  } catch (const modeling::EmptyRegionError& error) {
    finish(revision, State::kFailed, error.what(), nullptr, nullptr,
           {.emptyRegion = error.region()});
  } catch (const bem::SolverError& error) {
    finish(revision, State::kFailed, error.what(), nullptr, nullptr,
           {.isFree = error.kind() == bem::SolverError::Kind::kNotFixed});
    if (error.kind() == bem::SolverError::Kind::kTooLarge) suggestLater();
  } catch (const modeling::MissingDensityError& error) {
    finish(revision, State::kFailed, error.what(), nullptr, nullptr, {.needsDensity = true});
  } catch (const modeling::ModelingError& error) {
    finish(revision, State::kFailed, error.what(), nullptr);
    if (error.kind() == modeling::ModelingError::Kind::kTooLarge) suggestLater();
  } catch (const std::exception& error) {
    finish(revision, State::kFailed, error.what(), nullptr);
  }
}

void RebuildPipeline::offerUpdate(std::uint64_t revision, const modeling::Project& project,
                                  const Job& job) {
  // Below, a full rebuild takes less than 0.1 s.
  constexpr int kMinCoefficients = 400;
  if (!former_ || former_->setup().discretisation->displacementCount() < kMinCoefficients) return;
  std::shared_ptr<const TouchModel> model;
  try {
    model = updateTouchModel(project, formerProject_, *former_, options_, job);
  } catch (const std::exception&) {
    // The full rebuild finds the same error and reports it.
  }
  if (!model) return;
  model = withBackgroundDestruction(std::move(model));
  {
    const std::lock_guard lock(mutex_);
    if (!isCurrent(revision)) return;
    take(revision, model);
  }
  notify();
}

void RebuildPipeline::keep(const std::stop_token& stop) {
  std::shared_ptr<const TouchModel> model;
  {
    const std::lock_guard lock(mutex_);
    isKeeping_ = std::exchange(isKeepDue_, false);
    if (!isKeeping_) return;
    model = model_;
  }
  try {
    if (model->problem()->canBeWritten())
      options_.cache->write(model->key(), *model->problem(), {stop, {}, threads_});
  } catch (const Cancelled&) {
    // A newer revision was submitted.
  } catch (const std::exception&) {
    // The model is not stored; the program works without.
  }
  {
    const std::lock_guard lock(mutex_);
    isKeeping_ = false;
  }
  settled_.notify_all();
}

void RebuildPipeline::suggest(std::uint64_t revision, const modeling::Project& project,
                              const std::stop_token& stop) {
  std::optional<modeling::MeshSettings> mesh;
  try {
    mesh = suggestMesh(project, options_, {stop, {}, threads_});
  } catch (const Cancelled&) {
    return;  // a newer revision was submitted
  } catch (const std::exception&) {
    // No suggestion.
  }
  if (!mesh) return;
  {
    const std::lock_guard lock(mutex_);
    if (revision != status_.revision || status_.state != RebuildStatus::State::kFailed) return;
    status_.reason.mesh = std::move(mesh);
  }
  notify();
}

void RebuildPipeline::estimate(const std::stop_token& stop) {
  const std::shared_ptr<const TouchModel> model = this->model();
  const Job job{stop, {}, 1};  // one thread: the others belong to touches and the window
  try {
    setEstimate(*model, &RebuildStatus::condition, model->problem()->conditionEstimate(job));
    estimateAccuracy(*model, job);
  } catch (const Cancelled&) {
    // A newer revision was submitted.
  } catch (const std::exception&) {
    // The estimates stay unknown.
  }
}

void RebuildPipeline::estimateAccuracy(const TouchModel& model, const Job& job) {
  const TouchError error = estimateTouchError(model, job);
  setEstimate(model, &RebuildStatus::touchError, error.relative);
  // Another mesh of the same project shows the order of convergence.
  modeling::Project other = sampledProject_;
  other.mesh = formerProject_.mesh;
  const modeling::Change change = modeling::compare(other, formerProject_);
  if (change.body() || change.supports || change.touches) sample_.reset();
  auto advice = std::make_shared<const AccuracyAdvice>(
      adviseAccuracy(formerProject_, model, error, sample_, options_, job));
  sample_ = AccuracySample{model.setup().discretisation->displacementCount(), error};
  sampledProject_ = formerProject_;
  setEstimate<std::shared_ptr<const AccuracyAdvice>>(model, &RebuildStatus::accuracy,
                                                     std::move(advice));
}

template <class Value>
void RebuildPipeline::setEstimate(const TouchModel& model, Value RebuildStatus::*estimate,
                                  Value value) {
  {
    const std::lock_guard lock(mutex_);
    if (model_.get() != &model) return;
    status_.*estimate = std::move(value);
  }
  notify();
}

void RebuildPipeline::take(std::uint64_t revision, std::shared_ptr<const TouchModel>& model) {
  model_.swap(model);
  status_.modelRevision = revision;
  status_.residual = model_->report().residual;
  status_.condition = 0;
  status_.touchError = 0;
  status_.accuracy.reset();
}

void RebuildPipeline::finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
                             std::shared_ptr<const TouchModel> model,
                             GeometryError::Findings findings, FailureReason reason) {
  {
    const std::lock_guard lock(mutex_);
    if (!isCurrent(revision)) return;
    status_.state = state;
    closeStage();
    status_.fraction = 0;
    status_.error = std::move(error);
    status_.reason = std::move(reason);
    if (findings) status_.findings = std::move(findings);
    if (model) {
      take(revision, model);
      status_.stages.back().fraction = 1;
      for (const BuildStage& stage : status_.stages) progress_.learn(stage.phase, stage.seconds);
      status_.progress = 1;
      if (isKeepDue_) postKeep();
      worker_.post([this](const std::stop_token& stop) { estimate(stop); });
    }
  }
  settled_.notify_all();
  notify();
}

void RebuildPipeline::notify() const {
  if (changed_) changed_();
}

}  // namespace palpa::app
