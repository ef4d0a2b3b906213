// Long work as a number of passes over many things, which counts its progress and can be stopped within each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "base/progress.h"

namespace shbake {

/// Things that are gone through between two looks at a Progress: some hundred microseconds of work.
inline constexpr std::size_t kProgressBlock = 1 << 14;

/// body(i) for i = 0..count-1, which together count as `amount`. Throws within kProgressBlock things when the work has
/// been cancelled.
template <class Index = std::size_t, class Body>
void forEachCounted(Progress& progress, std::size_t count, double amount, Body&& body) {
  for (std::size_t begin = 0; begin < count; begin += kProgressBlock) {
    const std::size_t end = std::min(count, begin + kProgressBlock);
    for (std::size_t i = begin; i < end; ++i) body(static_cast<Index>(i));
    progress.advance(amount * static_cast<double>(end - begin) / static_cast<double>(count));
  }
}

/// Sorts as std::sort() does, which counts as `amount`, and looks at the Progress every kProgressBlock comparisons.
/// Sorting is expected to take log2(n) of them for each of n things. After a stop, the things are there in any order.
template <class Iterator, class Less>
void sortCounted(Progress& progress, Iterator first, Iterator last, double amount, const Less& less) {
  const auto count = static_cast<double>(last - first);
  const double step = amount * kProgressBlock / std::max(1.0, count * std::log2(count + 1));
  double counted = 0;
  std::size_t comparisons = 0;
  std::sort(first, last, [&](const auto& a, const auto& b) {
    if (++comparisons % kProgressBlock == 0) {
      const double now = std::min(step, amount - counted);
      counted += now;
      progress.advance(now);
    }
    return less(a, b);
  });
  progress.advance(amount - counted);
}

/// One stage of a Progress, made of passes that count alike, whatever each goes over. All members throw when the work
/// has been cancelled, a pass within kProgressBlock things.
class Passes {
 public:
  /// Begins the stage, which counts `items` in `unit` over its `passes` together. The Progress must outlive the object.
  Passes(Progress& progress, std::string stage, std::size_t items, std::string unit, int passes)
      : progress_(progress), perPass_(static_cast<double>(items) / passes) {
    progress.begin(std::move(stage), static_cast<double>(items), std::move(unit));
  }

  /// One pass: body(i) for i = 0..count-1.
  template <class Index = std::size_t, class Body>
  void forEach(std::size_t count, Body&& body) {
    forEachCounted<Index>(progress_, count, perPass_, std::forward<Body>(body));
  }

  /// One pass: sortCounted().
  template <class Iterator, class Less>
  void sort(Iterator first, Iterator last, const Less& less) {
    sortCounted(progress_, first, last, perPass_, less);
  }

  /// Ends the stage.
  void end() { progress_.end(); }

 private:
  Progress& progress_;
  double perPass_;
};

}  // namespace shbake
