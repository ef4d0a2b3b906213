// docs/accuracy.md from measurements.
#pragma once

#include <string>
#include <vector>

#include "chart/draw/text.h"
#include "chart/sweep/chart_data.h"

namespace shbake::bench {

/// What the page is made of.
struct AccuracyRun {
  std::vector<chart::ChartData> meshes;
  std::vector<std::string> pictures;  ///< file names of the charts of the first meshes, in docs/images
  chart::Table exclusion;             ///< the small scenes with known answers
  std::string command;                ///< with its options, as it was given
  std::string machine;                ///< what it ran on
};

/// The page as Markdown.
std::string accuracyPage(const AccuracyRun& run);

}  // namespace shbake::bench
