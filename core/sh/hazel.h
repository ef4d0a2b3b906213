// Order 3 in Hazel's normalisation: a mean, a vector and a traceless matrix; quadric and non-linear irradiance.
#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace shbake::sh {

/// Means over the sphere of R, R d and R (d d^T - 1/3), for radiance R (maths.md (20)).
struct HazelLight {
  double r0 = 0;
  Vec3d r1;                       ///< |r1| <= r0 where R is nowhere negative
  double xx = 0, yy = 0, zz = 0;  ///< the diagonal of R_2; sums to zero
  double xy = 0, xz = 0, yz = 0;  ///< its other entries
};

/// From 9 coefficients of the basis of basis.h, and back. toCoefficients() takes the traceless part of R_2.
HazelLight toHazel(std::span<const double> nine);
std::array<double, 9> toCoefficients(const HazelLight& light);

/// Radiance R0 + 3 R1.d + 15/2 d.R2 d in a direction of unit length.
double radiance(const HazelLight& light, const Vec3d& direction);

/// Outgoing radiance of a white diffuse surface, E / pi = R0 + 2 R1.n + 15/8 n.R2 n, for a normal of unit length.
double diffuse(const HazelLight& light, const Vec3d& normal);
/// The same as a quadric: n4^T M n4 with n4 = (x, y, z, 1); M symmetric, by rows.
std::array<std::array<double, 4>, 4> diffuseQuadric(const HazelLight& light);

/// E / pi from order 2 alone, R0 + 2 R1.n. Negative away from the light where |R1| > R0 / 2; its least value is R0 - 2
/// |R1|.
double diffuseLinear(double r0, const Vec3d& r1, const Vec3d& normal);

/// E / pi from order 2 without negative values: R0 (a + (1 - a)(p + 1) q^p), q = (1 + R1.n / |R1|) / 2, p = 1 + 2 r,
/// a = (1 - r) / (1 + r), r = |R1| / R0 (maths.md (22)). Its mean is R0 and n to -n it differs by 4 |R1| along R1, as
/// the exact one does. Zero where R0 <= 0; r above 1, which no light has, counts as 1.
double diffuseNonlinear(double r0, const Vec3d& r1, const Vec3d& normal);

}  // namespace shbake::sh
