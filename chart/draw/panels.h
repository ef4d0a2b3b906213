// The panels of a chart from its numbers.
#pragma once

#include <vector>

#include "chart/draw/panel.h"
#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// Error against CPU time of the directions, the same of other programs and exclusions, error against order, error
/// against reflections, error between the vertices against CPU time and against their number; those that there are
/// numbers for. Further panels are functions beside these.
std::vector<Panel> panelsOf(const ChartData& data);

}  // namespace shbake::chart
