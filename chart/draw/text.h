// Numbers and sentences of charts.
#pragma once

#include <string>
#include <vector>

#include "chart/sweep/chart_data.h"

namespace shbake::chart {

/// A number with so many digits behind the point, or with so many significant ones and no exponent.
std::string fixedText(double value, int digits);
std::string significantText(double value, int digits);
/// A share as percent in at most three significant digits: "0.5 %", "97.1 %".
std::string percentText(double share);
/// Seconds in three significant digits: "0.031 s".
std::string secondsText(double seconds);

/// A time to an error, or a multiple of it, in two or three significant digits: "0.52", "> 3.1", "never".
std::string reachText(const Reach& reach, double value, int digits);

/// "For 1 % error use --rays 512 --bounces 3: 1.2 s of CPU time without reflections." One for each advice, or why there
/// is none.
std::vector<std::string> adviceSentences(const ChartData& data);

/// What was measured and how, one sentence each: mesh, reference, its noise, notes.
std::vector<std::string> measurementSentences(const ChartData& data);

/// A table as rows of cells, the first of them its head.
struct Table {
  std::string title;
  std::vector<std::vector<std::string>> rows;
};

/// The numbers of the panels: methods by rays, methods as a whole, orders, reflections, errors between the vertices.
std::vector<Table> tablesOf(const ChartData& data);

}  // namespace shbake::chart
