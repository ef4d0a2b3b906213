// CPU time, medians, and the CPU time that a bake spends in each of its stages.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"

namespace shbake::chart {

/// CPU seconds of the whole process so far, user and system.
double cpuSeconds();
/// CPU seconds of the calling thread so far.
double threadCpuSeconds();
/// Wall-clock seconds from an arbitrary start.
double wallSeconds();

double median(std::vector<double> values);

/// A progress callback that adds up the CPU time between the beginnings of stages.
class StageClock {
 public:
  ProgressCallback callback();
  /// CPU seconds of all stages called `stage`; call finish() first.
  double seconds(const std::string& stage) const;
  void finish();

 private:
  struct Entry {
    std::string stage;
    double seconds;
  };
  std::vector<Entry> entries_;
  std::string current_;
  double start_ = 0;
};

}  // namespace shbake::chart
