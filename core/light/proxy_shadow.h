// Shadows of simple bodies on light: everything within a disc of directions is blocked.
#pragma once

#include "light/light.h"

namespace shbake {

/// The light without what comes from within `halfAngle` (degrees, 0..180) of `direction`, to order `outputOrder`: the
/// product with 1 - disc, integrated exactly for the light given. The disc mixes bands, so bands of the true light
/// above light.order are missed: keep the light to a higher order than the output to lessen that. Throws a usage error
/// for angles out of range, a zero direction or an outputOrder above light.order.
Light withProxyShadow(const Light& light, const Vec3d& direction, double halfAngle, int outputOrder);

}  // namespace shbake
