// Coincident faces that are the two sides of one sheet.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Models show a sheet from both sides by giving each face twice, wound both ways. A ray meets either of the two, at
/// random; the one that it should see is the one whose front it comes from.
///
/// For each face, one with the same corners wound the other way, or LightingPoints::kNone; empty when no face has one.
/// Progress counts faces.
std::vector<std::uint32_t> faceTwins(const LightingPoints& points, Progress& progress);

}  // namespace shbake
