#include "app/core/system/priority.h"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace palpa::app {
namespace {

constexpr int kBackground = 10;  // a ninth of the time next to a busy thread of the window
constexpr int kRasteriser = 5;   // a third
constexpr int kForeground = -10;
constexpr const char* kRasteriserName = "llvmpipe";

/// Requested length of a time slice, ns: the shortest that Linux gives.
constexpr std::uint64_t kTimeSlice = 100'000;

/// Argument of sched_setattr(2). The C library has no declaration yet, and the kernel's header
/// contradicts the library's headers.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = SCHED_OTHER;
  std::uint64_t flags = 1;  // SCHED_FLAG_RESET_ON_FORK: new threads are ordinary ones
  std::int32_t nice = 0;
  std::uint32_t priority = 0;  // of the real-time classes
  std::uint64_t runtime = 0;   // ns; length of a time slice (SCHED_OTHER)
  std::uint64_t deadline = 0, period = 0;
};

/// Load above which a thread loses real-time priority, measured over kSpan.
constexpr double kMaxLoad = 0.5;
constexpr std::chrono::milliseconds kSpan{100};

/// Calls `act` with the id and the name of all threads of the process.
template <class Act>
void forEachThread(const Act& act) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", error)) {
    const std::string number = entry.path().filename().string();
    int thread = 0;
    std::from_chars(number.data(), number.data() + number.size(), thread);
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    if (thread > 0) act(thread, name);
  }
}

/// Applies to the calling thread; false if it is not allowed.
bool setScheduling(const SchedulingAttributes& attributes) {
  return ::syscall(SYS_sched_setattr, 0, &attributes, 0U) == 0;
}

}  // namespace

void lowerThreadPriority() {
  // On Linux the priority belongs to the thread. A failure only makes the window slower.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kBackground);
}

void lowerPriorityOfLoadedThreads() {
  forEachThread([](int thread, const std::string&) {
    if (thread != ::getpid()) ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), kBackground);
  });
}

void lowerPriorityOfRasteriser() {
  forEachThread([](int thread, const std::string& name) {
    if (name.starts_with(kRasteriserName))
      ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), kRasteriser);
  });
}

RealtimeScope::RealtimeScope() : mayBeRealtime_(true), since_(Clock::now()) {
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  setRealtime(true);
}

void RealtimeScope::setRealtime(bool isWanted) {
  if (isWanted && mayBeRealtime_) {
    SchedulingAttributes realtime;
    realtime.policy = SCHED_RR;
    realtime.priority = 1;  // the lowest one precedes all ordinary threads
    mayBeRealtime_ = isRealtime_ = setScheduling(realtime);
    if (isRealtime_) return;
  }
  isRealtime_ = false;
  SchedulingAttributes ordinary;
  ordinary.runtime = kTimeSlice;
  ordinary.nice = kForeground;
  if (setScheduling(ordinary)) return;
  ordinary.nice = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
  setScheduling(ordinary);
}

void RealtimeScope::worked(Clock::time_point from, Clock::time_point to) {
  busy_ += to - from;
  const auto span = to - since_;
  if (span < kSpan) return;
  const bool isBusy = std::chrono::duration<double>(busy_).count() >
                      kMaxLoad * std::chrono::duration<double>(span).count();
  if (mayBeRealtime_ && isBusy == isRealtime_) setRealtime(!isBusy);
  since_ = to;
  busy_ = Clock::duration::zero();
}

}  // namespace palpa::app
