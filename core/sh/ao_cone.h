// Irradiance through a cone about the normal: what ambient occlusion and a bent normal say about diffuse light.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake::sh {

/// The cosine kernel cut to a cone of half-angle t: 2 pi times the integral over u = cos t..1 of u P_l(u) (maths.md
/// (14)). `coneCosine` = cos t is 0..1; at 0 it is cosineLobe(l). Odd degrees above 1 do not vanish for narrow cones.
/// Throws a usage error for l < 0 or a cosine out of range.
double coneCosineLobe(int l, double coneCosine);

/// cos t of the cone that lets through the share `visibility` (0..1) of a white sky's irradiance: sqrt(1 - visibility).
double coneFromCosineVisibility(double visibility);
/// cos t of the cone that covers the share `visibility` (0..1) of the hemisphere's solid angle: 1 - visibility.
double coneFromUniformVisibility(double visibility);

/// Irradiance at a surface whose sky is the cone about `normal`: the sum of coneCosineLobe(l) L_lm y_lm(normal).
/// `normal` has unit length and serves as bent normal at once, `light` is radiance with order^2 coefficients.
double coneIrradiance(int order, std::span<const double> light, const Vec3d& normal, double coneCosine);

}  // namespace shbake::sh
