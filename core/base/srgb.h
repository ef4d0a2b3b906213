// The sRGB transfer function (IEC 61966-2-1).
#pragma once

#include <cmath>

#include "base/vec3.h"

namespace shbake {

/// Linear light of an sRGB display value; both 0..1.
inline float srgbToLinear(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// The sRGB display value of linear light; both 0..1.
inline float linearToSrgb(float value) {
  return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

inline Rgb srgbToLinear(const Rgb& c) {
  return {srgbToLinear(c.x), srgbToLinear(c.y), srgbToLinear(c.z)};
}

}  // namespace shbake
