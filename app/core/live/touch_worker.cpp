#include "app/core/live/touch_worker.h"

#include <algorithm>
#include <utility>

#include "app/core/system/destroy_in_background.h"
#include "app/core/system/memory.h"
#include "app/core/system/priority.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Part of the memory that columns may take for places that are not touched.
constexpr double kIdlePart = 0.8;
/// Bytes left to the rest of the system.
constexpr double kReserve = 256.0 * 1024 * 1024;

constexpr const char* kNoMemory =
    "there is no memory left for touching further places; take a larger edge length or close other "
    "programs";

}  // namespace

TouchWorker::TouchWorker(LoopMailbox& mailbox, Options options,
                         std::function<void(std::vector<Vector3d>&)> focus)
    : mailbox_(mailbox),
      options_(options),
      focus_(std::move(focus)),
      worker_([this](const std::stop_token& stop) { work(stop); }),
      filler_([this](const std::stop_token& stop) { fill(stop); }) {}

TouchWorker::~TouchWorker() {
  worker_.request_stop();
  filler_.request_stop();
  LoopMailbox::signal(mailbox_.workerSignal);
  LoopMailbox::signal(fillSignal_);
  worker_.join();
  filler_.join();
  releaseRetired();
  delete mailbox_.ready.exchange(nullptr);
}

std::uint64_t TouchWorker::setModel(std::shared_ptr<const TouchModel> model, std::uint64_t begun) {
  std::uint64_t number = 0;
  std::optional<PendingModel> replaced;  // destroyed after the lock
  {
    const std::lock_guard lock(mutex_);
    number = ++status_.newest;
    std::uint64_t ended = model ? 0 : begun;
    if (pending_) ended = std::max(ended, pending_->ended);
    replaced = std::exchange(pending_, PendingModel{number, std::move(model), ended});
    status_.error.clear();
  }
  LoopMailbox::signal(mailbox_.workerSignal);
  return number;
}

TouchWorker::Status TouchWorker::status() const {
  const std::lock_guard lock(mutex_);
  Status status = status_;
  for (const Numbered& numbered : models_)
    if (numbered.number == status.prepared) {
      const bem::GreensColumns& columns = *numbered.model->columns();
      status.columnsReady =
          static_cast<double>(columns.readyCount()) / std::max(columns.nodeCount(), 1);
    }
  return status;
}

std::shared_ptr<const TouchableModel> TouchWorker::model(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  for (const Numbered& numbered : models_)
    if (numbered.number == number) return numbered.model;
  return nullptr;
}

void TouchWorker::setError(std::string error) {
  const std::lock_guard lock(mutex_);
  status_.error = std::move(error);
}

template <class Some>
void TouchWorker::repeat(const std::stop_token& stop, std::atomic<std::uint32_t>& signal,
                         const Some& some) {
  for (;;) {
    const std::uint32_t seen = signal.load(std::memory_order_acquire);
    if (stop.stop_requested()) return;
    try {
      if (some()) continue;
    } catch (const Cancelled&) {
      return;
    } catch (const std::bad_alloc&) {
      setError(kNoMemory);
    } catch (const std::exception& error) {
      setError(error.what());
    }
    signal.wait(seen, std::memory_order_acquire);
  }
}

void TouchWorker::work(const std::stop_token& stop) {
  repeat(stop, mailbox_.workerSignal, [&] {
    releaseRetired();
    if (prepare()) return true;
    mailbox_.requested.update();
    const LoopMailbox::ColumnRequests& requests = mailbox_.requested.front();
    if (computeRequested(requests.touched, stop) || computeRequested(requests.next, stop))
      return true;
    if (isUrgent_.exchange(false)) LoopMailbox::signal(fillSignal_);
    return false;
  });
}

void TouchWorker::fill(const std::stop_token& stop) {
  lowerThreadPriority();
  repeat(stop, fillSignal_, [&] { return computeOthers(stop); });
}

void TouchWorker::releaseRetired() {
  ReadyModel* retired = mailbox_.retired.exchange(nullptr, std::memory_order_acquire);
  while (retired) {
    std::unique_ptr<ReadyModel> ready(std::exchange(retired, retired->next));
    std::shared_ptr<const TouchableModel> model;
    const std::lock_guard lock(mutex_);
    const auto place = std::find_if(models_.begin(), models_.end(), [&](const Numbered& numbered) {
      return numbered.number == ready->number;
    });
    if (place == models_.end()) continue;
    model = std::move(place->model);
    models_.erase(place);
    ready.reset();
    destroyInBackground(std::move(model));
  }
}

bool TouchWorker::prepare() {
  PendingModel pending;
  {
    const std::lock_guard lock(mutex_);
    if (!pending_) return false;
    pending = std::move(*pending_);
    pending_.reset();
  }
  auto ready = std::make_unique<ReadyModel>();
  ready->number = pending.number;
  ready->ended = pending.ended;
  if (pending.model) {
    const ModelCache::Key key = pending.model->key();
    const bool isKnown = columns_ && key == columnsKey_;
    if (isKnown) columns_->continueWith(pending.model->problem());
    auto model =
        std::make_shared<const TouchableModel>(pending.model, isKnown ? columns_ : nullptr);
    columns_ = model->columns();
    columnsKey_ = key;
    ready->stepper = std::make_unique<TouchStepper>(model, pending.number);
    const std::lock_guard lock(mutex_);
    models_.push_back({pending.number, std::move(model)});
  }
  {
    const std::lock_guard lock(mutex_);
    status_.prepared = pending.number;
  }
  // A model that the loop has not taken yet is retired; contacts that ended with it end.
  if (auto* unseen = mailbox_.ready.exchange(nullptr, std::memory_order_acq_rel)) {
    ready->ended = std::max(ready->ended, unseen->ended);
    mailbox_.retire(unseen);
  }
  mailbox_.ready.store(ready.release(), std::memory_order_release);
  LoopMailbox::signal(mailbox_.loopSignal);
  LoopMailbox::signal(fillSignal_);
  return true;
}

/// True if the other thread computes columns of this model, first around the contacts.
bool TouchWorker::isFilled(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  return options_.computesAll && !models_.empty() && models_.back().number == number &&
         number == status_.prepared && !models_.back().model->model().report().residual;
}

bool TouchWorker::computeRequested(const ColumnRequest& request, const std::stop_token& stop) {
  const std::shared_ptr<const TouchableModel> touched = model(request.number);
  if (!touched || request.count == 0) return false;
  switch (answerPlace(touched, request, stop)) {
    case Answer::kComputed:
      return true;
    case Answer::kKnown:
      return false;  // what other contacts miss, they ask for again
    case Answer::kNone:
      break;
  }
  // The next new place must not wait for the end of a long block: the other thread computes it.
  const bool isRough =
      answersPlaces(*touched) && isFilled(request.number) && hasMemoryFor(*touched, false);
  if (isRough && !touched->columns()->takesRough()) return false;
  const std::span nodes(request.nodes.data(), static_cast<std::size_t>(request.count));
  const std::vector<int> block =
      touched->columns()->blockFor(nodes, touched->surface().places(), isRough);
  if (block.empty()) return false;
  if (isRough) {
    computeRough(*touched, block, stop);
    return true;
  }
  if (!hasMemoryFor(*touched, true)) {
    setError(kNoMemory);
    return false;
  }
  isUrgent_.store(true);
  const std::lock_guard lock(computing_);
  compute(*touched, block, stop);
  return true;
}

bool TouchWorker::computeOthers(const std::stop_token& stop) {
  if (!options_.computesAll) return false;
  std::shared_ptr<const TouchableModel> newest;
  std::stop_token ofBlock;
  {
    const std::lock_guard lock(mutex_);
    if (!models_.empty() && models_.back().number == status_.prepared)
      newest = models_.back().model;
    fillerBlock_ = std::stop_source();
    ofBlock = fillerBlock_.get_token();
  }
  if (isUrgent_.load()) return false;  // from here on, the worker stops the block
  const std::stop_callback both(stop, [this] {
    const std::lock_guard lock(mutex_);
    fillerBlock_.request_stop();
  });
  if (improvePlace(ofBlock)) return true;
  // The columns of an incremental update take long, and the full model replaces it soon.
  if (!newest || newest->model().report().residual || newest->columns()->isComplete() ||
      !hasMemoryFor(*newest, false))
    return false;
  std::vector<Vector3d> points;
  focus_(points);
  std::vector<int> block;
  newest->columns()->fillBlock(block, newest->surface().places(), points);
  const std::lock_guard lock(computing_);
  try {
    compute(*newest, block, ofBlock);
  } catch (const Cancelled&) {
    if (stop.stop_requested()) throw;
  }
  return true;
}

/// Called with computing_ locked.
void TouchWorker::compute(const TouchableModel& model, std::span<const int> nodes,
                          const std::stop_token& stop) {
  Job job;
  job.stop = stop;
  job.threads = options_.threads;
  model.columns()->compute(nodes, job);
}

bool TouchWorker::hasMemoryFor(const TouchableModel& model, bool isUrgent) const {
  const bem::GreensColumns& columns = *model.columns();
  const double block = columns.blockBytes();
  const double part = isUrgent ? 1.0 : kIdlePart;
  if (options_.columnsLimit > 0 && columns.usedBytes() + block > part * options_.columnsLimit)
    return false;
  const double available = availableMemory();
  return available <= 0 || block + kReserve < (isUrgent ? available : kIdlePart * available);
}

}  // namespace palpa::app
