// Ctrl-C and requests to terminate: the work is asked to stop, and ended when it does not do so soon.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

namespace shbake::cli {

/// Waits for SIGINT and SIGTERM on a thread of its own. The first one sets requested(), which progress callbacks
/// return; the work then unwinds, leaving nothing behind. When it is still at it 150 ms later (a stage that reports no
/// progress) or a second signal comes, the process ends at once: files half written are removed, the terminal line is
/// cleaned, "stopped" is said and the exit code is that of the unwound stop, 128 + the signal's number.
class Interrupt {
 public:
  /// Blocks the signals in this and all later threads: to be made before any other thread. Signals that are ignored
  /// (as under nohup) stay ignored.
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// True once a signal has come.
  bool requested() const { return signal_ != 0; }
  /// The exit code of stopped work: 128 + the number of the signal that came, of SIGINT when none did.
  int exitCode() const;
  /// Says that the work has come to its end, one way or the other: signals are no longer acted on. Does not return when
  /// the process is being ended already.
  void finish();
  /// What is done before the process is ended without unwinding, on the waiting thread; {} for nothing.
  void onHardStop(std::function<void()> cleanUp);

 private:
  void wait();
  [[noreturn]] void stopHard();

  sigset_t signals_;
  std::atomic<int> signal_{0};
  std::atomic<bool> over_{false};  ///< set once, by finish() or by the hard stop: whoever comes first
  std::mutex mutex_;
  std::function<void()> cleanUp_;
  std::thread thread_;
};

}  // namespace shbake::cli
