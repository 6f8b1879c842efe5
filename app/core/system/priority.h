#pragma once

#include <chrono>

namespace palpa::app {

/// Lets all other threads go first: the calling thread, and those it starts from now on, run at
/// nice 10. For threads that compute in the background of a window.
void lowerThreadPriority();

/// As lowerThreadPriority() for all threads of the process but the first: those that OpenBLAS
/// starts when it is loaded, at the priority of the window. For `main` to call before anything
/// else.
void lowerPriorityOfLoadedThreads();

/// Where the processor draws: lets the threads of Mesa's software rasteriser wait for those of the
/// window, which would wait for the picture anyhow. To be called once there is a picture; quick,
/// may be called again.
void lowerPriorityOfRasteriser();

/// The calling thread has something to do every millisecond, and takes little time for it.
///
/// What the system allows is asked for: to go before everything else (SCHED_RR; root, or a limit
/// `rtprio` in /etc/security/limits.conf), or a larger share (nice -10; the same for `nice`). What
/// every user may have, from Linux 6.12 on, is to wait for shorter turns of others, in exchange for
/// shorter ones of its own; and timers that are exact to a nanosecond instead of 50 µs.
///
/// A thread that goes before everything else could stop the machine. So it must say how long it
/// worked: while that is more than half of the time, it is as others are.
class RealtimeScope {
 public:
  using Clock = std::chrono::steady_clock;
  /// Of the calling thread, for its lifetime.
  RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

  /// To be called after each piece of work.
  void worked(Clock::time_point from, Clock::time_point to);

  /// Does it go before everything else at the moment?
  bool isRealtime() const { return isRealtime_; }

 private:
  void setRealtime(bool first);

  bool mayBeRealtime_ = false, isRealtime_ = false;
  Clock::time_point since_;  // of the present span of time
  Clock::duration busy_{0};  // within it
};

}  // namespace palpa::app
