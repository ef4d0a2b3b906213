// Skies with the sun's disc: the parts add up, the disc has its irradiance, and words tell what counts.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "light/sky_with_sun.h"
#include "light/synthetic.h"

using namespace shbake;

namespace {

SkyWithSun clearSky() {
  SkyWithSun choice;
  choice.sky.model = SkyModel::clear;
  choice.sky.sunAltitude = 30;
  choice.sky.sunAzimuth = 120.5;
  choice.sky.groundAlbedo = {0.1, 0.2, 0.3};
  choice.sunIrradiance = {5, 4, 3};
  return choice;
}

}  // namespace

TEST_CASE("sky with sun: the light is that of the sky and of the disc") {
  const SkyWithSun choice = clearSky();
  const Light light = skyWithSunLight(5, choice);
  const Light sky = skyLight(5, choice.sky);
  const Light disc = discLightOfIrradiance(5, sunDirection(choice.sky), kSunHalfAngle, choice.sunIrradiance);
  for (std::size_t i = 0; i < 25; ++i) CHECK(light.coefficients[i] == sky.coefficients[i] + disc.coefficients[i]);
}

TEST_CASE("sky with sun: the disc's radiance has the irradiance that was asked for") {
  const SkyWithSun choice = clearSky();
  const auto radiance = skyWithSunRadiance(choice);
  const Vec3d sun = sunDirection(choice.sky);
  // A disc of radiance L and half angle a, seen face on: the integral of L cos over it is pi L sin^2 a.
  const double sine = std::sin(kSunHalfAngle * std::numbers::pi / 180);
  const Vec3d disc = radiance(sun) - skyRadiance(choice.sky, sun);
  CHECK(std::numbers::pi * sine * sine * disc.x == Approx(5).epsilon(1e-9));
  CHECK(std::numbers::pi * sine * sine * disc.z == Approx(3).epsilon(1e-9));
  // A hundredth of its radius beyond the border the sky is bare; as far within it is not.
  const Vec3d beside = normalized(cross(sun, Vec3d{0, 0, 1}));
  const double inside = std::tan(0.99 * kSunHalfAngle * std::numbers::pi / 180),
               outside = std::tan(1.01 * kSunHalfAngle * std::numbers::pi / 180);
  const Vec3d in = normalized(sun + beside * inside), out = normalized(sun + beside * outside);
  CHECK(radiance(out) == skyRadiance(choice.sky, out));
  CHECK(radiance(in).x > skyRadiance(choice.sky, in).x + 1e4);
}

TEST_CASE("sky with sun: the ground reflects the sky evenly and hides the sun") {
  SkyWithSun choice = clearSky();
  choice.sky.sunAltitude = 0;
  const auto radiance = skyWithSunRadiance(choice);
  const Vec3d below = normalized(sunDirection(choice.sky) + Vec3d{0, 0, -1e-6});
  const Vec3d irradiance = skyIrradiance(choice.sky);
  CHECK(radiance(below).x == Approx(0.1 * irradiance.x / std::numbers::pi).epsilon(1e-12));
  CHECK(radiance({0, 0, -1}) == radiance(below));
}

TEST_CASE("sky with sun: words name the sun where its place counts") {
  SkyWithSun choice = clearSky();
  CHECK(describeSkyWithSun(choice) == "clear sky, sun at 30,120.5 degrees");
  choice.sky.model = SkyModel::overcast;
  CHECK(describeSkyWithSun(choice) == "overcast sky, sun at 30,120.5 degrees");
  choice.sunIrradiance = {};
  CHECK(describeSkyWithSun(choice) == "overcast sky");
  choice.sky.model = SkyModel::partlyCloudy;
  choice.sky.sunAltitude = 1e-4;
  CHECK(describeSkyWithSun(choice) == "partly-cloudy sky, sun at 0.0001,120.5 degrees");
}
