// Whether the coordinates of a text file need double precision.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake {

/// The rule of all text formats for Mesh::doublePositions: true when rounding the coordinates to float moves some point
/// by more than 1e-7 of the bounding box's diagonal. Points centred on the origin move by at most 3e-8 of it (2^-24 of
/// half the diagonal), a box with a corner at the origin by 6e-8; so the rule finds the meshes that lie so far out
/// (scans in geographic coordinates) that float loses what it would keep for centred data, and leaves all others in
/// float. Coordinates beyond the range of float need double, too.
bool positionsNeedDouble(std::span<const Vec3d> positions);

}  // namespace shbake
