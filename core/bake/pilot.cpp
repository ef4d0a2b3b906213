#include "bake/pilot.h"

#include <algorithm>
#include <cmath>

#include "bake/flush_denormals.h"
#include "bake/point_tracer.h"
#include "bake/stated_error.h"
#include "base/hash.h"

namespace shbake {
namespace {

/// Points of the pilot: the RMS over them is known to 100 % / sqrt(2 * 1024) = 2 %.
constexpr std::size_t kPilotPoints = 1024;
/// Aiming this far below the tolerance covers the pilot's own scatter and the rise of the error by reflected light.
constexpr double kAim = 0.9;
constexpr int kFirstRays = 64;
constexpr int kMostRays = 1 << 20;
/// The pilot stops following its own prediction where a round costs more than a bake of ordinary meshes.
constexpr int kMostPilotRays = 16384;

/// The stated RMS error of the chosen points at some number of rays.
double measure(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, const RayScene& scene,
               const BakeOptions& options, int rays, const Parallel& parallel, Progress& progress) {
  const DirectionSet directions(rays, 1);
  std::vector<PointTracer> tracers;
  for (int i = 0; i < parallel.threads(); ++i) tracers.emplace_back(points, scene, directions, options.seed, false);
  std::vector<std::uint32_t> pairs(chosen.size());
  parallel.forBlocks(chosen.size(), 16, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    std::vector<std::uint16_t> sky(static_cast<std::size_t>(directions.groups()));
    for (std::size_t i = begin; i < end; ++i) {
      tracers[static_cast<std::size_t>(worker)].look(chosen[i], sky);
      pairs[i] = boundaryPairs(sky);
      progress.advance(directions.size());
    }
  });
  const std::vector<double> areas = pointAreas(points);
  std::vector<double> weights;
  for (const std::uint32_t p : chosen) weights.push_back(areas[p]);
  return pilotError(pairs, weights, directions.size(), options.order);
}

int roundUp(double rays) {
  const double groups = std::ceil(std::clamp(rays, 1.0, static_cast<double>(kMostRays)) / DirectionSet::kGroup);
  return static_cast<int>(groups) * DirectionSet::kGroup;
}

}  // namespace

std::vector<std::uint32_t> pilotPoints(const LightingPoints& points, const std::vector<std::uint8_t>& wanted) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (wanted.empty() || wanted[p] != 0) all.push_back(p);
  }
  if (all.size() <= kPilotPoints) return all;
  // One at random from each of equal stretches of the Morton curve.
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < kPilotPoints; ++i) {
    const std::size_t begin = i * all.size() / kPilotPoints, end = (i + 1) * all.size() / kPilotPoints;
    chosen.push_back(all[begin + hashBits(0, i) % (end - begin)]);
  }
  return chosen;
}

int chooseRays(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, const RayScene& scene,
               const BakeOptions& options, const Parallel& parallel, Progress& progress) {
  const std::vector<std::uint32_t> chosen = pilotPoints(points, wanted);
  const double aim = kAim * options.tolerance;
  progress.begin("choosing rays", 0, "rays");
  // Follow error ~ rays^(-3/4) to the aim, then measure there: the law holds better the nearer it starts.
  int rays = kFirstRays;
  for (int round = 0; round < 3; ++round) {
    const double error = measure(points, chosen, scene, options, rays, parallel, progress);
    const int next = error > 0 ? roundUp(rays * std::pow(error / aim, 4.0 / 3)) : DirectionSet::kGroup;
    const bool close = next <= 2 * rays && 2 * next >= rays;
    rays = next;
    if (close || rays > kMostPilotRays || error == 0) break;
  }
  progress.end();
  return rays;
}

}  // namespace shbake
