#include "app/core/priority.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <string>

namespace palpa::app {
namespace {

constexpr int kBackground = 10;  // a ninth of the time beside a busy thread of the window

constexpr int kForeground = -10;

}  // namespace

void lowerThreadPriority() {
  // Linux gives every thread a priority of its own; should it refuse, things are only slower.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kBackground);
}

void raiseThreadPriority() {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kForeground);
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);  // ns; 50 µs otherwise
}

void lowerPriorityOfLoadedThreads() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", error)) {
    const std::string name = entry.path().filename().string();
    int thread = 0;
    std::from_chars(name.data(), name.data() + name.size(), thread);
    if (thread > 0 && thread != ::getpid())
      ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), kBackground);
  }
}

}  // namespace palpa::app
