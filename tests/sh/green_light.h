// Green's light of two lobes, max(0, 5 cos t - 4) + max(0, 4 sin t cos(p - 2.5) - 3), in the form his text means: the
// printed bracket leaves the 3 outside. Both lobes are zonal about their own axes and do not overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sh/support.h"
#include "sh/zonal.h"

namespace shbake::sh::testing {

inline const Vec3d kSideLobe{std::cos(2.5), std::sin(2.5), 0};

inline double greenLight(const Vec3d& d) {
  return std::max(0.0, 5 * d.z - 4) + std::max(0.0, 4 * dot(d, kSideLobe) - 3);
}

/// Its coefficients, exact: the profiles are polynomials between their kinks.
inline std::vector<double> greenCoefficients(int order) {
  const int nodes = order / 2 + 2;
  const std::array<double, 1> topKink{0.8}, sideKink{0.75};
  const auto top = projectZonal(
      order, [](double u) { return std::max(0.0, 5 * u - 4); }, topKink, nodes);
  const auto side = projectZonal(
      order, [](double u) { return std::max(0.0, 4 * u - 3); }, sideKink, nodes);
  std::vector<double> sum(coefficientCount(order)), lobe(sum.size());
  rotateZonal(top, {0, 0, 1}, sum);
  rotateZonal(side, kSideLobe, lobe);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += lobe[i];
  return sum;
}

/// The integral of its square: 2 pi times the integrals of (5u - 4)^2 over [0.8, 1] and of (4u - 3)^2 over [0.75, 1].
inline constexpr double kGreenEnergy = 2 * kPi * (1.0 / 15 + 1.0 / 12);

/// The relative L2 error of an approximation of its first coefficients.
inline double greenError(const std::vector<double>& approximation) {
  const auto exact = greenCoefficients(static_cast<int>(std::lround(std::sqrt(double(approximation.size())))));
  double square = kGreenEnergy;
  for (std::size_t i = 0; i < exact.size(); ++i) square += approximation[i] * (approximation[i] - 2 * exact[i]);
  return std::sqrt(square / kGreenEnergy);
}

}  // namespace shbake::sh::testing
