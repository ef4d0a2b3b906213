// Sentences and the table of the error between the vertices.
#include "chart/draw/surface_text.h"

#include <algorithm>

namespace shbake::chart {
namespace {

std::string refinementText(const SurfacePoint& p) {
  switch (p.refinement) {
    case SurfaceRefinement::even:
      return "--refine " + significantText(p.asked, 3);
    case SurfaceRefinement::automatic:
      return "--refine auto, aimed at " + percentText(p.asked);
    case SurfaceRefinement::chosen:
      return "--tolerance " + significantText(p.asked, 1);
    default:
      return "as it is";
  }
}

std::string fitText(FitKind fit) {
  return fit == FitKind::vertex ? "of the vertices" : std::string("--fit ") + fitName(fit);
}

/// The options that differ from the default: "--rays 64 --fit auto", "--tolerance 0.02".
std::string optionsText(const SurfacePoint& p, const SurfaceStudy& study) {
  if (p.refinement == SurfaceRefinement::chosen) return refinementText(p);
  std::string text = p.refinement == SurfaceRefinement::none ? "" : refinementText(p);
  const auto add = [&](const std::string& option) { text += (text.empty() ? "" : " ") + option; };
  if (p.rays != study.rays) add("--rays " + std::to_string(p.rays));
  if (p.fit != FitKind::vertex) add(fitText(p.fit));
  return text.empty() ? "the default" : text;
}

/// "900 vertices, 3.00 s of CPU time."
std::string costText(const SurfacePoint& p) {
  return std::to_string(p.vertices) + " vertices, " + secondsText(p.cpu) + " of CPU time.";
}

std::string adviceSentence(const SurfaceAdvice& a, const SurfaceStudy& study) {
  const std::string goal = "For " + percentText(a.error) + " between the vertices ";
  if (!a.point) return goal + "no setting that was measured is enough.";
  const SurfacePoint& p = study.points[*a.point];
  return goal + "use " + optionsText(p, study) + ": it errs " + percentText(p.error.rms) + " with " + costText(p);
}

}  // namespace

std::vector<std::string> surfaceSentences(const ChartData& data) {
  const std::vector<SurfacePoint>& points = data.surface.points;
  const auto first =
      std::find_if(points.begin(), points.end(), [&](const SurfacePoint& p) { return isDefault(data.surface, p); });
  if (first == points.end()) return {};
  std::vector<std::string> sentences{"Between its " + std::to_string(first->vertices) + " vertices the mesh errs " +
                                     percentText(first->error.rms) + " with the default's " +
                                     std::to_string(first->rays) + " rays."};
  for (const SurfaceAdvice& a : data.surfaceAdvice) sentences.push_back(adviceSentence(a, data.surface));
  const auto best = std::min_element(points.begin(), points.end(), [](const SurfacePoint& a, const SurfacePoint& b) {
    return a.error.rms < b.error.rms;
  });
  const bool isAdvised = std::any_of(data.surfaceAdvice.begin(), data.surfaceAdvice.end(), [&](const SurfaceAdvice& a) {
    return a.point && *a.point == static_cast<std::size_t>(best - points.begin());
  });
  if (best->error.rms < first->error.low && !isAdvised) {
    sentences.push_back("The least measured is " + percentText(best->error.rms) + " with " +
                        optionsText(*best, data.surface) + ": " + costText(*best));
  }
  return sentences;
}

std::vector<std::string> surfaceMeasurement(const ChartData& data) {
  if (data.surface.points.empty()) return {};
  const SurfaceError& error = data.surface.points.front().error;
  return {"The error between the vertices was measured at " + std::to_string(error.samples) +
          " places of the surface that had no part in any bake, the same for all of them, each by " +
          std::to_string(error.rays) + " rays, whose noise is taken out."};
}

Table surfaceTable(const ChartData& data) {
  Table table{"Error between the vertices",
              {{"mesh", "vertices", "rays", "values", "error", "95 % between", "CPU time of all the work"}}};
  for (const SurfacePoint& p : data.surface.points) {
    table.rows.push_back({refinementText(p), std::to_string(p.vertices), std::to_string(p.rays), fitText(p.fit),
                          percentText(p.error.rms), percentText(p.error.low) + " and " + percentText(p.error.high),
                          secondsText(p.cpu)});
  }
  return table;
}

}  // namespace shbake::chart
