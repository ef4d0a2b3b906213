// Whether it is worth while to fit vertex values to the surface: what interpolation misses against the noise of rays.
#pragma once

#include <span>

#include "mesh/lighting_points.h"

namespace shbake {

/// What a fit has to gain by and against: as many rays for the points as take its time. Equation (35) of maths.md.
class FitProspect {
 public:
  /// `faceWeights` has the area of each face that counts, else 0; `statedErrors` that of each point. `fitShare`, above
  /// 0: the rays of the fit over those of the bake.
  FitProspect(const LightingPoints& points, std::span<const double> faceWeights, std::span<const float> statedErrors,
              double fitShare);

  /// The mean variance that interpolated transfer has from the noise of the points, relative.
  double noise() const { return noise_; }

  /// What interpolation has to miss, squared, so that a fit repays itself and what is traced before to find that out:
  /// `lookShare` of the rays of the bake, 0 or more.
  double least(double lookShare) const;

  /// Why a fit cannot help, in words; null where it may. `missed` is the squared error that interpolation adds to the
  /// noise, `lookShare` that of least(). As an estimate `missed` may be negative.
  const char* whyUseless(double missed, double lookShare) const;

  /// What a fit usually leaves of what interpolation misses: a of (33), measured.
  static constexpr double kUsuallyLeft = 0.85;
  /// Relative errors up to this are the rounding of coefficients and normals to float.
  static constexpr double kRounding = 1e-6;

 private:
  double noise_ = 0, fitShare_;
};

}  // namespace shbake
