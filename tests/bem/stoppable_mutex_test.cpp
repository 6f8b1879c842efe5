#include "base/stoppable_mutex.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <thread>
#include <vector>

namespace palpa {
namespace {

TEST(StoppableMutex, LetsOneThreadInAtATime) {
  StoppableMutex mutex;
  int count = 0;  // not atomic
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int k = 0; k < 1000; ++k) {
          const std::lock_guard lock(mutex);
          ++count;
        }
      });
  }
  EXPECT_EQ(count, 4000);
}

TEST(StoppableMutex, AWaitingThreadIsStopped) {
  StoppableMutex mutex;
  std::stop_source stop;
  bool isCancelled = false;
  {
    const std::lock_guard lock(mutex);
    const std::jthread waiting([&] {
      try {
        mutex.lock(stop.get_token());
      } catch (const Cancelled&) {
        isCancelled = true;
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop.request_stop();
  }
  EXPECT_TRUE(isCancelled);
  mutex.lock(stop.get_token());  // free: nothing to wait for
  mutex.unlock();
}

}  // namespace
}  // namespace palpa
