// How many Gauss-Legendre nodes a smooth function on an interval needs.
#pragma once

#include <functional>

namespace shbake {

/// What interpolation and quadrature in this layer are held to, relative to the largest value of the function.
inline constexpr double kQuadratureError = 1e-13;

/// How fast a function grows off the real line: |f(x + iy)| <= exp(exponent(|y|)) times its largest real value for
/// |y| < reach.
struct Growth {
  std::function<double(double y)> exponent;
  double reach;
};

/// The growth of a trigonometric polynomial: exp(degree |y|) everywhere.
Growth trigonometricGrowth(double degree);

/// The least number of nodes in which a function interpolates to kQuadratureError on an interval of this half length.
int interpolationNodes(const Growth& growth, double halfLength);

/// The least number of Gauss-Legendre nodes that integrate it to kQuadratureError of the interval: half as many.
int gaussNodes(const Growth& growth, double halfLength);

}  // namespace shbake
