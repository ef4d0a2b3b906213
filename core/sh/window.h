// Windows: smoothing against ringing.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace shbake::sh {

/// How the bands are damped (maths.md (23)); n is the order.
enum class Window {
  none,
  hann,       ///< (1 + cos(pi l / n)) / 2
  lanczos,    ///< sin(pi l / n) / (pi l / n)
  gauss,      ///< exp(-l(l+1) / (2 (n/2)^2))
  automatic,  ///< 1 / (1 + lambda l^2 (l+1)^2) with the least lambda >= 0 that leaves no negative value
};

/// "none", "hann", "lanczos", "gauss", "auto": the names of the command line.
std::string_view windowName(Window window);
/// The window of that name; throws a usage error that lists the names.
Window windowFromName(std::string_view name);

/// The factors of degrees 0..order-1 for a window that does not depend on the function; throws a usage error for
/// Window::automatic.
std::vector<double> windowFactors(Window window, int order);

/// The factors of the Laplacian window 1 / (1 + lambda l^2 (l+1)^2); lambda >= 0.
std::vector<double> laplacianFactors(double lambda, int order);

/// The least lambda >= 0 whose Laplacian window leaves the function non-negative, to 1e-9 relative: 0 where it is
/// already. The returned lambda always achieves that; a small negative rest of 1e-12 of the largest value counts as
/// zero. Throws a usage error when no window can, because the mean is negative or is zero while the function is not.
/// Lights of several channels need the largest of their lambdas.
double automaticLambda(int order, std::span<const double> coefficients);

/// Multiplies band l by factors[l], in place; factors.size()^2 coefficients.
void applyFactors(std::span<const double> factors, std::span<double> coefficients);

/// Windows a function in place; returns lambda for Window::automatic and 0 otherwise.
double applyWindow(Window window, int order, std::span<double> coefficients);

}  // namespace shbake::sh
