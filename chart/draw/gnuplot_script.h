// Panels as scripts for gnuplot.
#pragma once

#include <span>
#include <string>

#include "chart/draw/panel.h"

namespace shbake::chart {

enum class PictureFormat { svg, png };

/// A script that writes one picture of all panels to standard output: one fills it, more stand in two columns under the
/// title. Text is taken as it stands, without gnuplot's markup; control characters become blanks.
std::string gnuplotScript(std::span<const Panel> panels, const std::string& title, PictureFormat format);

}  // namespace shbake::chart
