// Sentences and the table of the error between the vertices.
#pragma once

#include <string>
#include <vector>

#include "chart/draw/text.h"
#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// What the default errs between the vertices, what errs least, and which setting takes the least time to 5, 2, 1 and
/// 0.5 %; nothing where it was not measured.
std::vector<std::string> surfaceSentences(const ChartData& data);

/// How it was measured; nothing where it was not.
std::vector<std::string> surfaceMeasurement(const ChartData& data);

/// One row a bake.
Table surfaceTable(const ChartData& data);

}  // namespace shbake::chart
