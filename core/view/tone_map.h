// From radiance to what a display shows.
#pragma once

#include "base/vec3.h"

namespace shbake {

/// How radiance is fitted into the range of a display.
enum class ToneCurve {
  clip,      ///< as it is up to white
  reinhard,  ///< L / (1 + L) of the luminance: Reinhard, Stark, Shirley, Ferwerda, "Photographic Tone Reproduction for
             ///< Digital Images", SIGGRAPH 2002, equation 3
  filmic,    ///< an S-curve a channel: Narkowicz, "ACES Filmic Tone Mapping Curve", 2015
};

struct ToneMap {
  ToneCurve curve = ToneCurve::clip;
  double exposure = 0;  ///< radiance is multiplied by 2^exposure first
};

/// The linear light, 0..1 a channel, with which a display shows `radiance`; negative channels count as 0.
Rgb displayLight(const Rgb& radiance, const ToneMap& tone);

/// 0..1 linear light as 8-bit sRGB, rounded to the nearest; values outside are cut off.
unsigned char encodedByte(float light);

}  // namespace shbake
