// The standard error that a bake states for its points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/lighting_points.h"

namespace shbake {

/// Neighbouring directions of a group (24 pairs in its 4 x 4 grid) of which one is set in the mask and the other is
/// not, over all groups: the length of the boundary between sky and blocked sky, in lattice cells.
int boundaryPairs(std::span<const std::uint16_t> sky);

/// Standard error of a direct transfer estimate, relative to the unshadowed transfer (|t - t*| / |t_unshadowed|).
double directError(int boundaryPairs, int rays, int order);

/// The share of the mesh's area that each lighting point stands for: a third of each face at its corners, file units
/// squared up to the work frame's scale.
std::vector<double> pointAreas(const LightingPoints& points);

}  // namespace shbake
