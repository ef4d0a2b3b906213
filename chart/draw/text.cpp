// Numbers and sentences of charts.
#include "chart/draw/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "chart/draw/surface_text.h"

namespace shbake::chart {
namespace {

constexpr double kTarget = 0.01;  // the error to which times are compared

std::string errorText(double error) {
  return error > 0 ? percentText(error) : "below the reference's noise";
}

const CurvePoint* pointAt(const MethodCurve& curve, int rays) {
  const auto found =
      std::find_if(curve.points.begin(), curve.points.end(), [&](const auto& p) { return p.rays == rays; });
  return found == curve.points.end() ? nullptr : &*found;
}

std::set<int> raysOf(const ChartData& data) {
  std::set<int> rays;
  for (const MethodCurve& c : data.curves) {
    for (const CurvePoint& p : c.points) rays.insert(p.rays);
  }
  return rays;
}

/// One row a method and one column a number of rays, of what `cell` says.
template <class Cell>
Table byRays(const ChartData& data, const std::string& title, const Cell& cell) {
  const std::set<int> rays = raysOf(data);
  Table table{title, {{"method"}}};
  for (const int n : rays) table.rows[0].push_back(std::to_string(n));
  for (const MethodCurve& c : data.curves) {
    std::vector<std::string> row{c.method->title};
    for (const int n : rays) {
      const CurvePoint* p = pointAt(c, n);
      row.push_back(p == nullptr ? "" : cell(*p));
    }
    table.rows.push_back(row);
  }
  return table;
}

Table methodsTable(const ChartData& data) {
  Table table{
      "Methods",
      {{"method", "what it is", "million rays/s", "slope", "not mended by rays", "seconds to 1 %", "over ours"}}};
  const MethodCurve* ours = curveOf(data, "shbake");
  const auto own = ours == nullptr ? std::nullopt : effortFor(ours->points, kTarget);
  for (const MethodCurve& c : data.curves) {
    if (c.points.empty()) continue;
    const CurvePoint& last = c.points.back();
    const double rate = last.traced * static_cast<double>(data.points) / last.cpu / 1e6;
    const Reach reach = reachOf(c.points, c.systematic, kTarget);
    table.rows.push_back(
        {c.method->title, c.method->detail, significantText(rate, 3), c.slope ? fixedText(*c.slope, 2) : "",
         c.systematic ? percentText(*c.systematic) : "none found", reachText(reach, reach.reading.cpu, 3),
         own ? reachText(reach, reach.reading.cpu / own->cpu, 2) : ""});
  }
  return table;
}

Table ordersTable(const ChartData& data) {
  Table table{"Orders", {{"order", "bands left out", "error of the rays", "CPU time"}}};
  if (!data.light.empty()) table.rows[0].insert(table.rows[0].begin() + 2, "under the light");
  for (const OrderPoint& p : data.orders) {
    std::vector<std::string> row{std::to_string(p.order), percentText(p.truncation), errorText(p.sampling),
                                 secondsText(p.cpu)};
    if (p.lit) row.insert(row.begin() + 2, percentText(*p.lit));
    table.rows.push_back(row);
  }
  return table;
}

Table bouncesTable(const ChartData& data) {
  Table table{"Reflections", {{"reflections", "what is missing", "CPU time of the bake"}}};
  for (const BouncePoint& p : data.bounces.points) {
    table.rows.push_back({p.automatic ? "solved, " + std::to_string(p.bounces) + " steps" : std::to_string(p.bounces),
                          percentText(p.error), secondsText(p.cpu)});
  }
  return table;
}

std::string sentenceOf(const Advice& a, const ChartData& data) {
  const std::string goal = "For " + percentText(a.error) + " error ";
  if (!a.reachable) return goal + "more rays are needed than were measured.";
  std::string text = goal + "use --rays " + std::to_string(a.rays);
  if (data.bounces.rays > 0) text += " --bounces " + (a.bounces ? std::to_string(*a.bounces) : std::string("auto"));
  return text + ": " + secondsText(a.cpu) + " of CPU time for the shadows of all " + std::to_string(data.points) +
         " points.";
}

}  // namespace

std::string fixedText(double value, int digits) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits).ptr;
  const std::string result(text.data(), end);
  const bool isZero = result.find_first_not_of("-0.") == std::string::npos;
  return isZero && result[0] == '-' ? result.substr(1) : result;
}

std::string significantText(double value, int digits) {
  if (value == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixedText(value, std::clamp(digits - 1 - magnitude, 0, 20));
}

std::string percentText(double share) {
  const double percent = 100 * share;
  if (std::abs(percent) >= 999.5) return fixedText(percent, 0) + " %";
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), percent, std::chars_format::general, 3).ptr;
  return std::string(text.data(), end) + " %";
}

std::string secondsText(double seconds) {
  return significantText(seconds, 3) + " s";
}

std::string reachText(const Reach& reach, double value, int digits) {
  if (reach.kind == Reach::Kind::never) return "never";
  return (reach.kind == Reach::Kind::beyond ? "> " : "") + significantText(value, digits);
}

std::vector<std::string> adviceSentences(const ChartData& data) {
  std::vector<std::string> sentences;
  for (const Advice& a : data.advice) sentences.push_back(sentenceOf(a, data));
  return sentences;
}

std::vector<std::string> measurementSentences(const ChartData& data) {
  std::vector<std::string> sentences;
  sentences.push_back(data.mesh + ": " + std::to_string(data.faces) + " triangles, " + std::to_string(data.points) +
                      " lighting points, order " + std::to_string(data.order) + ".");
  sentences.push_back("The reference is two independent estimates of " + std::to_string(data.referenceRays) + " and " +
                      std::to_string(data.referenceRays / 16 * 15) + " rays a point, whose own noise (" +
                      significantText(100 * data.referenceNoise, 2) + " %) is taken out of the errors.");
  sentences.push_back("Times are CPU time of one thread for tracing and sums; the BVH takes " +
                      secondsText(data.buildSeconds) + " more, and the search for contacts, which is counted, " +
                      secondsText(data.contactSeconds) + ".");
  for (const std::string& sentence : surfaceMeasurement(data)) sentences.push_back(sentence);
  for (const std::string& note : data.notes) sentences.push_back(note + ".");
  return sentences;
}

std::vector<Table> tablesOf(const ChartData& data) {
  std::vector<Table> tables;
  tables.push_back(byRays(data, "Error by rays", [](const CurvePoint& p) { return errorText(p.error); }));
  tables.push_back(byRays(data, "CPU seconds by rays", [](const CurvePoint& p) { return significantText(p.cpu, 3); }));
  tables.push_back(methodsTable(data));
  tables.push_back(ordersTable(data));
  if (data.bounces.rays > 0) tables.push_back(bouncesTable(data));
  if (!data.surface.points.empty()) tables.push_back(surfaceTable(data));
  return tables;
}

}  // namespace shbake::chart
