// Progress and cancelling: counts kept in atomics, reports under a mutex.
#include "base/progress.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

void Progress::begin(std::string stage, double total, std::string unit) {
  {
    const std::lock_guard lock(mutex_);
    start_ = Clock::now();
    state_ = {std::move(stage), std::move(unit), 0, total, 0};
    done_ = 0;
  }
  report(true);
  if (cancelled_) throw cancelledError();
}

void Progress::advance(double amount) {
  if (!tryAdvance(amount)) throw cancelledError();
}

bool Progress::tryAdvance(double amount) noexcept {
  done_.fetch_add(amount, std::memory_order_relaxed);
  if (callback_ && Clock::now().time_since_epoch().count() >= nextReport_.load(std::memory_order_relaxed))
    report(false);
  return !cancelled_.load(std::memory_order_relaxed);
}

void Progress::end() {
  {
    const std::lock_guard lock(mutex_);
    if (state_.total > 0) done_ = state_.total;
  }
  report(true);
  if (cancelled_) throw cancelledError();
}

void Progress::report(bool force) {
  if (!callback_) return;
  std::unique_lock lock(mutex_, std::defer_lock);
  if (force) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;
  }
  const auto now = Clock::now();
  if (!force && now.time_since_epoch().count() < nextReport_) return;  // another thread was first
  nextReport_ = (now + interval_).time_since_epoch().count();
  state_.done = state_.total > 0 ? std::min(done_.load(), state_.total) : done_.load();
  state_.elapsed = std::chrono::duration<double>(now - start_).count();
  if (!callback_(state_)) cancelled_ = true;
}

}  // namespace shbake
