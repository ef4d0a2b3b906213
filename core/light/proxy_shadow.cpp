// Proxy shadows, proposed by Alex Evans in Green, "Spherical Harmonic Lighting: The Gritty Details", GDC 2003: the
// light is turned so that the blocked disc lies about +z, multiplied by its complement, and turned back. About z the
// product keeps each order m by itself, so its matrix is one small block an m.
#include "light/proxy_shadow.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "sh/quadrature.h"
#include "sh/zyz_rotation.h"

namespace shbake {
namespace {

using std::numbers::pi;

/// The rotation by which z becomes `direction`.
sh::Matrix3d fromZ(const Vec3d& direction) {
  const double theta = std::atan2(std::hypot(direction.x, direction.y), direction.z);
  return sh::rotationAboutZ(std::atan2(direction.y, direction.x)) * sh::rotationAboutY(theta);
}

/// Multiplies by the function that is 1 for z below cos(angle) and 0 above. The product of two functions of one order m
/// is a polynomial in z, so Gauss-Legendre on [-1, cos angle] integrates it exactly.
Light maskedBelow(const Light& light, double angle, int outputOrder) {
  Light result(outputOrder);
  const sh::IntervalRule rule = sh::gaussLegendre((light.order + outputOrder) / 2 + 1);
  std::vector<double> y(light.coefficients.size());
  // 1 + cos angle without cancellation for discs near 180 degrees.
  const double range = 2 * std::cos(angle / 2) * std::cos(angle / 2);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double z = -1 + range * (1 + rule.nodes[k]) / 2, weight = rule.weights[k] * range / 2;
    // At azimuth 0, y_lm holds q_l|m| for m >= 0; the integral of cos^2 or sin^2 over the circle is pi, of 1 is 2 pi.
    sh::evaluate(light.order, Vec3d{std::sqrt((1 - z) * (1 + z)), 0, z}, y);
    for (int m = -outputOrder + 1; m < outputOrder; ++m) {
      const int am = std::abs(m);
      Vec3d value;
      for (int l = am; l < light.order; ++l) value += y[sh::index(l, am)] * light.coefficients[sh::index(l, m)];
      value *= weight * (m == 0 ? 2 * pi : pi);
      for (int l = am; l < outputOrder; ++l) result.coefficients[sh::index(l, m)] += y[sh::index(l, am)] * value;
    }
  }
  return result;
}

}  // namespace

Light withProxyShadow(const Light& light, const Vec3d& direction, double halfAngle, int outputOrder) {
  if (!(halfAngle >= 0 && halfAngle <= 180)) {
    throw usageError("the half angle of a shadow is out of range", "give degrees from 0 to 180");
  }
  if (!isFinite(direction) || length(direction) == 0) {
    throw usageError("the direction of a shadow is zero or not finite", "give a vector such as 0,0,1");
  }
  if (outputOrder > light.order) {
    throw usageError("the order of a shadowed light is above that of the light", "lower it");
  }
  const sh::Matrix3d toDirection = fromZ(direction);
  const Light turned = rotated(light, sh::transposed(toDirection));
  return rotated(maskedBelow(turned, halfAngle * pi / 180, outputOrder), toDirection);
}

}  // namespace shbake
