// What reflections that are not summed leave out: bakes of the whole mesh, by the same rays.
#include "chart/sweep/bounce_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/baker.h"
#include "bake/stated_error.h"
#include "chart/methods/cpu_clock.h"
#include "sh/irradiance.h"

namespace shbake::chart {
namespace {

constexpr std::array kBounces{0, 1, 2, 3, 4, 6, 8, BakeOptions::kBouncesAuto};
/// The reference's tolerance, as a part of the default one.
constexpr double kReferencePart = 0.01;
/// Finding what is hit and solving cost at most this many times as much as finding whether anything is
/// (docs/accuracy.md); the BVH comes on top.
constexpr double kCostOverShadows = 4;

/// |a - b| relative to the unshadowed transfer with the same albedo: an RMS over points by area and over channels.
double difference(const TransferSet& a, const TransferSet& b, const LightingPoints& points) {
  const std::vector<double> areas = pointAreas(points);
  const std::size_t stride = a.stride();
  double sum = 0, scale = 0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    const Rgb& rho = points.pointAlbedo[p];
    scale += areas[p] * static_cast<double>(a.channels == 3 ? dot(rho, rho) : rho.x * rho.x);
    for (std::size_t k = 0; k < stride; ++k) {
      sum +=
          areas[p] * std::pow(static_cast<double>(a.coefficients[p * stride + k] - b.coefficients[p * stride + k]), 2);
    }
  }
  return scale > 0 ? std::sqrt(sum / scale) / sh::unshadowedNorm(a.order) : 0;
}

}  // namespace

void studyBounces(const LightingPoints& points, int order, double secondsPerRay, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data) {
  const double bakes = kBounces.size() + 1;
  const double fixed = bakes * data.buildSeconds;
  int rays = 64;
  const auto foreseen = [&] { return (fixed + bakes * rays * secondsPerRay * kCostOverShadows) / parallel.threads(); };
  while (rays > 16 && foreseen() > deadline.left()) rays /= 2;
  if (foreseen() > deadline.left()) {
    data.notes.push_back("reflections were left out: baking the whole mesh nine times would not fit the budget");
    return;
  }
  BakeOptions options;
  options.order = order;
  options.rays = rays;
  progress.begin("reflections", bakes, "bakes");
  Progress polled([&progress](const ProgressState&) { return progress.tryAdvance(0); });
  const auto bake = [&](int bounces, double tolerance) {
    options.bounces = bounces;
    options.tolerance = tolerance;
    PointBake baked = bakePoints(points, {}, options, parallel, polled);
    progress.advance(1);
    return baked;
  };
  const double tolerance = BakeOptions().tolerance;
  const PointBake truth = bake(BakeOptions::kBouncesAuto, kReferencePart * tolerance);
  data.bounces.rays = truth.rays;
  for (const int bounces : kBounces) {
    const double start = cpuSeconds();
    const PointBake baked = bake(bounces, tolerance);
    BouncePoint point;
    point.cpu = cpuSeconds() - start;
    point.bounces = baked.bounces;
    point.automatic = bounces == BakeOptions::kBouncesAuto;
    point.error = difference(baked.transfer, truth.transfer, points);
    data.bounces.points.push_back(point);
  }
  progress.end();
}

}  // namespace shbake::chart
