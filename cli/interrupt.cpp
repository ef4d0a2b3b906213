// Ctrl-C and requests to terminate, by sigwait on a thread of its own, where unlike in a handler any call is allowed.
#include "cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "shbake.h"

namespace shbake::cli {
namespace {

/// How long the work may take to unwind by itself.
constexpr timespec kPatience{.tv_sec = 0, .tv_nsec = 150'000'000};

}  // namespace

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&signals_, signal);
  }
  sigaddset(&signals_, SIGUSR2);  // ends the waiting thread
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  thread_ = std::thread([this] { wait(); });
}

Interrupt::~Interrupt() {
  over_ = true;
  pthread_kill(thread_.native_handle(), SIGUSR2);
  thread_.join();
}

void Interrupt::finish() {
  while (over_.exchange(true)) ::pause();
}

int Interrupt::exitCode() const {
  const int signal = signal_;
  return 128 + (signal != 0 ? signal : SIGINT);
}

void Interrupt::onHardStop(std::function<void()> cleanUp) {
  const std::lock_guard lock(mutex_);
  cleanUp_ = std::move(cleanUp);
}

void Interrupt::wait() {
  int signal = 0;
  do {
    sigwait(&signals_, &signal);
    if (over_) return;
  } while (signal == SIGUSR2);
  signal_ = signal;
  sigtimedwait(&signals_, nullptr, &kPatience);  // a second signal, the end of the work, or neither in time
  if (!over_.exchange(true)) stopHard();
}

void Interrupt::stopHard() {
  {
    const std::lock_guard lock(mutex_);
    if (cleanUp_) cleanUp_();
  }
  discardOpenFiles();
  constexpr std::string_view kMessage = "shbake: stopped\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(exitCode());
}

}  // namespace shbake::cli
