// Quadrature rules that are exact for polynomials: on an interval and on the sphere.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/vec3.h"

namespace shbake::sh {

/// Nodes in rising order and weights of a rule on [-1, 1].
struct IntervalRule {
  std::vector<double> nodes, weights;
};

/// The Gauss-Legendre rule of n nodes, exact for polynomials of degree 2n - 1, to 1e-15 absolute in the nodes. Throws a
/// usage error when n < 1.
IntervalRule gaussLegendre(int n);

/// Gauss-Legendre in z times equal steps in azimuth: integrates every polynomial in x, y, z of the stated degree over
/// the sphere exactly but for rounding, hence every product of spherical harmonics whose degrees add up to it.
class SphereRule {
 public:
  /// About degree^2 / 2 points. Throws a usage error when degree < 0.
  explicit SphereRule(int degree);

  std::size_t size() const { return z_.nodes.size() * static_cast<std::size_t>(azimuths_); }

  /// Calls visit(direction, weight) for each point, in a fixed order; the weights sum to 4 pi.
  template <class Visit>
  void forEach(Visit&& visit) const {
    const double step = 2 * std::numbers::pi / azimuths_;
    for (std::size_t i = 0; i < z_.nodes.size(); ++i) {
      const double z = z_.nodes[i], r = std::sqrt((1 - z) * (1 + z));
      for (int k = 0; k < azimuths_; ++k) {
        // Half a step off the axes, so that no point lies on the edge of a function aligned with them.
        const double phi = (k + 0.5) * step;
        visit(Vec3d{r * std::cos(phi), r * std::sin(phi), z}, z_.weights[i] * step);
      }
    }
  }

  /// The integral of f(direction) over the sphere.
  template <class F>
  double integrate(F&& f) const {
    double sum = 0;
    forEach([&](const Vec3d& d, double weight) { sum += weight * f(d); });
    return sum;
  }

 private:
  IntervalRule z_;
  int azimuths_;
};

}  // namespace shbake::sh
