#pragma once

#include <chrono>

namespace palpa::app {

/// Lowers the priority of the calling thread, and of the threads it starts from now on, to nice 10.
/// For threads that compute in the background of a window.
void lowerThreadPriority();

/// lowerThreadPriority() for all threads of the process except the first. OpenBLAS starts threads
/// at the window's priority when it is loaded. For `main` to call before anything else.
void lowerPriorityOfLoadedThreads();

/// Lowers the priority of the threads of Mesa's software rasteriser below the window's threads,
/// which would wait for the picture anyway. To be called after the first picture; quick, may be
/// called again.
void lowerPriorityOfRasteriser();

/// Raises the priority of the calling thread, for its lifetime: for a thread with a little work
/// every millisecond.
///
/// It requests what the system allows: real-time priority (SCHED_RR; needs root or a limit `rtprio`
/// in /etc/security/limits.conf), otherwise a larger share (nice -10; a limit `nice`). Every user
/// gets, from Linux 6.12 on, short time slices, which start sooner, and timers that are exact to a
/// nanosecond instead of 50 µs.
///
/// A thread with real-time priority could stop the machine. So the thread reports its working time:
/// above 50 % load it loses real-time priority until the load falls.
class RealtimeScope {
 public:
  using Clock = std::chrono::steady_clock;
  RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

  /// To be called after each step of work.
  void worked(Clock::time_point from, Clock::time_point to);

  /// True while the thread has real-time priority.
  bool isRealtime() const { return isRealtime_; }

 private:
  void setRealtime(bool isWanted);

  bool mayBeRealtime_ = false, isRealtime_ = false;
  Clock::time_point since_;  // start of the present measurement
  Clock::duration busy_{0};  // working time since then
};

}  // namespace palpa::app
