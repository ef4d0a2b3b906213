// Lights made from a formula, in closed form at any order. Directions point towards the light and need not have unit
// length, but must not be zero.
#pragma once

#include "light/light.h"

namespace shbake {

/// The same radiance from everywhere.
Light constantLight(int order, const Vec3d& radiance);

/// Radiance from all directions within `halfAngle` (degrees, 0..180) of `direction`: a point-like sun of 0.27 degrees,
/// a window, a hemisphere (90), everything (180).
Light discLight(int order, const Vec3d& direction, double halfAngle, const Vec3d& radiance);

/// The disc of half angle 0..90 degrees that gives a facing diffuse surface this irradiance, computed at this order; at
/// 0 it is directionalLight().
Light discLightOfIrradiance(int order, const Vec3d& direction, double halfAngle, const Vec3d& irradiance);

/// Parallel light that gives a facing diffuse surface this irradiance, computed at this order (as Direct3D's
/// D3DXSHEvalDirectionalLight scales it).
Light directionalLight(int order, const Vec3d& direction, const Vec3d& irradiance);

/// A ball of this radiance and radius at `centre`, seen from the origin. Throws a usage error when the origin is
/// inside.
Light sphereLight(int order, const Vec3d& centre, double radius, const Vec3d& radiance);

/// Radiance that changes linearly with the cosine to `up`, from `bottom` below to `top` above (as Direct3D's
/// D3DXSHEvalHemisphereLight). Exact from order 2 on.
Light gradientLight(int order, const Vec3d& up, const Vec3d& top, const Vec3d& bottom);

}  // namespace shbake
