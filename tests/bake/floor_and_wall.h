// A floor and a wall that hide the sky from each other, with the closed form of how much.
#pragma once

#include <array>
#include <cstddef>

#include "mesh/lighting_points.h"

namespace shbake::testing {

/// Two unit squares that meet at right angles in the y axis and face each other, n x n cells each.
Mesh floorAndWall(int n);

/// The visible share of the sky at a place of floorAndWall(): `weights` of the corners of `face`.
double skyOfFloorAndWall(const LightingPoints& points, std::size_t face, const std::array<double, 3>& weights);

}  // namespace shbake::testing
