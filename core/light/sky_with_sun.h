// A sky of the CIE and the disc of its sun: one choice of people, as light, as what is seen and in words.
#pragma once

#include <functional>
#include <string>

#include "light/light.h"
#include "light/sky.h"

namespace shbake {

/// Half the angle under which the sun is seen from the earth, in degrees.
inline constexpr double kSunHalfAngle = 0.2665;

struct SkyWithSun {
  SkyOptions sky;
  /// What the disc of the sun adds on a surface that faces it, 0 or more a channel, where the zenith's radiance is
  /// sky.zenith; 0: the sun has no disc.
  Vec3d sunIrradiance{};
};

/// The sky, the ground below it and the sun's disc as light of the stated order. Throws what skyLight() and
/// discLightOfIrradiance() throw.
Light skyWithSunLight(int order, const SkyWithSun& choice);

/// The radiance behind that light as a function of a direction of unit length. Below the horizon it is the ground's,
/// which hides the lower part of a sun that sets.
std::function<Vec3d(const Vec3d& direction)> skyWithSunRadiance(const SkyWithSun& choice);

/// "clear sky, sun at 40,120 degrees"; the sun is left out where its place changes nothing.
std::string describeSkyWithSun(const SkyWithSun& choice);

}  // namespace shbake
