// What is looked up in a chart's numbers.
#include "chart/sweep/chart_data.h"

#include <algorithm>
#include <iterator>

namespace shbake::chart {

const MethodCurve* curveOf(const ChartData& data, const char* id) {
  const auto found = std::find_if(data.curves.begin(), data.curves.end(),
                                  [&](const MethodCurve& c) { return std::string(id) == c.method->id; });
  return found == data.curves.end() ? nullptr : &*found;
}

Excess excessOfDefault(const ChartData& data, std::span<const MethodGroup> groups) {
  std::vector<CurvePoint> others;
  for (const MethodCurve& c : data.curves) {
    if (std::find(groups.begin(), groups.end(), c.method->group) == groups.end()) continue;
    const bool ours = c.method->group == MethodGroup::ours;
    std::copy_if(c.points.begin(), c.points.end(), std::back_inserter(others),
                 [&](const CurvePoint& p) { return !ours || p.rays != data.defaults.rays; });
  }
  return excessOverFront(data.defaults, others);
}

bool isDefault(const SurfaceStudy& study, const SurfacePoint& point) {
  return point.refinement == SurfaceRefinement::none && point.fit == FitKind::vertex && point.rays == study.rays;
}

CurvePoint curvePoint(const SurfacePoint& point) {
  CurvePoint place;
  place.rays = point.rays;
  place.cpu = point.cpu;
  place.error = point.error.rms;
  return place;
}

}  // namespace shbake::chart
