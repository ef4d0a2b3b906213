// The panels of the error between the vertices.
#pragma once

#include "chart/draw/panel.h"
#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// Against CPU time: by rays, fits, refinement and tolerances, with the front of them all and the default.
Panel surfaceTimePanel(const ChartData& data);

/// Against the number of vertices, at the default's rays.
Panel surfaceVerticesPanel(const ChartData& data);

}  // namespace shbake::chart
