// Projection onto spherical harmonics by quadrature and from samples; reconstruction: Green, "Spherical Harmonic
// Lighting: The Gritty Details", GDC 2003. Coefficients are indexed 0..n^2-1, where the printed sums run to n^2.
#include "sh/projection.h"

#include <algorithm>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"
#include "sh/quadrature.h"

namespace shbake::sh {
namespace {

template <class T, class F>
std::vector<T> projectAny(int order, const F& f, int functionDegree) {
  requireOrder(order, 1, kMaxBasisOrder, "a projection");
  if (functionDegree < 0) throw usageError("a function of negative degree cannot be projected", "give 0 or more");
  std::vector<T> coefficients(coefficientCount(order));
  std::vector<double> y(coefficients.size());
  SphereRule(order - 1 + functionDegree).forEach([&](const Vec3d& d, double weight) {
    const T value = f(d) * weight;
    evaluate(order, d, y);
    for (std::size_t i = 0; i < y.size(); ++i) coefficients[i] += value * y[i];
  });
  return coefficients;
}

}  // namespace

std::vector<double> project(int order, const SphereFunction& f, int functionDegree) {
  return projectAny<double>(order, f, functionDegree);
}

std::vector<Vec3d> projectRgb(int order, const SphereRgbFunction& f, int functionDegree) {
  return projectAny<Vec3d>(order, f, functionDegree);
}

void accumulateSample(int order, const Vec3d& direction, double weight, std::span<double> scratch,
                      std::span<double> out) {
  requireCoefficients(order, out.size(), "the output of accumulateSample()");
  evaluate(order, direction, scratch);
  for (int i = 0; i < coefficientCount(order); ++i) out[i] += weight * scratch[i];
}

std::vector<double> projectSamples(int order, std::span<const Vec3d> directions, std::span<const double> weights) {
  requireOrder(order, 1, kMaxBasisOrder, "a projection");
  if (directions.size() != weights.size()) {
    throw usageError("there are " + std::to_string(directions.size()) + " directions but " +
                         std::to_string(weights.size()) + " weights",
                     "give one weight a direction");
  }
  std::vector<double> coefficients(coefficientCount(order)), y(coefficients.size());
  for (std::size_t k = 0; k < directions.size(); ++k)
    accumulateSample(order, directions[k], weights[k], y, coefficients);
  return coefficients;
}

double reconstruct(int order, std::span<const double> coefficients, const Vec3d& direction) {
  requireCoefficients(order, coefficients.size(), "the input of reconstruct()");
  std::vector<double> y(coefficientCount(order));
  evaluate(order, direction, y);
  return productIntegral(coefficients, y);
}

double productIntegral(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<double> bandEnergy(int order, std::span<const double> coefficients) {
  requireCoefficients(order, coefficients.size(), "the input of bandEnergy()");
  std::vector<double> energy(order);
  for (int l = 0; l < order; ++l) {
    const auto band = coefficients.subspan(index(l, -l), 2 * l + 1);
    energy[l] = productIntegral(band, band);
  }
  return energy;
}

}  // namespace shbake::sh
