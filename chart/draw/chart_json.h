// A chart's numbers for programs.
#pragma once

#include <string>

#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// A JSON object with "shbake_chart": 1, ending in a newline. Errors are shares (0.01: 1 %), times CPU seconds for the
/// whole mesh; what was not measured is null or left out of its list.
std::string chartJson(const ChartData& data);

}  // namespace shbake::chart
