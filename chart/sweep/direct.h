// Direct transfer of chosen points by shbake's own classes, on all threads: what references are made of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/ray_scene.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// Shadowed transfer of albedo 1 of each chosen point: order^2 values a point. Advances `progress` by rays.
std::vector<float> directTransfer(const LightingPoints& points, const RayScene& scene,
                                  std::span<const std::uint32_t> chosen, int order, int rays, std::uint64_t seed,
                                  const Parallel& parallel, Progress& progress);

}  // namespace shbake::chart
