// Error bounds by the ellipse in which a function is analytic: Trefethen, "Approximation Theory and Approximation
// Practice", 2013, theorems 8.2 (interpolation; stated for Chebyshev nodes, Legendre nodes lose a small factor)
// and 19.3 (Gauss quadrature).
#include "light/quadrature_size.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace shbake {
namespace {

/// An ellipse with the half axes (r + 1/r) / 2 and (r - 1/r) / 2 half lengths.
struct Ellipse {
  double logRadius;  ///< log r
  double logBound;   ///< log of M / (1 - 1/r), where M bounds the function on it
};

std::vector<Ellipse> ellipsesOf(const Growth& growth, double halfLength) {
  std::vector<Ellipse> ellipses;
  for (double r = 1.1; r < 1e9; r *= 1.25) {
    const double height = halfLength * (r - 1 / r) / 2;
    if (height >= growth.reach) break;
    ellipses.push_back({std::log(r), growth.exponent(height) - std::log1p(-1 / r)});
  }
  return ellipses;
}

/// The logarithm of the bound 4 M r^-n / (1 - 1/r) for n nodes and the best r.
double logErrorBound(const std::vector<Ellipse>& ellipses, int n) {
  double least = HUGE_VAL;
  for (const Ellipse& e : ellipses) least = std::min(least, e.logBound - n * e.logRadius);
  return std::log(4) + least;
}

}  // namespace

Growth trigonometricGrowth(double degree) {
  return {[degree](double y) { return degree * y; }, HUGE_VAL};
}

int interpolationNodes(const Growth& growth, double halfLength) {
  const std::vector<Ellipse> ellipses = ellipsesOf(growth, halfLength);
  const double enough = std::log(kQuadratureError);
  int n = 1;
  while (logErrorBound(ellipses, n) > enough) ++n;
  return n;
}

int gaussNodes(const Growth& growth, double halfLength) {
  return (interpolationNodes(growth, halfLength) + 1) / 2;
}

}  // namespace shbake
