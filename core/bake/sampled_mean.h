// What samples say about a mean: the estimate, its standard error and its interval. All that is measured at places of
// the surface is drawn in pairs, two from each of equal strata (surface_places.h), and summed up here: maths.md (28).
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "base/vec3.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// A mean over samples and the standard error of it.
struct SampledMean {
  double mean = 0, error = 0;

  /// Its 95 % confidence interval, where the estimate is normal.
  double low() const { return mean - kConfidence * error; }
  double high() const { return mean + kConfidence * error; }

  /// 97.5 % quantile of the normal distribution.
  static constexpr double kConfidence = 1.959963984540054;
};

/// The mean of one or more values of which each two come from a stratum: 0 and 1, 2 and 3, and so on. Half the squared
/// difference of two is an unbiased estimate of the variance in their stratum (Cochran, "Sampling Techniques", 3rd ed.
/// 1977, sections 5.3 and 5.9). The last of an odd number counts for the mean alone.
SampledMean stratifiedMean(std::span<const double> values);

/// An RMS error and its 95 % confidence interval.
struct RmsError {
  double rms = 0, low = 0, high = 0;
};

/// The root of a mean square from which noise was subtracted: what is left of no error at all may be less than none,
/// and counts as none.
RmsError rootOf(const SampledMean& square);

/// The surface error that one or more squared relative errors tell of, two from each stratum. `positionOf(i)` is the
/// place of sample i in file units. `rays` of the result is left 0.
SurfaceError surfaceErrorOf(std::span<const double> squares, const std::function<Vec3d(std::size_t)>& positionOf);

}  // namespace shbake
