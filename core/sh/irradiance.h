// The clamped cosine: irradiance and unshadowed diffuse transfer.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake::sh {

/// The cosine lobe max(cos t, 0) as a convolution kernel: A_l = 2 pi times the integral over u = 0..1 of u P_l(u), so
/// that irradiance E_lm = A_l L_lm (maths.md (10)). pi, 2pi/3, pi/4, 0, -pi/24, 0, pi/64, ...; relative error below
/// 1e-15 l for any l >= 0; throws a usage error when l is negative.
double cosineLobe(int l);

/// Transfer of an open diffuse point: out[index(l, m)] = albedo / pi * A_l * y_lm(normal), order^2 values. The dot
/// product with light is outgoing radiance. `normal` has unit length; `albedo` is 0..1.
void unshadowedTransfer(int order, const Vec3d& normal, double albedo, std::span<double> out);

/// The L2 norm of unshadowedTransfer() with albedo 1; it does not depend on the normal.
double unshadowedNorm(int order);

/// Irradiance from radiance, as functions of direction: out_lm = A_l light_lm, order^2 coefficients, in place or not.
void irradiance(int order, std::span<const double> light, std::span<double> out);

/// The irradiance E of a surface facing `normal` (unit length) under light with order^2 coefficients.
double irradianceAt(int order, std::span<const double> light, const Vec3d& normal);

}  // namespace shbake::sh
