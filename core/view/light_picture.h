// A light drawn as a lat-long map.
#pragma once

#include <functional>

#include "base/parallel.h"
#include "base/vec3.h"
#include "light/light.h"
#include "view/picture.h"
#include "view/tone_map.h"

namespace shbake {

/// Radiance from a direction of unit length.
using RadianceFunction = std::function<Vec3d(const Vec3d& direction)>;

/// The light as display light, `height` pixels high and twice as wide, laid out as lat-long environment maps are
/// (MapLayout::latLong) and averaged over samples x samples places in each pixel. Where a channel is negative the pixel
/// is magenta, the brighter the more negative: false colour that no light of the picture should have.
Picture lightPicture(const RadianceFunction& radiance, int height, int samples, const ToneMap& tone,
                     const Parallel& parallel);

/// The exposure that takes the mean radiance of the greatest channel of `light` to 0.5 of white; 0 for a light that is
/// black or negative in the mean.
double automaticExposure(const Light& light);

}  // namespace shbake
