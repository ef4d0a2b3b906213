// Progress and cancelling: one callback passed down through the stages.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace shbake {

/// What a progress callback is told.
struct ProgressState {
  std::string stage;   ///< what is being done, e.g. "tracing"
  std::string unit;    ///< what is counted, e.g. "rays"
  double done = 0;     ///< units finished, 0..total
  double total = 0;    ///< units in all; 0 when unknown
  double elapsed = 0;  ///< seconds since the stage began
};

/// Called at most every 50 ms (Progress::kInterval), from any thread but never from two at once, and at the beginning
/// and end of a stage.
/// Returning false cancels the work: the running stage throws an Error of kind `cancelled`. It must not throw.
using ProgressCallback = std::function<bool(const ProgressState&)>;

/// Counts finished work and hands it to a callback. All members but `begin` and `end` may be called from any thread.
class Progress {
 public:
  using Duration = std::chrono::steady_clock::duration;
  static constexpr Duration kInterval = std::chrono::milliseconds(50);

  Progress() = default;
  /// `interval` is the least time between two reports; 0: whenever work is counted.
  explicit Progress(ProgressCallback callback, Duration interval = kInterval)
      : callback_(std::move(callback)), interval_(interval) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts a stage. Throws when the work has been cancelled.
  void begin(std::string stage, double total, std::string unit);
  /// Adds finished work; reports when it is time. Throws when the work has been cancelled.
  void advance(double amount);
  /// advance() that tells instead of throwing: for callbacks of C libraries. True while the work shall go on.
  bool tryAdvance(double amount) noexcept;
  /// Ends the stage, reporting it as complete.
  void end();

 private:
  void report(bool force);

  ProgressCallback callback_;
  Duration interval_ = kInterval;
  std::mutex mutex_;
  ProgressState state_;
  std::atomic<double> done_{0};
  std::atomic<bool> cancelled_{false};
  std::atomic<std::chrono::steady_clock::rep> nextReport_{0};
  std::chrono::steady_clock::time_point start_;
};

}  // namespace shbake
