// Closed forms of simple lights: zonal coefficients about z, turned to their direction.
#include "light/synthetic.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "sh/check.h"
#include "sh/irradiance.h"
#include "sh/zonal.h"

namespace shbake {
namespace {

using std::numbers::pi;

Vec3d unit(const Vec3d& direction) {
  const Vec3d u = normalized(direction);
  if (!isFinite(direction) || u == Vec3d{}) {
    throw usageError("the direction of a light is zero or not finite", "give a vector such as 0,0,1");
  }
  return u;
}

Light zonalLight(const std::vector<double>& zonal, const Vec3d& direction, const Vec3d& color) {
  if (!isFinite(color)) throw usageError("the colour of a light is not finite", "give finite numbers");
  Light light(static_cast<int>(zonal.size()));
  std::vector<double> turned(light.coefficients.size());
  sh::rotateZonal(zonal, unit(direction), turned);
  for (std::size_t i = 0; i < turned.size(); ++i) light.coefficients[i] = color * turned[i];
  return light;
}

void requireHalfAngle(double halfAngle, double most) {
  if (!(halfAngle >= 0 && halfAngle <= most)) {
    throw usageError("the half angle of a disc is out of range",
                     "give degrees from 0 to " + std::to_string(static_cast<int>(most)));
  }
}

/// Irradiance that zonal light about the normal gives: the integral over l of A_l z_l y_l0(z).
double facingIrradiance(const std::vector<double>& zonal) {
  double sum = 0;
  for (int l = 0; l < static_cast<int>(zonal.size()); ++l) {
    sum += sh::cosineLobe(l) * zonal[l] * std::sqrt((2 * l + 1) / (4 * pi));
  }
  return sum;
}

}  // namespace

Light constantLight(int order, const Vec3d& radiance) {
  Light light(order);
  if (!isFinite(radiance)) throw usageError("the colour of a light is not finite", "give finite numbers");
  light.coefficients[0] = radiance * std::sqrt(4 * pi);
  return light;
}

Light discLight(int order, const Vec3d& direction, double halfAngle, const Vec3d& radiance) {
  requireHalfAngle(halfAngle, 180);
  return zonalLight(sh::zonalCap(order, halfAngle * pi / 180), direction, radiance);
}

Light discLightOfIrradiance(int order, const Vec3d& direction, double halfAngle, const Vec3d& irradiance) {
  requireHalfAngle(halfAngle, 90);
  sh::requireOrder(order, 1, kMaxLightOrder, "a light");
  std::vector<double> zonal(order);
  if (halfAngle > 0) {
    zonal = sh::zonalCap(order, halfAngle * pi / 180);
  } else {
    for (int l = 0; l < order; ++l) zonal[l] = std::sqrt((2 * l + 1) / (4 * pi));
  }
  return zonalLight(zonal, direction, irradiance * (1 / facingIrradiance(zonal)));
}

Light directionalLight(int order, const Vec3d& direction, const Vec3d& irradiance) {
  return discLightOfIrradiance(order, direction, 0, irradiance);
}

Light sphereLight(int order, const Vec3d& centre, double radius, const Vec3d& radiance) {
  const double distance = length(centre);
  if (!(radius >= 0 && radius < distance)) {
    throw usageError("the radius of a ball of light is negative or reaches the origin", "move or shrink it");
  }
  return discLight(order, centre, std::asin(radius / distance) * 180 / pi, radiance);
}

Light gradientLight(int order, const Vec3d& up, const Vec3d& top, const Vec3d& bottom) {
  Light light = constantLight(order, 0.5 * (top + bottom));
  if (order < 2) return light;
  // The slope cos t (top - bottom) / 2: cos t = sqrt(4 pi / 3) y_10.
  std::vector<double> zonal(order);
  zonal[1] = std::sqrt(4 * pi / 3);
  addLight(light, zonalLight(zonal, up, 0.5 * (top - bottom)));
  return light;
}

}  // namespace shbake
