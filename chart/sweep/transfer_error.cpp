// How far estimates are from a reference.
#include "chart/sweep/transfer_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/stated_error.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake::chart {

TransferJudge::TransferJudge(const LightingPoints& points, std::span<const std::uint32_t> sample,
                             const Reference& reference, int order, std::size_t count)
    : reference_(reference), count_(count), coefficients_(static_cast<std::size_t>(sh::coefficientCount(order))) {
  const std::vector<double> areas = pointAreas(points);
  for (std::size_t i = 0; i < count; ++i) weights_.push_back(areas[sample[i]]);
  const double total = std::accumulate(weights_.begin(), weights_.end(), 0.0) * std::pow(sh::unshadowedNorm(order), 2);
  // Points of degenerate faces alone stand for no area: then all count alike.
  const double alike = static_cast<double>(count) * std::pow(sh::unshadowedNorm(order), 2);
  for (double& w : weights_) w = total > 0 ? w / total : 1 / alike;
}

double TransferJudge::product(std::span<const float> one, std::span<const float> other) const {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const float *a = &reference_.first[i * reference_.stride()], *b = &reference_.second[i * reference_.stride()];
    const float *s = &one[i * coefficients_], *t = &other[i * coefficients_];
    double point = 0;
    for (std::size_t k = 0; k < coefficients_; ++k) {
      // Both pairings of estimate and reference, which halves what chance does.
      point += (static_cast<double>(s[k]) - static_cast<double>(a[k])) *
                   (static_cast<double>(t[k]) - static_cast<double>(b[k])) +
               (static_cast<double>(s[k]) - static_cast<double>(b[k])) *
                   (static_cast<double>(t[k]) - static_cast<double>(a[k]));
    }
    sum += weights_[i] * point / 2;
  }
  return sum;
}

double TransferJudge::referenceNoise() const {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < coefficients_; ++k) {
      const std::size_t j = i * reference_.stride() + k;
      sum += weights_[i] * std::pow(static_cast<double>(reference_.first[j] - reference_.second[j]) / 2, 2);
    }
  }
  return std::sqrt(sum);
}

}  // namespace shbake::chart
