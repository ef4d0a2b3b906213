// Error bounds by the ellipse in which a function is analytic: Trefethen, "Approximation Theory and Approximation
// Practice", 2013, theorems 8.2 (interpolation; stated for Chebyshev nodes, Legendre nodes lose a small factor)
// and 19.3 (Gauss quadrature).
#include "light/quadrature_size.h"

#include <algorithm>
#include <cmath>

namespace shbake {
namespace {

/// The bound 4 M r^-n / (1 - 1/r) for n nodes and the best r. M bounds f on the ellipse whose half axes are (r + 1/r) /
/// 2 and (r - 1/r) / 2 half lengths.
double errorBound(const Growth& growth, double halfLength, int n) {
  double least = HUGE_VAL;
  for (double r = 1.1; r < 1e9; r *= 1.25) {
    const double height = halfLength * (r - 1 / r) / 2;
    if (height >= growth.reach) break;
    least = std::min(least, 4 * std::exp(growth.exponent(height) - n * std::log(r)) / (1 - 1 / r));
  }
  return least;
}

}  // namespace

Growth trigonometricGrowth(double degree) {
  return {[degree](double y) { return degree * y; }, HUGE_VAL};
}

int interpolationNodes(const Growth& growth, double halfLength) {
  int n = 1;
  while (errorBound(growth, halfLength, n) > kQuadratureError) ++n;
  return n;
}

int gaussNodes(const Growth& growth, double halfLength) {
  return (interpolationNodes(growth, halfLength) + 1) / 2;
}

}  // namespace shbake
