// Means of samples in pairs: maths.md (28).
#include "bake/sampled_mean.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shbake {
namespace {

double rootOfPositive(double square) {
  return std::sqrt(std::max(0.0, square));
}

}  // namespace

SampledMean stratifiedMean(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  // That of each stratum's mean, which is one of two, over the number of strata.
  double variance = 0;
  for (std::size_t s = 0; s + 1 < values.size(); s += 2) variance += std::pow(values[s] - values[s + 1], 2);
  return {sum / count, std::sqrt(variance) / count};
}

RmsError rootOf(const SampledMean& square) {
  return {rootOfPositive(square.mean), rootOfPositive(square.low()), rootOfPositive(square.high())};
}

SurfaceError surfaceErrorOf(std::span<const double> squares, const std::function<Vec3d(std::size_t)>& positionOf) {
  const RmsError whole = rootOf(stratifiedMean(squares));
  const auto worst = std::max_element(squares.begin(), squares.end());
  SurfaceError error;
  error.samples = squares.size();
  error.rms = whole.rms;
  error.low = whole.low;
  error.high = whole.high;
  error.worst = rootOfPositive(*worst);
  error.worstPosition = positionOf(static_cast<std::size_t>(worst - squares.begin()));
  return error;
}

}  // namespace shbake
