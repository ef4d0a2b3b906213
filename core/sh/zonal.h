// Functions that depend on the angle to an axis only: n coefficients instead of n^2.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake::sh {

/// A zonal function is given by z_l, its coefficients of y_l0 about the z axis; order of them, l = 0..order-1.

/// Writes the zonal function turned to the axis `direction` (unit length): out[index(l, m)] =
/// sqrt(4 pi / (2l+1)) z_l y_lm(direction), maths.md (11).
void rotateZonal(std::span<const double> zonal, const Vec3d& direction, std::span<double> out);

/// The convolution of a function with a zonal kernel: c_lm sqrt(4 pi / (2l+1)) z_l, maths.md (12). `coefficients` and
/// `out` hold zonal.size()^2 values and may be the same array.
void convolve(std::span<const double> zonal, std::span<const double> coefficients, std::span<double> out);

/// Zonal coefficients of the profile f(cos t), t the angle to the axis, by Gauss-Legendre quadrature on the pieces
/// between -1, the `breaks` (rising, inside (-1, 1)) and 1. A profile that is a polynomial of degree d on each piece is
/// exact from nodes >= (order + d) / 2 on. Throws a usage error for order < 1, nodes < 1 or breaks out of place.
std::vector<double> projectZonal(int order, const std::function<double(double cosine)>& f,
                                 std::span<const double> breaks, int nodes);

/// Zonal coefficients of the function that is 1 within `halfAngle` of the axis and 0 elsewhere, in closed form and
/// without cancellation for small caps (maths.md (13)). `halfAngle` is 0..pi radians; throws a usage error otherwise.
std::vector<double> zonalCap(int order, double halfAngle);

/// The integrals of the Legendre polynomials P_0..P_degree from cos(angle) to 1; angle is 0..pi.
std::vector<double> legendreTails(int degree, double angle);

}  // namespace shbake::sh
