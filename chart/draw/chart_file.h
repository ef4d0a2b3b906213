// Charts as files.
#pragma once

#include <string>

#include "base/progress.h"
#include "chart/sweep/chart_data.h"

namespace shbake::chart {

enum class ChartFormat { html, svg, png, json };

/// By the end of a file's name; throws a usage error that lists the formats for any other.
ChartFormat chartFormatOf(const std::string& path);

/// The bytes of a chart. All formats but json ask for gnuplot (gnuplot.h).
std::string drawChart(const ChartData& data, ChartFormat format, Progress& progress);

/// Writes it, whole or not at all.
void writeChart(const std::string& path, const ChartData& data, Progress& progress);

}  // namespace shbake::chart
