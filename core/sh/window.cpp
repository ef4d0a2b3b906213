// Windowing of spherical harmonics: Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008 (Laplacian window);
// Sloan, "Deringing Spherical Harmonics", SIGGRAPH Asia 2017 (least smoothing that removes negative values).
#include "sh/window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"
#include "sh/extremes.h"

namespace shbake::sh {
namespace {

constexpr std::array<std::pair<Window, std::string_view>, 5> kNames{{{Window::none, "none"},
                                                                     {Window::hann, "hann"},
                                                                     {Window::lanczos, "lanczos"},
                                                                     {Window::gauss, "gauss"},
                                                                     {Window::automatic, "auto"}}};

double factorOf(Window window, int l, int order) {
  const double x = std::numbers::pi * l / order;
  switch (window) {
    case Window::hann:
      return (1 + std::cos(x)) / 2;
    case Window::lanczos:
      return l == 0 ? 1 : std::sin(x) / x;
    case Window::gauss:
      return std::exp(-l * (l + 1) * 2.0 / (double(order) * order));
    default:
      return 1;
  }
}

}  // namespace

std::string_view windowName(Window window) {
  for (const auto& [value, name] : kNames) {
    if (value == window) return name;
  }
  throw usageError("there is no window of number " + std::to_string(static_cast<int>(window)));
}

Window windowFromName(std::string_view name) {
  std::string all;
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(known);
  }
  throw usageError("there is no window \"" + std::string(name) + "\"", "choose one of " + all);
}

std::vector<double> windowFactors(Window window, int order) {
  requireOrder(order, 1, kMaxBasisOrder, "a window");
  if (window == Window::automatic) {
    throw usageError("the automatic window depends on the function", "use automaticLambda() or applyWindow()");
  }
  std::vector<double> factors(order);
  for (int l = 0; l < order; ++l) factors[l] = factorOf(window, l, order);
  return factors;
}

std::vector<double> laplacianFactors(double lambda, int order) {
  requireOrder(order, 1, kMaxBasisOrder, "a window");
  if (!(lambda >= 0)) throw usageError("a window's lambda of " + std::to_string(lambda), "give 0 or more");
  std::vector<double> factors(order);
  for (int l = 0; l < order; ++l) factors[l] = 1 / (1 + lambda * (double(l) * l) * (double(l + 1) * (l + 1)));
  return factors;
}

double automaticLambda(int order, std::span<const double> coefficients) {
  requireOrder(order, 1, kMaxBasisOrder, "a window");
  requireCoefficients(order, coefficients.size(), "the input of a window");
  const auto all = coefficients.first(coefficientCount(order));
  // No value exceeds the root of the energy times sqrt(n^2 / 4 pi).
  double energy = 0;
  for (const double c : all) energy += c * c;
  const double zero = -1e-12 * std::sqrt(energy * static_cast<double>(all.size()) / (4 * std::numbers::pi));
  std::vector<double> smooth(all.size());
  const auto isNonNegative = [&](double lambda) {
    std::copy(all.begin(), all.end(), smooth.begin());
    applyFactors(laplacianFactors(lambda, order), smooth);
    return staysAbove(order, smooth, zero);
  };
  if (isNonNegative(0)) return 0;
  if (!(all[0] > 0)) {
    throw usageError("no window makes a function non-negative whose mean is not positive", "use another window");
  }

  // In the limit the mean is left, so some power of two suffices.
  double high = 1e-6;
  while (!isNonNegative(high)) high *= 2;
  double low = high > 1e-6 ? high / 2 : 0;
  while (high - low > 1e-9 * high) {
    const double middle = low + (high - low) / 2;
    (isNonNegative(middle) ? high : low) = middle;
  }
  return high;
}

void applyFactors(std::span<const double> factors, std::span<double> coefficients) {
  const int order = static_cast<int>(factors.size());
  requireCoefficients(order, coefficients.size(), "the input of a window");
  for (int l = 0; l < order; ++l) {
    for (int i = index(l, -l); i <= index(l, l); ++i) coefficients[i] *= factors[l];
  }
}

double applyWindow(Window window, int order, std::span<double> coefficients) {
  if (window != Window::automatic) {
    applyFactors(windowFactors(window, order), coefficients);
    return 0;
  }
  const double lambda = automaticLambda(order, coefficients);
  applyFactors(laplacianFactors(lambda, order), coefficients);
  return lambda;
}

}  // namespace shbake::sh
