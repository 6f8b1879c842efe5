#include "app/core/rebuild_pipeline.h"

#include <utility>

#include "bem/error.h"
#include "modeling/job.h"

namespace palpa::app {

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

std::uint64_t RebuildPipeline::submit(modeling::Project snapshot) {
  std::uint64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    revision = ++status_.revision;
    status_.state = RebuildStatus::State::kBuilding;
    status_.phase.clear();
    status_.fraction = 0;
    status_.error.clear();
    waiting_ = std::move(snapshot);
    current_.request_stop();
  }
  wake_.notify_one();
  notify();
  return revision;
}

void RebuildPipeline::cancel() {
  {
    const std::lock_guard lock(mutex_);
    if (status_.state != RebuildStatus::State::kBuilding) return;
    status_.state = RebuildStatus::State::kCancelled;
    waiting_.reset();
    current_.request_stop();
  }
  settled_.notify_all();
  notify();
}

std::shared_ptr<const TouchModel> RebuildPipeline::model() const {
  const std::lock_guard lock(mutex_);
  return model_;
}

RebuildStatus RebuildPipeline::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

bool RebuildPipeline::waitUntilSettled(std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  return settled_.wait_for(lock, most,
                           [&] { return status_.state != RebuildStatus::State::kBuilding; });
}

void RebuildPipeline::work(const std::stop_token& stop) {
  for (;;) {
    modeling::Project project;
    std::uint64_t revision = 0;
    bem::Job job;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [&] { return waiting_.has_value(); })) return;
      project = std::move(*waiting_);
      waiting_.reset();
      revision = status_.revision;
      current_ = std::stop_source();
      // The destructor may have asked the worker to stop just before this source existed.
      if (stop.stop_requested()) return;
      job.stop = current_.get_token();
    }
    job.threads = threads_;
    job.progress = [this, revision](std::string_view phase, double fraction) {
      {
        const std::lock_guard lock(mutex_);
        if (status_.revision != revision || status_.state != RebuildStatus::State::kBuilding)
          return;
        status_.phase = phase;
        status_.fraction = fraction;
      }
      notify();
    };
    build(revision, project, job);
  }
}

void RebuildPipeline::build(std::uint64_t revision, const modeling::Project& project,
                            const bem::Job& job) {
  using State = RebuildStatus::State;
  try {
    finish(revision, State::kUpToDate, {}, buildTouchModel(project, options_, job));
  } catch (const bem::Cancelled&) {
    finish(revision, State::kCancelled, {}, nullptr);
  } catch (const modeling::Cancelled&) {
    finish(revision, State::kCancelled, {}, nullptr);
  } catch (const std::bad_alloc&) {
    finish(revision, State::kFailed,
           "there is not enough memory; take a larger edge length or close other programs",
           nullptr);
  } catch (const std::exception& error) {
    finish(revision, State::kFailed, error.what(), nullptr);
  }
}

void RebuildPipeline::finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
                             std::shared_ptr<const TouchModel> model) {
  // Replaced models are released after the lock: freeing gigabytes takes a while.
  {
    const std::lock_guard lock(mutex_);
    if (revision != status_.revision || status_.state != RebuildStatus::State::kBuilding) return;
    status_.state = state;
    status_.phase.clear();
    status_.fraction = 0;
    status_.error = std::move(error);
    if (model) {
      model_.swap(model);
      status_.modelRevision = revision;
    }
  }
  settled_.notify_all();
  notify();
}

void RebuildPipeline::notify() const {
  if (changed_) changed_();
}

}  // namespace palpa::app
