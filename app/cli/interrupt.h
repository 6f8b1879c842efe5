#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace palpa::cli {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM asks the running work to stop, and the
/// second one ends the process at once. At most one object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::atomic<bool> finished_ = false;
  // A signal handler may post a POSIX semaphore, but not request a stop (that runs callbacks).
  std::thread watcher_;
};

}  // namespace palpa::cli
