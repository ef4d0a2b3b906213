// Which setting to use for which error.
#include "chart/sweep/advice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shbake::chart {
namespace {

constexpr std::array kErrors{0.05, 0.02, 0.01, 0.005};
constexpr double kReflectionShare = 1.0 / 3;
constexpr int kGroup = 16;  // rays come in groups of 16

std::optional<int> bouncesFor(const BounceStudy& study, double error) {
  for (const BouncePoint& p : study.points) {
    if (!p.automatic && p.error <= error) return p.bounces;
  }
  return {};
}

}  // namespace

std::vector<Advice> adviseSettings(const ChartData& data) {
  std::vector<Advice> all;
  const MethodCurve* ours = curveOf(data, "shbake");
  if (ours == nullptr || ours->points.empty()) return all;
  for (const double error : kErrors) {
    Advice advice;
    advice.error = error;
    const bool reflected = data.bounces.rays > 0;
    if (reflected) advice.bounces = bouncesFor(data.bounces, kReflectionShare * error);
    const double forRays = reflected ? error * std::sqrt(1 - kReflectionShare * kReflectionShare) : error;
    if (const auto reading = effortFor(ours->points, forRays)) {
      advice.reachable = true;
      advice.rays = static_cast<int>(std::ceil(reading->rays / kGroup)) * kGroup;
      advice.cpu = reading->cpu * advice.rays / reading->rays;
    }
    all.push_back(advice);
  }
  return all;
}

std::vector<SurfaceAdvice> adviseSurface(const SurfaceStudy& study) {
  std::vector<SurfaceAdvice> all;
  if (study.points.empty()) return all;
  for (const double error : kErrors) {
    SurfaceAdvice advice{error, {}};
    for (std::size_t i = 0; i < study.points.size(); ++i) {
      const SurfacePoint& p = study.points[i];
      if (p.refinement == SurfaceRefinement::automatic || p.error.rms > error) continue;
      if (!advice.point || p.cpu < study.points[*advice.point].cpu) advice.point = i;
    }
    all.push_back(advice);
  }
  return all;
}

}  // namespace shbake::chart
