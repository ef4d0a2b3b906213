// Three irradiances and one through the surface: Bunnell, "Adding Real-Time Point-Based GI to Your Video Game", GDC
// 2010, with vectors at 45 degrees. The affine interpolation and the cones of 45 degrees are ours.
#include "sh/tangent_basis.h"

#include "sh/ao_cone.h"

namespace shbake::sh {

TangentIrradiance tangentIrradiance(int order, std::span<const double> light, const LocalFrame& frame,
                                    double coneCosine) {
  TangentIrradiance result;
  for (std::size_t i = 0; i < kTangentDirections.size(); ++i) {
    const Vec3d& t = kTangentDirections[i];
    const Vec3d world = normalized(frame.x * t.x + frame.y * t.y + frame.z * t.z);
    result.front[i] = coneIrradiance(order, light, world, coneCosine);
  }
  result.through = coneIrradiance(order, light, -frame.z, coneCosine);
  return result;
}

double interpolate(const TangentIrradiance& values, const Vec3d& normal) {
  // E = a + g.n: the three tangent parts of the directions add up to zero and their squares to 3/4 each way; the mean
  // of the front and the value at -z determine a and g_z.
  constexpr double h = 0.70710678118654752440;
  const auto& [f0, f1, f2] = values.front;
  const double gz = ((f0 + f1 + f2) / 3 - values.through) / (1 + h);
  double gx = 0, gy = 0;
  for (std::size_t i = 0; i < kTangentDirections.size(); ++i) {
    gx += values.front[i] * kTangentDirections[i].x * 4 / 3;
    gy += values.front[i] * kTangentDirections[i].y * 4 / 3;
  }
  return values.through + gz + gx * normal.x + gy * normal.y + gz * normal.z;
}

}  // namespace shbake::sh
