// The panels of the error between the vertices. Their captions speak of what is drawn alone.
#include "chart/draw/surface_panels.h"

#include <algorithm>
#include <string>

#include "chart/draw/error_panel.h"
#include "chart/draw/surface_text.h"

namespace shbake::chart {
namespace {

/// Bakes that differ in one setting: a curve.
struct Kind {
  SurfaceRefinement refinement;
  FitKind fit;
  const char* title;
  const char* option;  ///< in captions
  Series::Style style;
  int color;
};

constexpr Kind kKinds[] = {
    {SurfaceRefinement::none, FitKind::vertex, "values of the vertices, by rays", "--rays", Series::Style::strong, 0},
    {SurfaceRefinement::none, FitKind::automatic, "--fit auto, by rays", "--fit auto", Series::Style::line, 1},
    {SurfaceRefinement::none, FitKind::surface, "--fit surface, by rays", "--fit surface", Series::Style::line, 2},
    {SurfaceRefinement::automatic, FitKind::vertex, "finer where the light changes", "--refine auto",
     Series::Style::line, 3},
    {SurfaceRefinement::automatic, FitKind::automatic, "the same, --fit auto", "--refine auto", Series::Style::dashed,
     3},
    {SurfaceRefinement::even, FitKind::vertex, "even edges", "--refine LENGTH", Series::Style::line, 4},
    {SurfaceRefinement::even, FitKind::automatic, "even edges, --fit auto", "--refine LENGTH", Series::Style::dashed,
     4},
    {SurfaceRefinement::chosen, FitKind::automatic, "all chosen, by tolerance", "--tolerance", Series::Style::strong,
     5},
};

bool isOf(const Kind& kind, const SurfacePoint& p) {
  return p.refinement == kind.refinement && p.fit == kind.fit;
}

/// What a viewer sees, as a sentence's beginning.
std::string errorSentence() {
  return "What a viewer sees: the error of the shadowed transfer that is interpolated at random places of the surface, "
         "RMS, relative to the unshadowed transfer; the same places for all bakes. ";
}

/// The options of the drawn curves: "--rays, --fit auto and --tolerance".
std::string drawnOptions(const std::vector<const Kind*>& drawn) {
  std::vector<std::string> options;
  for (const Kind* k : drawn) {
    if (options.empty() || options.back() != k->option) options.emplace_back(k->option);
  }
  std::string text;
  for (std::size_t i = 0; i < options.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == options.size() ? " and " : ", ") + options[i];
  }
  return text;
}

/// The bakes of a mesh that was refined in one way, by vertices, from the mesh as it is on; none where none was.
Series refinedSeries(const ChartData& data, const Kind& kind) {
  Series series{kind.title, kind.style, kind.color, {}};
  bool refined = false;
  for (const SurfacePoint& p : data.surface.points) {
    const bool asIs = p.refinement == SurfaceRefinement::none && p.fit == kind.fit;
    if (p.rays != data.surface.rays || !(asIs || isOf(kind, p))) continue;
    refined |= !asIs;
    addError(series.places, double(p.vertices), p.error.rms);
  }
  if (!refined) series.places.clear();
  return series;
}

/// The mesh as it is, by itself.
Series asItIs(const ChartData& data, FitKind fit) {
  const bool fitted = fit != FitKind::vertex;
  Series series{fitted ? "the mesh as it is, --fit auto" : "the mesh as it is: the default",
                fitted ? Series::Style::rings : Series::Style::star,
                0,
                {}};
  for (const SurfacePoint& p : data.surface.points) {
    if (p.refinement != SurfaceRefinement::none || p.fit != fit || p.rays != data.surface.rays) continue;
    addError(series.places, double(p.vertices), p.error.rms);
  }
  return series;
}

}  // namespace

Panel surfaceTimePanel(const ChartData& data) {
  Panel panel = emptyPanel("surface-time", "Error between the vertices against CPU time", timeAxis());
  panel.y.label = "error between the vertices in %";
  std::vector<CurvePoint> all, defaults;
  for (const SurfacePoint& p : data.surface.points) {
    all.push_back(curvePoint(p));
    if (isDefault(data.surface, p)) defaults.push_back(all.back());
  }
  std::vector<const Kind*> drawn;
  for (const Kind& kind : kKinds) {
    std::vector<CurvePoint> curve;
    for (const SurfacePoint& p : data.surface.points) {
      if (isOf(kind, p)) curve.push_back(curvePoint(p));
    }
    std::sort(curve.begin(), curve.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.cpu < b.cpu; });
    Series series{kind.title, kind.style, kind.color, errorPlaces(curve)};
    if (series.places.empty()) continue;
    drawn.push_back(&kind);
    panel.series.push_back(std::move(series));
  }
  panel.series.push_back(frontSeries(all));
  panel.series.push_back(
      {"default: " + std::to_string(data.surface.rays) + " rays", Series::Style::star, 0, errorPlaces(defaults)});
  panel.caption = errorSentence() + "Drawn for " + drawnOptions(drawn) +
                  ". Times are those of the whole work, refinement and BVH included, on all threads together; refined "
                  "meshes have the default's rays. A curve that falls no more needs vertices or a fit, not rays.";
  if (std::any_of(drawn.begin(), drawn.end(), [](auto* k) { return k->refinement == SurfaceRefinement::chosen; })) {
    panel.caption += " Times of --tolerance include that in which a bake measures its own error.";
  }
  return panel;
}

Panel surfaceVerticesPanel(const ChartData& data) {
  Panel panel = emptyPanel("surface", "Error between the vertices against their number", {"vertices", true});
  panel.y.label = "error between the vertices in %";
  std::vector<const Kind*> drawn;
  for (const Kind& kind : kKinds) {
    if (kind.refinement != SurfaceRefinement::automatic && kind.refinement != SurfaceRefinement::even) continue;
    Series series = refinedSeries(data, kind);
    if (series.places.empty()) continue;
    drawn.push_back(&kind);
    panel.series.push_back(std::move(series));
  }
  for (const FitKind fit : {FitKind::automatic, FitKind::vertex}) panel.series.push_back(asItIs(data, fit));
  panel.caption = errorSentence() + "All with " + std::to_string(data.surface.rays) + " rays a vertex. " +
                  (drawn.empty() ? std::string("The mesh was not refined.")
                                 : "Flat parts were divided by " + drawnOptions(drawn) +
                                       ", with the transfer of the vertices themselves and with --fit auto.");
  return panel;
}

}  // namespace shbake::chart
