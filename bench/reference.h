// High-ray references: what the transfer of some points of a mesh really is.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "base/parallel.h"
#include "mesh/lighting_points.h"

namespace shbake::bench {

/// About `count` points spread evenly along the points' order.
std::vector<std::uint32_t> choosePoints(const LightingPoints& points, std::size_t count);

/// Direct transfer of albedo 1 of each chosen point with `rays` rays: order^2 values a point.
std::vector<double> directReference(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, int order,
                                    int rays, const Parallel& parallel);

}  // namespace shbake::bench
