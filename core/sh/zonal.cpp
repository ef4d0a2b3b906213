// Zonal harmonics: Sloan, Luna and Snyder, "Local, Deformable Precomputed Radiance Transfer", SIGGRAPH 2005 (rotation);
// Ramamoorthi and Hanrahan, "A signal-processing framework for inverse rendering", SIGGRAPH 2001 (convolution).
#include "sh/zonal.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"
#include "sh/quadrature.h"

namespace shbake::sh {
namespace {

using std::numbers::pi;

double kernelFactor(std::span<const double> zonal, int l) {
  return std::sqrt(4 * pi / (2 * l + 1)) * zonal[l];
}

int orderOfZonal(std::span<const double> zonal) {
  const int order = static_cast<int>(zonal.size());
  requireOrder(order, 1, kMaxBasisOrder, "a zonal function");
  return order;
}

}  // namespace

void rotateZonal(std::span<const double> zonal, const Vec3d& direction, std::span<double> out) {
  const int order = orderOfZonal(zonal);
  evaluate(order, direction, out);
  convolve(zonal, out, out);
}

void convolve(std::span<const double> zonal, std::span<const double> coefficients, std::span<double> out) {
  const int order = orderOfZonal(zonal);
  requireCoefficients(order, coefficients.size(), "the input of convolve()");
  requireCoefficients(order, out.size(), "the output of convolve()");
  for (int l = 0; l < order; ++l) {
    const double factor = kernelFactor(zonal, l);
    for (int i = index(l, -l); i <= index(l, l); ++i) out[i] = factor * coefficients[i];
  }
}

std::vector<double> projectZonal(int order, const std::function<double(double cosine)>& f,
                                 std::span<const double> breaks, int nodes) {
  requireOrder(order, 1, kMaxBasisOrder, "a zonal projection");
  const IntervalRule rule = gaussLegendre(nodes);
  std::vector<double> zonal(order), y(coefficientCount(order));
  double low = -1;
  for (std::size_t piece = 0; piece <= breaks.size(); ++piece) {
    const double high = piece < breaks.size() ? breaks[piece] : 1;
    if (!(low < high && high <= 1)) {
      throw usageError("the breaks of a zonal profile are not rising between -1 and 1", "sort them and drop doubles");
    }
    for (int k = 0; k < nodes; ++k) {
      const double u = low + (high - low) * (1 + rule.nodes[k]) / 2;
      const double weight = rule.weights[k] * (high - low) / 2 * 2 * pi * f(u);
      evaluate(order, Vec3d{std::sqrt((1 - u) * (1 + u)), 0, u}, y);
      for (int l = 0; l < order; ++l) zonal[l] += weight * y[index(l, 0)];
    }
    low = high;
  }
  return zonal;
}

std::vector<double> legendreTails(int degree, double angle) {
  if (degree < 0) throw usageError("Legendre integrals of a negative degree asked for", "give a degree of 0 or more");
  if (!(angle >= 0 && angle <= pi))
    throw usageError("an angle outside 0..pi", "give an angle in radians between 0 and pi");
  // The tail of P_l is sin^2 P_l' / (l (l+1)): unlike (P_{l-1} - P_{l+1}) / (2l+1) it keeps its digits for small
  // angles.
  const double t = std::cos(angle), half = std::sin(angle / 2), s = std::sin(angle);
  std::vector<double> tails(degree + 1);
  tails[0] = 2 * half * half;
  double before = 1, value = t, slopeBefore = 0, slope = 1;
  for (int l = 1; l <= degree; ++l) {
    tails[l] = s * s * slope / (l * (l + 1.0));
    const double next = ((2 * l + 1) * t * value - l * before) / (l + 1);
    const double slopeNext = slopeBefore + (2 * l + 1) * value;
    before = value;
    value = next;
    slopeBefore = slope;
    slope = slopeNext;
  }
  return tails;
}

std::vector<double> zonalCap(int order, double halfAngle) {
  requireOrder(order, 1, kMaxBasisOrder, "a zonal cap");
  std::vector<double> zonal = legendreTails(order - 1, halfAngle);
  for (int l = 0; l < order; ++l) zonal[l] *= 2 * pi * std::sqrt((2 * l + 1) / (4 * pi));
  return zonal;
}

}  // namespace shbake::sh
