// How far estimates are from a reference.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chart/sweep/reference.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// Relative transfer errors (docs/accuracy.md): |t - t*| / |t_unshadowed|, as an RMS over points weighted by the area
/// that each stands for.
class TransferJudge {
 public:
  /// Judges estimates of `order` bands of the first `count` points of the sample. All arguments must outlive it.
  TransferJudge(const LightingPoints& points, std::span<const std::uint32_t> sample, const Reference& reference,
                int order, std::size_t count);

  /// The squared error, freed from the reference's noise: it scatters about the true one and may fall below zero where
  /// that is as small as the noise.
  double squaredError(std::span<const float> estimate) const { return product(estimate, estimate); }
  /// The part of the squared error that two independent estimates of one method share: what more rays do not mend.
  double sharedError(std::span<const float> one, std::span<const float> other) const { return product(one, other); }
  /// The standard error of the mean of the reference's two estimates, as an RMS like the errors.
  double referenceNoise() const;

 private:
  double product(std::span<const float> one, std::span<const float> other) const;

  const Reference& reference_;
  std::size_t count_, coefficients_;
  std::vector<double> weights_;  // sum to 1 / |t_unshadowed|^2
};

}  // namespace shbake::chart
