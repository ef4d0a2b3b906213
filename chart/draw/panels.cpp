// The panels of a chart from its numbers.
#include "chart/draw/panels.h"

#include <algorithm>
#include <array>
#include <span>

#include "chart/draw/error_panel.h"
#include "chart/draw/surface_panels.h"
#include "chart/draw/text.h"

namespace shbake::chart {
namespace {

bool hasPlaces(const Panel& panel) {
  return std::any_of(panel.series.begin(), panel.series.end(), [](const Series& s) { return !s.places.empty(); });
}

/// Where the default lies, for captions.
std::string placeOfDefault(const Excess& excess) {
  if (excess.factor <= 1) return "Nothing that was measured is both faster and more exact than the default.";
  const std::string lead = "something is both faster and more exact, by " + percentText(excess.factor - 1) + " or more";
  return excess.beyondChance ? "The default is not on the front: " + lead + "."
                             : "The default is on the front within the scatter of the measurement: " + lead +
                                   ", which is less than three standard errors.";
}

/// Curves of some groups, the front of them all, and the default. The caption tells where that lies.
Panel speedPanel(const std::string& name, const std::string& title, const ChartData& data,
                 std::span<const MethodGroup> groups) {
  Panel panel = emptyPanel(name, title, timeAxis());
  std::vector<CurvePoint> all{data.defaults};
  int color = 0;
  for (const MethodCurve& curve : data.curves) {
    if (std::find(groups.begin(), groups.end(), curve.method->group) == groups.end()) continue;
    const bool ours = curve.method->group == MethodGroup::ours;
    const std::string slope = curve.slope ? " (" + fixedText(*curve.slope, 2) + ")" : "";
    panel.series.push_back({curve.method->title + slope, ours ? Series::Style::strong : Series::Style::line, color++,
                            errorPlaces(curve.points)});
    all.insert(all.end(), curve.points.begin(), curve.points.end());
  }
  panel.series.push_back(frontSeries(all));
  panel.caption = placeOfDefault(excessOfDefault(data, groups));
  panel.series.push_back(
      {"default: " + percentText(data.defaultTolerance) + " tolerance, " + std::to_string(data.defaults.rays) + " rays",
       Series::Style::star, 0, errorPlaces({&data.defaults, 1})});
  return panel;
}

Panel directionsPanel(const ChartData& data) {
  Panel panel = speedPanel("directions", "Directions: error against CPU time (in brackets: slope by rays)", data,
                           std::array{MethodGroup::ours, MethodGroup::directions});
  panel.caption +=
      " 16 to 4096 rays a point, all with the same exact exclusion, tracing and sums; the error is that of the "
      "shadowed transfer against the reference, RMS over the surface, relative to the unshadowed transfer. "
      "Slopes are exponents of the error by rays, from 64 to 4096. The BVH, which all need, is not counted.";
  return panel;
}

Panel programsPanel(const ChartData& data) {
  Panel panel = speedPanel("programs", "Other loops and exclusions: error against CPU time (slope by rays)", data,
                           std::array{MethodGroup::ours, MethodGroup::exclusion, MethodGroup::programs});
  panel.caption +=
      " Curves that level off have errors that more rays do not mend: light that leaks through what was left "
      "out, or shadows of the surface on itself.";
  return panel;
}

Panel ordersPanel(const ChartData& data) {
  Panel panel = emptyPanel("orders", "Error against order", {"order: bands of spherical harmonics", false});
  Series missing{"bands left out, all lights alike", Series::Style::strong, 0, {}};
  Series lit{"bands left out, under the light", Series::Style::line, 1, {}};
  Series sampling{"rays (" + std::to_string(data.defaults.rays) + "), within the bands", Series::Style::dashed, 2, {}};
  for (const OrderPoint& p : data.orders) {
    addError(missing.places, p.order, p.truncation);
    if (p.lit) addError(lit.places, p.order, *p.lit);
    addError(sampling.places, p.order, p.sampling);
  }
  panel.series = {missing};
  if (!data.light.empty()) panel.series.push_back(lit);
  panel.series.push_back(sampling);
  panel.caption = "What the bands beyond the order would add, up to order 12: for all lights alike" +
                  std::string(data.light.empty() ? "" : ", and under " + data.light) +
                  "; beside it what the rays of the default err within the bands.";
  return panel;
}

Panel bouncesPanel(const ChartData& data) {
  Panel panel = emptyPanel("bounces", "Error against reflections", {"reflections that are summed", false});
  Series counted{"summed one by one", Series::Style::strong, 0, {}};
  Series solved{"default: solved to the tolerance", Series::Style::star, 0, {}};
  for (const BouncePoint& p : data.bounces.points) {
    addError((p.automatic ? solved : counted).places, p.bounces, p.error);
  }
  panel.series = {counted, solved};
  panel.caption = "What the reflections beyond these would add, by the same " + std::to_string(data.bounces.rays) +
                  " rays a point; the solver's place is the number of its steps.";
  return panel;
}

}  // namespace

std::vector<Panel> panelsOf(const ChartData& data) {
  std::vector<Panel> panels;
  for (Panel panel : {directionsPanel(data), programsPanel(data), ordersPanel(data), bouncesPanel(data),
                      surfaceTimePanel(data), surfaceVerticesPanel(data)}) {
    if (hasPlaces(panel)) panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace shbake::chart
