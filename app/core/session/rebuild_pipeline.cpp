#include "app/core/session/rebuild_pipeline.h"

#include <algorithm>
#include <utility>

#include "app/core/results/error_estimate.h"
#include "app/core/system/destroy_in_background.h"
#include "app/core/system/priority.h"
#include "base/job.h"
#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Progress over all phases: each has a share that fits bodies of some thousand nodes.
double totalProgress(std::string_view phase, double fraction) {
  struct Share {
    std::string_view phase;
    double begin, end;
  };
  for (const auto& [name, begin, end] :
       {Share{"update", 0, 0.04}, Share{"mesh", 0, 0.04}, Share{"check", 0.04, 0.07},
        Share{"setup", 0.07, 0.08}, Share{"read", 0.08, 0.9}, Share{"assemble", 0.08, 0.45},
        Share{"factorise", 0.45, 0.9}, Share{"solve", 0.9, 1}})
    if (name == phase) return begin + fraction * (end - begin);
  return 0;
}

/// The same model; whoever holds it last, the window's thread too, does not wait until its memory
/// is given back.
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
      worker_([this](const std::stop_token& stop) { work(stop); }) {}

RebuildPipeline::~RebuildPipeline() {
  worker_.request_stop();
  const std::lock_guard lock(mutex_);
  current_.request_stop();
}

std::uint64_t RebuildPipeline::submit(modeling::Project snapshot, std::chrono::milliseconds quiet) {
  std::uint64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    revision = ++status_.revision;
    status_.state = RebuildStatus::State::kBuilding;
    status_.phase.clear();
    status_.fraction = 0;
    status_.progress = 0;
    status_.stages.clear();
    status_.error.clear();
    keepDue_ = false;
    waiting_ = std::move(snapshot);
    notBefore_ = Clock::now() + quiet;
    current_.request_stop();
  }
  wake_.notify_one();
  notify();
  return revision;
}

void RebuildPipeline::startPending() {
  {
    const std::lock_guard lock(mutex_);
    notBefore_ = Clock::now();
  }
  wake_.notify_one();
}

void RebuildPipeline::cancel() {
  {
    const std::lock_guard lock(mutex_);
    if (status_.state != RebuildStatus::State::kBuilding) return;
    status_.state = RebuildStatus::State::kCancelled;
    waiting_.reset();
    closeStage();
    current_.request_stop();
  }
  settled_.notify_all();
  notify();
}

void RebuildPipeline::keepModel() {
  if (!options_.cache) return;
  {
    const std::lock_guard lock(mutex_);
    keepDue_ = true;
  }
  wake_.notify_one();
}

std::shared_ptr<const TouchModel> RebuildPipeline::model() const {
  const std::lock_guard lock(mutex_);
  return model_;
}

RebuildStatus RebuildPipeline::status() const {
  const std::lock_guard lock(mutex_);
  RebuildStatus status = status_;
  if (!status.phase.empty() && !status.stages.empty())
    status.stages.back().seconds = secondsSince(stageBegan_);
  return status;
}

bool RebuildPipeline::waitUntilSettled(std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  return settled_.wait_for(lock, most, [&] {
    return status_.state != RebuildStatus::State::kBuilding && nextTask() != Task::kKeep &&
           !isKeeping_;
  });
}

std::optional<RebuildPipeline::Task> RebuildPipeline::nextTask() const {
  if (waiting_) return Clock::now() >= notBefore_ ? std::optional(Task::kBuild) : std::nullopt;
  if (status_.state != RebuildStatus::State::kUpToDate) return std::nullopt;
  if (keepDue_) return Task::kKeep;
  if (estimateDue_) return Task::kEstimate;
  return std::nullopt;
}

std::optional<RebuildPipeline::Task> RebuildPipeline::waitForTask(
    std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (const std::optional<Task> task = nextTask()) return task;
    const auto isTask = [&] { return nextTask().has_value(); };
    if (waiting_)
      wake_.wait_until(lock, stop, Clock::time_point(notBefore_), isTask);
    else
      wake_.wait(lock, stop, [&] { return waiting_ || isTask(); });
  }
  return std::nullopt;
}

void RebuildPipeline::closeStage() {
  if (status_.phase.empty() || status_.stages.empty()) return;
  status_.stages.back().seconds = secondsSince(stageBegan_);
  status_.phase.clear();
}

void RebuildPipeline::advance(std::uint64_t revision, std::string_view phase, double fraction) {
  {
    const std::lock_guard lock(mutex_);
    if (status_.revision != revision || status_.state != RebuildStatus::State::kBuilding) return;
    if (status_.phase != phase) {
      closeStage();
      if (!status_.stages.empty()) status_.stages.back().fraction = 1;
      status_.stages.push_back({std::string(phase), 0, 0});
      status_.phase = phase;
      stageBegan_ = Clock::now();
    }
    status_.fraction = fraction;
    status_.stages.back().fraction = fraction;
    status_.progress = std::max(status_.progress, totalProgress(phase, fraction));
  }
  notify();
}

void RebuildPipeline::estimate(const TouchModel& model, const Job& job) {
  const double condition = model.problem()->conditionEstimate(job);
  {
    const std::lock_guard lock(mutex_);
    if (model_.get() != &model) return;
    status_.condition = condition;
  }
  notify();
  const double touchError = estimateTouchError(model, job);
  {
    const std::lock_guard lock(mutex_);
    if (model_.get() != &model) return;
    status_.touchError = touchError;
  }
  notify();
}

void RebuildPipeline::work(const std::stop_token& stop) {
  lowerThreadPriority();
  for (;;) {
    modeling::Project project;
    std::shared_ptr<const TouchModel> model;
    std::uint64_t revision = 0;
    Task task{};
    Job job;
    {
      std::unique_lock lock(mutex_);
      const std::optional<Task> next = waitForTask(lock, stop);
      if (!next) return;
      task = *next;
      if (task == Task::kBuild) {
        project = std::move(*waiting_);
        waiting_.reset();
      } else {
        model = model_;
        (task == Task::kKeep ? keepDue_ : estimateDue_) = false;
        isKeeping_ = task == Task::kKeep;
      }
      revision = status_.revision;
      current_ = std::stop_source();
      // The destructor may have asked the worker to stop just before this source existed.
      if (stop.stop_requested()) return;
      job.stop = current_.get_token();
    }
    // What nobody waits for leaves the other cores to the hand and the window.
    job.threads = task == Task::kEstimate ? 1 : threads_;
    if (task == Task::kBuild) {
      job.progress = [this, revision](std::string_view phase, double fraction) {
        advance(revision, phase, fraction);
      };
      build(revision, project, job);
      continue;
    }
    try {
      if (task == Task::kKeep)
        options_.cache->write(model->key(), *model->problem(), job);
      else
        estimate(*model, job);
    } catch (const Cancelled&) {
      // A newer revision was submitted: this one needs neither any more.
    } catch (const std::bad_alloc&) {
      // Both can be done without.
    }
    {
      const std::lock_guard lock(mutex_);
      isKeeping_ = false;
    }
    settled_.notify_all();
  }
}

void RebuildPipeline::build(std::uint64_t revision, const modeling::Project& project,
                            const Job& job) {
  using State = RebuildStatus::State;
  try {
    update(revision, project, job);
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
  } catch (const std::exception& error) {
    finish(revision, State::kFailed, error.what(), nullptr);
  }
}

void RebuildPipeline::update(std::uint64_t revision, const modeling::Project& project,
                             const Job& job) {
  // Building anew takes less than 0.1 s below.
  constexpr int kMinCoefficients = 400;
  if (!former_ || former_->setup().discretisation->displacementCount() < kMinCoefficients) return;
  std::shared_ptr<const TouchModel> model;
  try {
    model = updateTouchModel(project, formerProject_, *former_, options_, job);
  } catch (const std::exception&) {
    // Building anew will find it, too, and say it.
  }
  if (!model) return;
  model = withBackgroundDestruction(std::move(model));
  {
    const std::lock_guard lock(mutex_);
    if (revision != status_.revision || status_.state != RebuildStatus::State::kBuilding) return;
    take(revision, model);
  }
  notify();
}

void RebuildPipeline::take(std::uint64_t revision, std::shared_ptr<const TouchModel>& model) {
  model_.swap(model);
  status_.modelRevision = revision;
  status_.residual = model_->report().residual;
  status_.condition = 0;
  status_.touchError = 0;
}

void RebuildPipeline::finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
                             std::shared_ptr<const TouchModel> model,
                             GeometryError::Findings findings) {
  {
    const std::lock_guard lock(mutex_);
    if (revision != status_.revision || status_.state != RebuildStatus::State::kBuilding) return;
    status_.state = state;
    closeStage();
    status_.fraction = 0;
    status_.error = std::move(error);
    if (findings) status_.findings = std::move(findings);
    if (model) {
      take(revision, model);
      status_.stages.back().fraction = 1;
      status_.progress = 1;
      estimateDue_ = true;
    }
  }
  settled_.notify_all();
  notify();
}

void RebuildPipeline::notify() const {
  if (changed_) changed_();
}

}  // namespace palpa::app
