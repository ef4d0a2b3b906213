// How long work may take.
#pragma once

#include <algorithm>
#include <chrono>

namespace shbake::chart {

/// A point in time, by the wall clock.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Deadline(double seconds)
      : begin_(Clock::now()), end_(begin_ + std::chrono::duration_cast<Clock::duration>(Seconds(seconds))) {}

  /// Seconds since it was set, and until it comes; 0 after that.
  double passed() const { return Seconds(Clock::now() - begin_).count(); }
  double left() const { return std::max(0.0, Seconds(end_ - Clock::now()).count()); }
  bool isOver() const { return left() <= 0; }
  /// The deadline at which `share` (0..1) of the time from the beginning of this one to its end is over.
  Deadline at(double share) const {
    Deadline part = *this;
    part.end_ = begin_ + std::chrono::duration_cast<Clock::duration>((end_ - begin_) * share);
    return part;
  }

 private:
  using Seconds = std::chrono::duration<double>;
  Clock::time_point begin_, end_;
};

}  // namespace shbake::chart
