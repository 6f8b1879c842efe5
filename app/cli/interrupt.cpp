#include "app/cli/interrupt.h"

#include <semaphore.h>
#include <signal.h>

#include <cerrno>

namespace palpa::cli {
namespace {

sem_t signalled;

extern "C" void onSignal(int) {
  const int saved = errno;
  sem_post(&signalled);
  errno = saved;
}

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  // The default action comes back after the first signal, so that a second one ends the process.
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
  sem_init(&signalled, 0, 0);
  watcher_ = std::thread([this] {
    while (sem_wait(&signalled) != 0) {
    }
    if (!finished_) source_.request_stop();
  });
  install(onSignal);
}

Interrupt::~Interrupt() {
  install(SIG_DFL);
  finished_ = true;
  sem_post(&signalled);
  watcher_.join();
  sem_destroy(&signalled);
}

}  // namespace palpa::cli
