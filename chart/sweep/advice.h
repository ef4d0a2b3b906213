// Which setting to use for which error.
#pragma once

#include <vector>

#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// Settings of our own method for errors of 5, 2, 1 and 0.5 %. Where reflections were measured, a third of the error is
/// theirs: the fewest that leave out no more, and rays for the rest, since independent errors add as squares.
std::vector<Advice> adviseSettings(const ChartData& data);

}  // namespace shbake::chart
