// Which setting to use for which error.
#pragma once

#include <vector>

#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// Settings of our own method for errors of 5, 2, 1 and 0.5 %. Where reflections were measured, a third of the error is
/// theirs: the fewest that leave out no more, and rays for the rest, since independent errors add as squares.
std::vector<Advice> adviseSettings(const ChartData& data);

/// Of what was measured between the vertices, what takes the least time to each of these errors. Refinement that aims
/// at an error of its own is left out: --tolerance is how to ask for that.
std::vector<SurfaceAdvice> adviseSurface(const SurfaceStudy& study);

}  // namespace shbake::chart
