// Tone curves, as printed in the works that tone_map.h names.
#include "view/tone_map.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"

namespace shbake {
namespace {

float filmic(float x) {
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

float unit(float x) {
  return std::clamp(x, 0.f, 1.f);
}

}  // namespace

Rgb displayLight(const Rgb& radiance, const ToneMap& tone) {
  const float gain = static_cast<float>(std::exp2(tone.exposure));
  // Far beyond white and yet small enough that its square is finite.
  constexpr float kBrightest = 1e12f;
  const auto exposed = [&](float v) { return std::clamp(v * gain, 0.f, kBrightest); };
  Rgb c{exposed(radiance.x), exposed(radiance.y), exposed(radiance.z)};
  if (tone.curve == ToneCurve::reinhard) c = c * (1 / (1 + 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z));
  if (tone.curve == ToneCurve::filmic) c = {filmic(c.x), filmic(c.y), filmic(c.z)};
  return {unit(c.x), unit(c.y), unit(c.z)};
}

unsigned char encodedByte(float light) {
  return static_cast<unsigned char>(std::lround(255 * linearToSrgb(unit(light))));
}

}  // namespace shbake
