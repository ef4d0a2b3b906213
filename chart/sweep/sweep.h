// Measures methods at rising effort.
#pragma once

#include <span>
#include <vector>

#include "chart/sweep/chart_data.h"
#include "chart/sweep/deadline.h"

namespace shbake::chart {

struct SweepOptions {
  int order = 4;
  std::vector<int> rays{16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
  std::vector<const Method*> methods;  ///< empty: all
  double tolerance = 0.01;             ///< whose number of rays is the default setting
};

/// Measures every method at every number of rays, the lowest first, on as many first points of the sample as the time
/// up to the deadline lets expect, at most those that the reference knows. Runs on the calling thread: CPU time is
/// that of one thread, undisturbed by others of this process. Four runs with different seeds up to 1024 rays, two
/// beyond; all methods take turns, so that what else the machine does meets all alike, and the default setting takes
/// its turn where the number of rays is nearest to its own. Fills in the curves, the default setting and notes of
/// `data`.
void runSweep(const TestBed& bed, std::span<const std::uint32_t> sample, const Reference& reference,
              const SweepOptions& options, const Deadline& deadline, Progress& progress, ChartData& data);

}  // namespace shbake::chart
