// Gauss-Legendre nodes by Newton's method from Tricomi's estimate (Press et al., "Numerical Recipes", section 4.6,
// state the method; the end conditions here are our own).
#include "sh/quadrature.h"

#include <string>

#include "base/error.h"

namespace shbake::sh {
namespace {

struct ValueAndSlope {
  double value, slope;
};

/// P_n(x) and its derivative for n >= 1, |x| < 1.
ValueAndSlope legendre(int n, double x) {
  double before = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (before - x * value) / ((1 - x) * (1 + x))};
}

}  // namespace

IntervalRule gaussLegendre(int n) {
  if (n < 1) throw usageError("a quadrature rule of " + std::to_string(n) + " nodes asked for", "give 1 or more");
  IntervalRule rule;
  rule.nodes.resize(n);
  rule.weights.resize(n);
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    if (2 * i + 1 == n) x = 0;
    // The estimate is good to O(n^-4) and each step squares the error: six leave rounding only.
    for (int step = 0; step < 6; ++step) {
      const auto [value, slope] = legendre(n, x);
      x -= value / slope;
    }
    const double slope = legendre(n, x).slope;
    rule.nodes[n - 1 - i] = x;
    rule.nodes[i] = -x;
    rule.weights[i] = rule.weights[n - 1 - i] = 2 / ((1 - x) * (1 + x) * slope * slope);
  }
  return rule;
}

SphereRule::SphereRule(int degree) : z_(gaussLegendre(degree < 0 ? 0 : degree / 2 + 1)), azimuths_(degree + 1) {}

}  // namespace shbake::sh
