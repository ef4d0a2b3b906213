// A chart as one page for browsers.
#pragma once

#include <functional>
#include <string>

#include "chart/draw/panel.h"
#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// Draws one panel as SVG.
using DrawPanel = std::function<std::string(const Panel&)>;

/// One HTML file that needs nothing else: sentences, the panels as SVG within it, the tables of their numbers.
std::string chartPage(const ChartData& data, const DrawPanel& draw);

/// The <svg> element of an SVG file with `prefix` before all its ids, so that several can stand in one page.
std::string inlineSvg(const std::string& file, const std::string& prefix);

}  // namespace shbake::chart
