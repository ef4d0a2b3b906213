// Samples of the surface that a fit has not seen, and what they say about changing vertex values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/sampled_mean.h"
#include "bake/surface_fit_samples.h"
#include "bake/surface_places.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// How much of a change is taken, for each region of the surface: a stretch of the Morton curve, on which points are
/// numbered.
struct RegionalShares {
  std::vector<std::uint32_t> begins;  ///< the first point of each region, rising from 0
  std::vector<double> shares;         ///< of each region, 0..1

  double ofPoint(std::uint32_t p) const;
  bool takesAny() const;
};

/// Places with two independent estimates of their true transfer: maths.md (27), (31).
class HeldOutSamples {
 public:
  /// `places` drawn by area, two a stratum; `traced` has two sets of them. `points` must outlive the object.
  HeldOutSamples(const LightingPoints& points, std::vector<SurfacePlace> places, PlaceTransfers traced,
                 std::size_t stride);

  /// The square of the relative error of interpolated `coefficients`, a row for each point, free of the rays' noise.
  SampledMean squaredError(std::span<const float> coefficients) const;

  /// The variance of one of the two sets, relative, as a mean over the samples.
  double noise() const;

  /// What interpolation adds to that square at each place, two of each stratum: the square less what the stated errors
  /// of the corners explain of it, which is free of what scatters because some places are noisier than others.
  std::vector<double> missedSquares(std::span<const float> coefficients, const std::vector<float>& statedErrors) const;

  /// How much to take of the change from one set of coefficients to another, so that the error is least. Where gain is
  /// not significant over all samples, nothing; regions differ from the whole as far as their own samples can tell.
  RegionalShares chooseShares(std::span<const float> from, std::span<const float> to) const;

  /// All of a change that is expected to help, unless these samples tell that it does not.
  RegionalShares takeUnlessWorse(std::span<const float> from, std::span<const float> to) const;

 private:
  struct Gain;
  std::vector<double> squares(std::span<const float> coefficients) const;
  Gain gainOf(std::size_t sample, std::span<const float> from, std::span<const float> to) const;
  void interpolate(std::size_t sample, std::span<const float> coefficients, std::vector<double>& out) const;

  const LightingPoints* points_;
  std::vector<SurfacePlace> places_;
  PlaceTransfers traced_;
  std::size_t stride_;
  std::vector<std::size_t> order_;     // samples along the Morton curve
  std::vector<std::size_t> cuts_;      // where each region begins in order_, and the end
  std::vector<std::uint32_t> begins_;  // the first point of each region
};

}  // namespace shbake
