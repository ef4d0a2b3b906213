#include "reference.h"

#include <algorithm>
#include <limits>

#include "bake/ray_scene.h"
#include "base/progress.h"
#include "chart/sweep/direct.h"

namespace shbake::bench {
namespace {

/// A seed that no bake uses by default, so that the reference is independent of what it judges.
constexpr std::uint64_t kSeed = 0x5EED;

}  // namespace

std::vector<std::uint32_t> choosePoints(const LightingPoints& points, std::size_t count) {
  std::vector<std::uint32_t> chosen;
  const std::size_t n = std::min(count, points.size());
  for (std::size_t i = 0; i < n; ++i) chosen.push_back(static_cast<std::uint32_t>(i * points.size() / n));
  return chosen;
}

std::vector<double> directReference(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, int order,
                                    int rays, const Parallel& parallel) {
  Progress progress;
  const RayScene scene(points, std::numeric_limits<float>::infinity(), parallel, progress);
  const std::vector<float> transfer =
      chart::directTransfer(points, scene, chosen, order, rays, kSeed, parallel, progress);
  return {transfer.begin(), transfer.end()};
}

}  // namespace shbake::bench
