// The exposure that suits a relit surface.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake {

/// The exposure (a power of 2) that takes the radiance which 99 % of the surface's area stays below to 0.9 of white.
/// The greatest channel counts, so that no colour is cut off; weights are vertexAreas(). It depends on the surface and
/// its light alone, not on the camera, so that the frames of a turntable match. 0 where nothing is bright.
/// Throws a usage error unless there is an area for each colour.
double automaticExposure(std::span<const Rgb> colors, std::span<const double> areas);

}  // namespace shbake
