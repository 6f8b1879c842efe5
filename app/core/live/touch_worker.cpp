#include "app/core/live/touch_worker.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/core/system/destroy_in_background.h"
#include "app/core/system/memory.h"
#include "app/core/system/priority.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Columns for places that are not touched leave this part of the memory to those that are.
constexpr double kIdlePart = 0.8;
/// Bytes that are left to the rest of the system.
constexpr double kReserve = 256.0 * 1024 * 1024;

constexpr const char* kNoMemory =
    "there is no memory left for touching further places; take a larger edge length or close other "
    "programs";

constexpr std::size_t kBlock = bem::GreensColumns::kBlock;

/// Fills a block up with the nodes nearest to some points whose columns are missing.
void addNearest(const TouchableModel& body, const std::vector<Vector3d>& points,
                std::vector<int>& block) {
  struct Candidate {
    double distance;
    int node;
  };
  const std::vector<Vector3d>& places = body.surface().places();
  std::vector<Candidate> others;
  for (int node = 0; node < static_cast<int>(places.size()); ++node) {
    if (!body.surface().dofs().isFree(node) || body.columns()->has(node) ||
        std::find(block.begin(), block.end(), node) != block.end())
      continue;
    double distance = points.empty() ? 0 : std::numeric_limits<double>::infinity();
    for (const Vector3d& point : points)
      distance = std::min(distance, (places[node] - point).squaredNorm());
    others.push_back({distance, node});
  }
  const std::size_t room = std::min(kBlock - block.size(), others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(room),
                    others.end(), [](const Candidate& a, const Candidate& b) {
                      return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
                    });
  for (std::size_t k = 0; k < room; ++k) block.push_back(others[k].node);
}

}  // namespace

TouchWorker::TouchWorker(LoopMailbox& mail, Options options,
                         std::function<void(std::vector<Vector3d>&)> focus)
    : mail_(mail),
      options_(options),
      focus_(std::move(focus)),
      worker_([this](const std::stop_token& stop) { work(stop); }),
      filler_([this](const std::stop_token& stop) { fill(stop); }) {}

TouchWorker::~TouchWorker() {
  worker_.request_stop();
  filler_.request_stop();
  LoopMailbox::signal(mail_.workerSignal);
  LoopMailbox::signal(fillSignal_);
  worker_.join();
  filler_.join();
  releaseRetired();
  delete mail_.offered.exchange(nullptr);
}

std::uint64_t TouchWorker::setModel(std::shared_ptr<const TouchModel> model, std::uint64_t begun) {
  std::uint64_t number = 0;
  std::optional<Request> replaced;  // released after the lock
  {
    const std::lock_guard lock(mutex_);
    number = ++status_.newest;
    std::uint64_t ended = model ? 0 : begun;
    if (request_) ended = std::max(ended, request_->ended);
    replaced = std::exchange(request_, Request{number, std::move(model), ended});
    status_.error.clear();
  }
  LoopMailbox::signal(mail_.workerSignal);
  return number;
}

TouchWorker::Status TouchWorker::status() const {
  const std::lock_guard lock(mutex_);
  Status status = status_;
  for (const Numbered& numbered : bodies_)
    if (numbered.number == status.prepared) {
      const bem::GreensColumns& columns = *numbered.body->columns();
      status.columnsReady =
          static_cast<double>(columns.readyCount()) / std::max(columns.nodeCount(), 1);
    }
  return status;
}

std::shared_ptr<const TouchableModel> TouchWorker::body(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  for (const Numbered& numbered : bodies_)
    if (numbered.number == number) return numbered.body;
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
  repeat(stop, mail_.workerSignal, [&] {
    releaseRetired();
    if (prepare()) return true;
    mail_.wanted.update();
    const LoopMailbox::ColumnRequests& wanted = mail_.wanted.front();
    if (computeRequested(wanted.touched, stop) || computeRequested(wanted.next, stop)) return true;
    if (isUrgent_.exchange(false)) LoopMailbox::signal(fillSignal_);
    return false;
  });
}

void TouchWorker::fill(const std::stop_token& stop) {
  lowerThreadPriority();
  repeat(stop, fillSignal_, [&] { return computeOthers(stop); });
}

void TouchWorker::releaseRetired() {
  LoopMailbox::ReadyModel* retired = mail_.retired.exchange(nullptr, std::memory_order_acquire);
  while (retired) {
    std::unique_ptr<LoopMailbox::ReadyModel> offer(std::exchange(retired, retired->next));
    std::shared_ptr<const TouchableModel> body;
    const std::lock_guard lock(mutex_);
    const auto place = std::find_if(bodies_.begin(), bodies_.end(), [&](const Numbered& numbered) {
      return numbered.number == offer->number;
    });
    if (place == bodies_.end()) continue;
    body = std::move(place->body);
    bodies_.erase(place);
    offer.reset();
    destroyInBackground(std::move(body));
  }
}

bool TouchWorker::prepare() {
  Request request;
  {
    const std::lock_guard lock(mutex_);
    if (!request_) return false;
    request = std::move(*request_);
    request_.reset();
  }
  auto offer = std::make_unique<LoopMailbox::ReadyModel>();
  offer->number = request.number;
  offer->ended = request.ended;
  if (request.model) {
    const ModelCache::Key key = request.model->key();
    const bool isKnown = columns_ && key == columnsKey_;
    if (isKnown) {
      const std::lock_guard lock(computing_);
      columns_->continueWith(request.model->problem());
    }
    auto body = std::make_shared<const TouchableModel>(request.model, isKnown ? columns_ : nullptr);
    columns_ = body->columns();
    columnsKey_ = key;
    offer->player = std::make_unique<TouchStepper>(body, request.number);
    const std::lock_guard lock(mutex_);
    bodies_.push_back({request.number, std::move(body)});
  }
  {
    const std::lock_guard lock(mutex_);
    status_.prepared = request.number;
  }
  // The one that the loop has not seen yet goes the way of those that it has done with; what ended
  // with it ends.
  if (auto* unseen = mail_.offered.exchange(nullptr, std::memory_order_acq_rel)) {
    offer->ended = std::max(offer->ended, unseen->ended);
    unseen->next = mail_.retired.load(std::memory_order_relaxed);
    while (!mail_.retired.compare_exchange_weak(unseen->next, unseen, std::memory_order_release)) {
    }
  }
  mail_.offered.store(offer.release(), std::memory_order_release);
  LoopMailbox::signal(mail_.loopSignal);
  LoopMailbox::signal(fillSignal_);
  return true;
}

bool TouchWorker::computeRequested(const LoopMailbox::ColumnRequest& wanted,
                                   const std::stop_token& stop) {
  const std::shared_ptr<const TouchableModel> touched = body(wanted.number);
  if (!touched) return false;
  std::vector<int> nodes;
  for (int k = 0; k < wanted.count; ++k)
    if (!touched->columns()->has(wanted.nodes[k])) nodes.push_back(wanted.nodes[k]);
  if (nodes.empty()) return false;
  if (!hasMemoryFor(*touched, true)) {
    setError(kNoMemory);
    return false;
  }
  std::vector<int> block;
  for (const int node : nodes)
    if (block.size() < kBlock && std::find(block.begin(), block.end(), node) == block.end())
      block.push_back(node);
  if (block.size() < kBlock)
    addNearest(*touched, {touched->surface().places()[block.front()]}, block);
  isUrgent_.store(true);
  const std::lock_guard lock(computing_);
  compute(*touched, block, stop);
  return true;
}

bool TouchWorker::computeOthers(const std::stop_token& stop) {
  if (!options_.computesAll || isUrgent_.load()) return false;
  std::shared_ptr<const TouchableModel> newest;
  {
    const std::lock_guard lock(mutex_);
    if (!bodies_.empty() && bodies_.back().number == status_.prepared) newest = bodies_.back().body;
  }
  // The columns of an update take long, and a model of its own will replace it.
  if (!newest || newest->model().report().residual || newest->columns()->isComplete() ||
      !hasMemoryFor(*newest, false))
    return false;
  std::vector<Vector3d> points;
  focus_(points);
  std::vector<int> block;
  addNearest(*newest, points, block);
  const std::lock_guard lock(computing_);
  compute(*newest, block, stop);
  return true;
}

/// With the lock on computing_ held.
void TouchWorker::compute(const TouchableModel& body, std::span<const int> nodes,
                          const std::stop_token& stop) {
  Job job;
  job.stop = stop;
  job.threads = options_.threads;
  body.columns()->compute(nodes, job);
}

bool TouchWorker::hasMemoryFor(const TouchableModel& body, bool isUrgent) const {
  const bem::GreensColumns& columns = *body.columns();
  const double block = columns.blockBytes();
  const double used = block / bem::GreensColumns::kBlock * columns.readyCount();
  const double part = isUrgent ? 1.0 : kIdlePart;
  if (options_.columnsLimit > 0 && used + block > part * options_.columnsLimit) return false;
  const double available = availableMemory();
  return available <= 0 || block + kReserve < (isUrgent ? available : kIdlePart * available);
}

}  // namespace palpa::app
