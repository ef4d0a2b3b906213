// The exposure that suits a relit surface: a quantile over its area.
#include "view/exposure.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"

namespace shbake {
namespace {

constexpr double kAreaBelow = 0.99;
constexpr double kLevel = 0.9;

}  // namespace

double automaticExposure(std::span<const Rgb> colors, std::span<const double> areas) {
  if (colors.size() != areas.size()) throw usageError("there are not as many areas as colours");
  std::vector<std::pair<float, double>> byRadiance;
  double total = 0;
  for (std::size_t v = 0; v < colors.size(); ++v) {
    byRadiance.emplace_back(std::max({colors[v].x, colors[v].y, colors[v].z}), areas[v]);
    total += areas[v];
  }
  std::sort(byRadiance.begin(), byRadiance.end());
  double below = 0;
  for (const auto& [radiance, area] : byRadiance) {
    below += area;
    if (below < kAreaBelow * total) continue;
    return radiance > 0 ? std::log2(kLevel / static_cast<double>(radiance)) : 0;
  }
  return 0;
}

}  // namespace shbake
