// Hazel, "Spherical Harmonics for Lighting" (Geomerics, ARM); the non-linear form from "Reconstructing Diffuse Lighting
// from Spherical Harmonic Data" (Geomerics, CEDEC 2015). Hazel's I is E / pi. The quadric: Ramamoorthi and Hanrahan,
// "An efficient representation for irradiance environment maps", SIGGRAPH 2001.
#include "sh/hazel.h"

#include <algorithm>
#include <cmath>

#include "sh/check.h"

namespace shbake::sh {
namespace {

// 4 pi times the factor before x, xy, x^2 - y^2 and z^2 - 1/3 in the basis.
constexpr double kMean = 3.54490770181103205460;        // sqrt(4 pi): c_00 / R_0
constexpr double kVector = 6.13996024767893093088;      // sqrt(12 pi)
constexpr double kMixed = 13.72936849295653490028;      // sqrt(60 pi)
constexpr double kDifference = 6.86468424647826745014;  // sqrt(15 pi)
constexpr double kAxial = 11.88998189281803304004;      // sqrt(45 pi)

double quadratic(const HazelLight& light, const Vec3d& d) {
  return light.xx * d.x * d.x + light.yy * d.y * d.y + light.zz * d.z * d.z +
         2 * (light.xy * d.x * d.y + light.xz * d.x * d.z + light.yz * d.y * d.z);
}

}  // namespace

HazelLight toHazel(std::span<const double> nine) {
  requireCoefficients(3, nine.size(), "the input of toHazel()");
  HazelLight light;
  light.r0 = nine[0] / kMean;
  light.r1 = {nine[3] / kVector, nine[1] / kVector, nine[2] / kVector};
  const double difference = nine[8] / kDifference;  // R_xx - R_yy
  light.zz = nine[6] / kAxial;
  light.xx = (difference - light.zz) / 2;
  light.yy = (-difference - light.zz) / 2;
  light.xy = nine[4] / kMixed;
  light.yz = nine[5] / kMixed;
  light.xz = nine[7] / kMixed;
  return light;
}

std::array<double, 9> toCoefficients(const HazelLight& light) {
  const double axial = (2 * light.zz - light.xx - light.yy) / 3;  // R_zz where the trace is zero
  return {kMean * light.r0,     kVector * light.r1.y, kVector * light.r1.z,
          kVector * light.r1.x, kMixed * light.xy,    kMixed * light.yz,
          kAxial * axial,       kMixed * light.xz,    kDifference * (light.xx - light.yy)};
}

double radiance(const HazelLight& light, const Vec3d& direction) {
  return light.r0 + 3 * dot(light.r1, direction) + 7.5 * quadratic(light, direction);
}

double diffuse(const HazelLight& light, const Vec3d& normal) {
  return light.r0 + 2 * dot(light.r1, normal) + 1.875 * quadratic(light, normal);
}

std::array<std::array<double, 4>, 4> diffuseQuadric(const HazelLight& light) {
  constexpr double k = 1.875;
  const Vec3d& r = light.r1;
  return {{{k * light.xx, k * light.xy, k * light.xz, r.x},
           {k * light.xy, k * light.yy, k * light.yz, r.y},
           {k * light.xz, k * light.yz, k * light.zz, r.z},
           {r.x, r.y, r.z, light.r0}}};
}

double diffuseLinear(double r0, const Vec3d& r1, const Vec3d& normal) {
  return r0 + 2 * dot(r1, normal);
}

double diffuseNonlinear(double r0, const Vec3d& r1, const Vec3d& normal) {
  if (!(r0 > 0)) return 0;
  const double size = length(r1);
  // Without a direction the light is the same from everywhere.
  if (!(size > 0)) return r0;
  const double r = std::min(size / r0, 1.0);
  // Rounding takes the cosine beyond -1 opposite the light, where a negative base has no power p.
  const double q = std::max(0.0, (1 + dot(r1, normal) / size) / 2);
  const double p = 1 + 2 * r, a = (1 - r) / (1 + r);
  return r0 * (a + (1 - a) * (p + 1) * std::pow(q, p));
}

}  // namespace shbake::sh
