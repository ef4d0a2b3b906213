// The panels of a chart from its numbers.
#include "chart/draw/panels.h"

#include <algorithm>

#include "chart/draw/text.h"

namespace shbake::chart {
namespace {

constexpr double kPercent = 100;

/// Adds an error in percent; one of 0 has no place on a logarithmic axis.
void addError(std::vector<Place>& places, double x, double error) {
  if (error > 0) places.push_back({x, kPercent * error});
}

std::vector<Place> placesOf(const std::vector<CurvePoint>& points) {
  std::vector<Place> places;
  for (const CurvePoint& p : points) addError(places, p.cpu, p.error);
  return places;
}

Panel emptyPanel(const std::string& name, const std::string& title, const Axis& x) {
  Panel panel;
  panel.name = name;
  panel.title = title;
  panel.x = x;
  panel.y = {"error in %", true};
  return panel;
}

bool hasPlaces(const Panel& panel) {
  return std::any_of(panel.series.begin(), panel.series.end(), [](const Series& s) { return !s.places.empty(); });
}

/// Curves of some groups, the front of them all, and the default.
Panel speedPanel(const std::string& name, const std::string& title, const ChartData& data,
                 std::initializer_list<MethodGroup> groups) {
  Panel panel = emptyPanel(name, title, {"CPU time for the whole mesh in seconds", true});
  std::vector<CurvePoint> all{data.defaults};
  int color = 0;
  for (const MethodCurve& curve : data.curves) {
    if (std::find(groups.begin(), groups.end(), curve.method->group) == groups.end()) continue;
    const bool ours = curve.method->group == MethodGroup::ours;
    const std::string slope = curve.slope ? " (" + fixedText(*curve.slope, 2) + ")" : "";
    panel.series.push_back({curve.method->title + slope, ours ? Series::Style::strong : Series::Style::line, color++,
                            placesOf(curve.points)});
    all.insert(all.end(), curve.points.begin(), curve.points.end());
  }
  const std::vector<bool> front = paretoFront(all);
  std::vector<CurvePoint> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (front[i]) best.push_back(all[i]);
  }
  panel.series.push_back({"Pareto front", Series::Style::rings, 0, placesOf(best)});
  panel.series.push_back(
      {"default: " + percentText(data.defaultTolerance) + " tolerance, " + std::to_string(data.defaults.rays) + " rays",
       Series::Style::star, 0, placesOf({data.defaults})});
  return panel;
}

Panel directionsPanel(const ChartData& data) {
  Panel panel = speedPanel("directions", "Directions: error against CPU time (in brackets: slope by rays)", data,
                           {MethodGroup::ours, MethodGroup::directions});
  panel.caption =
      "16 to 4096 rays a point, all with the same exact exclusion, tracing and sums; the error is that of the "
      "shadowed transfer against the reference, RMS over the surface, relative to the unshadowed transfer. "
      "Slopes are exponents of the error by rays, from 64 to 4096. The BVH, which all need, is not counted.";
  return panel;
}

Panel programsPanel(const ChartData& data) {
  Panel panel = speedPanel("programs", "Other loops and exclusions: error against CPU time (slope by rays)", data,
                           {MethodGroup::ours, MethodGroup::exclusion, MethodGroup::programs});
  panel.caption =
      "Curves that level off have errors that more rays do not mend: light that leaks through what was left "
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

/// The bakes of a mesh that was refined in one way, from the mesh as it is on.
Series surfaceSeries(const ChartData& data, SurfaceRefinement refinement, bool fitted) {
  const bool even = refinement != SurfaceRefinement::automatic;
  Series series;
  series.title = even ? "even edges" : "finer where the light changes";
  if (fitted) series.title += ", fitted";
  series.style = fitted ? Series::Style::dashed : even ? Series::Style::line : Series::Style::strong;
  series.color = even ? 1 : 0;
  std::size_t refined = 0;
  for (const SurfacePoint& p : data.surface.points) {
    const bool asIs = p.refinement == SurfaceRefinement::none;
    if (p.fitted != fitted || !(asIs || p.refinement == refinement) || p.error.rms <= 0) continue;
    refined += asIs ? 0 : 1;
    addError(series.places, double(p.vertices), p.error.rms);
  }
  if (refined == 0) series.places.clear();
  return series;
}

/// The mesh as it is, by itself.
Series asItIs(const ChartData& data, bool fitted) {
  Series series{fitted ? "the mesh as it is, fitted" : "the mesh as it is: the default",
                fitted ? Series::Style::rings : Series::Style::star,
                0,
                {}};
  for (const SurfacePoint& p : data.surface.points) {
    if (p.refinement != SurfaceRefinement::none || p.fitted != fitted) continue;
    addError(series.places, double(p.vertices), p.error.rms);
  }
  return series;
}

Panel surfacePanel(const ChartData& data) {
  Panel panel = emptyPanel("surface", "Error between the vertices against their number", {"vertices", true});
  panel.y.label = "error between the vertices in %";
  for (const SurfaceRefinement refinement : {SurfaceRefinement::automatic, SurfaceRefinement::even}) {
    for (const bool fitted : {false, true}) panel.series.push_back(surfaceSeries(data, refinement, fitted));
  }
  for (const bool fitted : {true, false}) panel.series.push_back(asItIs(data, fitted));
  panel.caption =
      "What a viewer sees: the error of the shadowed transfer that is interpolated at random places of the surface, "
      "RMS, "
      "relative to the unshadowed transfer; " +
      std::to_string(data.surface.rays) +
      " rays a vertex. Flat parts were divided into even edges (--refine LENGTH) and where the light changes (--refine "
      "auto), each with the transfer of the vertices themselves and with values that interpolate best (--fit auto).";
  return panel;
}

}  // namespace

std::vector<Panel> panelsOf(const ChartData& data) {
  std::vector<Panel> panels;
  for (Panel panel :
       {directionsPanel(data), programsPanel(data), ordersPanel(data), bouncesPanel(data), surfacePanel(data)}) {
    if (hasPlaces(panel)) panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace shbake::chart
