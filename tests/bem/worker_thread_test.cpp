#include "base/worker_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/unexpected.h"

namespace palpa {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

void waitForStop(const std::stop_token& stop) {
  sleepUntil(Clock::now() + 60s, stop);
}

TEST(WorkerThread, RunsTasksInTheirOrderOnOnePreparedThread) {
  std::vector<int> order;
  std::atomic<int> prepared = 0;
  std::thread::id thread;
  WorkerThread worker([&] {
    ++prepared;
    thread = std::this_thread::get_id();
  });
  worker.waitUntilIdle();
  EXPECT_EQ(prepared, 0);
  for (int k = 0; k < 5; ++k)
    worker.post([&, k](const std::stop_token&) {
      EXPECT_EQ(std::this_thread::get_id(), thread);
      order.push_back(k);
    });
  worker.waitUntilIdle();
  EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4}));
  EXPECT_EQ(prepared, 1);
}

TEST(WorkerThread, AnExceptionOfATaskIsReportedAndTheNextTaskRuns) {
  std::vector<std::string> reported;
  setUnexpectedHandler([&](const std::string& what) { reported.push_back(what); });
  bool isNext = false;
  WorkerThread worker;
  worker.post([](const std::stop_token&) { throw std::runtime_error("a defect"); });
  worker.post([](const std::stop_token&) { throw Cancelled{}; });
  worker.post([](const std::stop_token&) { throw 3; });
  worker.post([&](const std::stop_token&) { isNext = true; });
  worker.waitUntilIdle();
  setUnexpectedHandler({});
  EXPECT_TRUE(isNext);
  EXPECT_EQ(reported, (std::vector<std::string>{"a defect", "an exception of unknown type"}));
}

TEST(WorkerThread, ReplaceStopsTheRunningTaskAndDropsTheWaitingOnes) {
  std::atomic<int> stopped = 0, dropped = 0, last = 0;
  WorkerThread worker;
  worker.post([&](const std::stop_token& stop) {
    waitForStop(stop);
    ++stopped;
  });
  worker.post([&](const std::stop_token&) { ++dropped; });
  worker.replace([&](const std::stop_token& stop) { last += stop.stop_requested() ? 0 : 1; });
  worker.waitUntilIdle();
  EXPECT_LE(stopped, 1);  // 0 if it had not begun
  EXPECT_EQ(dropped, 0);
  EXPECT_EQ(last, 1);
}

TEST(WorkerThread, CancelledItTakesNewTasks) {
  WorkerThread worker;
  worker.post(waitForStop);
  worker.cancel();
  worker.waitUntilIdle();
  std::atomic<bool> hasRun = false;
  worker.post([&](const std::stop_token&) { hasRun = true; });
  worker.waitUntilIdle();
  EXPECT_TRUE(hasRun);
}

TEST(WorkerThread, ATaskMayPostTheNext) {
  std::atomic<int> count = 0;
  WorkerThread worker;
  worker.post([&](const std::stop_token&) {
    ++count;
    worker.post([&](const std::stop_token&) { ++count; });
  });
  worker.waitUntilIdle();
  EXPECT_EQ(count, 2);
}

TEST(WorkerThread, ItsDestructorStopsTheRunningTaskAndDropsTheWaitingOnes) {
  std::atomic<int> dropped = 0;
  const auto begin = Clock::now();
  {
    WorkerThread worker;
    worker.post(waitForStop);
    worker.post([&](const std::stop_token&) { ++dropped; });
  }
  EXPECT_EQ(dropped, 0);
  EXPECT_LT(Clock::now() - begin, 30s);
}

TEST(WorkerThread, ItsDestructorIgnoresWhatTheRunningTaskPosts) {
  std::atomic<int> late = 0;
  {
    WorkerThread worker;
    std::atomic<bool> hasBegun = false;
    worker.post([&](const std::stop_token& stop) {
      hasBegun = true;
      waitForStop(stop);
      std::this_thread::sleep_for(5ms);
      worker.post([&](const std::stop_token&) { ++late; });
    });
    while (!hasBegun) std::this_thread::yield();
  }
  EXPECT_EQ(late, 0);
}

TEST(WorkerThread, DestroysWhatATaskHolds) {
  WorkerThread worker;
  auto held = std::make_shared<int>(1);
  const std::weak_ptr<int> seen = held;
  worker.post([held = std::move(held)](const std::stop_token&) {});
  worker.waitUntilIdle();
  EXPECT_TRUE(seen.expired());
}

TEST(SleepUntil, SaysWhetherTheTimeHasPassed) {
  std::stop_source source;
  EXPECT_TRUE(sleepUntil(Clock::now() + 1ms, source.get_token()));
  source.request_stop();
  EXPECT_FALSE(sleepUntil(Clock::now() + 60s, source.get_token()));
}

}  // namespace
}  // namespace palpa
