// What reflections that are not summed leave out.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/chart_data.h"
#include "chart/sweep/deadline.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// Bakes the whole mesh with 0, 1, 2, 3, 4, 6 and 8 reflections and with the solver, and compares each with the same
/// rays solved to a hundredth of the default tolerance: the rays' own error drops out. As many rays, 16 to 64, as the
/// time lets expect from `secondsPerRay` (CPU seconds of one ray from every point); none where it is too short, which a
/// note of `data` tells.
void studyBounces(const LightingPoints& points, int order, double secondsPerRay, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data);

}  // namespace shbake::chart
