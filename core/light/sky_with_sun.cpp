// Skies with the sun's disc, put together from both.
#include "light/sky_with_sun.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "light/synthetic.h"

namespace shbake {
namespace {

/// Degrees in the shortest form that reads back to the same double.
std::string degreesText(double value) {
  char text[64];
  const bool plain = value == 0 || std::abs(value) >= 1e-5;
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  return {text, std::to_chars(text, text + sizeof text, value, format).ptr};
}

}  // namespace

Light skyWithSunLight(int order, const SkyWithSun& choice) {
  Light light = skyLight(order, choice.sky);
  addLight(light, discLightOfIrradiance(order, sunDirection(choice.sky), kSunHalfAngle, choice.sunIrradiance));
  return light;
}

std::function<Vec3d(const Vec3d& direction)> skyWithSunRadiance(const SkyWithSun& choice) {
  const SkyOptions sky = choice.sky;
  const Vec3d sun = sunDirection(sky);
  constexpr double kHalfAngle = kSunHalfAngle * std::numbers::pi / 180;
  const double sine = std::sin(kHalfAngle), cosine = std::cos(kHalfAngle);
  const Vec3d disc = choice.sunIrradiance * (1 / (std::numbers::pi * sine * sine));
  const Vec3d fromGround = skyIrradiance(sky) * std::numbers::inv_pi;
  const Vec3d ground{sky.groundAlbedo.x * fromGround.x, sky.groundAlbedo.y * fromGround.y,
                     sky.groundAlbedo.z * fromGround.z};
  return [=](const Vec3d& d) {
    if (d.z < 0) return ground;
    return dot(d, sun) >= cosine ? skyRadiance(sky, d) + disc : skyRadiance(sky, d);
  };
}

std::string describeSkyWithSun(const SkyWithSun& choice) {
  std::string text = std::string(skyName(choice.sky.model)) + " sky";
  const bool sunCounts = choice.sky.model != SkyModel::overcast || choice.sunIrradiance != Vec3d{};
  if (!sunCounts) return text;
  return text + ", sun at " + degreesText(choice.sky.sunAltitude) + "," + degreesText(choice.sky.sunAzimuth) +
         " degrees";
}

}  // namespace shbake
