// What the tests of this layer share: random directions and coefficients, and comparisons.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "base/hash.h"
#include "base/vec3.h"
#include "sh/basis.h"
#include "sh/matrix3.h"

namespace shbake::sh::testing {

inline constexpr double kPi = std::numbers::pi;

/// Direction number `i`, uniform on the sphere.
inline Vec3d randomDirection(std::uint64_t seed, std::uint64_t i) {
  const double z = 2 * hashUnit(seed, 2 * i) - 1, phi = 2 * kPi * hashUnit(seed, 2 * i + 1), r = std::sqrt(1 - z * z);
  return normalized(Vec3d{r * std::cos(phi), r * std::sin(phi), z});
}

/// order^2 coefficients uniform in [-1, 1).
inline std::vector<double> randomCoefficients(int order, std::uint64_t seed) {
  std::vector<double> c(coefficientCount(order));
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = 2 * hashUnit(seed, i) - 1;
  return c;
}

inline std::vector<double> basisAt(int order, const Vec3d& d) {
  std::vector<double> y(coefficientCount(order));
  evaluate(order, d, y);
  return y;
}

/// The largest difference of two entries.
inline double difference(const Matrix3d& a, const Matrix3d& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
  }
  return largest;
}

/// The value of a coefficient vector in a direction, as a plain sum.
inline double valueAt(int order, const std::vector<double>& c, const Vec3d& d) {
  const std::vector<double> y = basisAt(order, d);
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += c[i] * y[i];
  return sum;
}

/// The largest absolute difference of two arrays of one length; infinity where a difference is not finite.
inline double maxDifference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    if (!std::isfinite(difference)) return INFINITY;
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace shbake::sh::testing
