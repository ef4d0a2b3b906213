// CPU time by the clocks of process and thread.
#include "chart/methods/cpu_clock.h"

#include <time.h>

#include <algorithm>
#include <chrono>

namespace shbake::chart {

namespace {

double secondsOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double cpuSeconds() {
  return secondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

double threadCpuSeconds() {
  return secondsOf(CLOCK_THREAD_CPUTIME_ID);
}

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

ProgressCallback StageClock::callback() {
  return [this](const ProgressState& state) {
    if (state.stage != current_ || state.done == 0) {
      finish();
      current_ = state.stage;
    }
    return true;
  };
}

void StageClock::finish() {
  const double now = cpuSeconds();
  if (!current_.empty()) entries_.push_back({current_, now - start_});
  start_ = now;
  current_.clear();
}

double StageClock::seconds(const std::string& stage) const {
  double sum = 0;
  for (const Entry& e : entries_) sum += e.stage == stage ? e.seconds : 0;
  return sum;
}

}  // namespace shbake::chart
