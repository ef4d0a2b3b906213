// Euler angles without loss at the poles, and rotation by them. The sines of Green's identities (GDC 2003) come from
// sqrt(1 - R_zz^2), which loses half the digits near beta = 0; here each is a length that is measured directly.
#include "sh/zyz_rotation.h"

#include <cmath>

#include "sh/check.h"

namespace shbake::sh {
namespace {

/// The direction of (cosine, sine) at unit length; the angle zero where both vanish.
Turn unitTurn(double cosine, double sine) {
  const double length = std::hypot(cosine, sine);
  return length > 0 ? Turn{cosine / length, sine / length} : Turn{};
}

}  // namespace

EulerZyz eulerZyz(const Matrix3d& matrix) {
  const Matrix3d r = nearestRotation(matrix);
  EulerZyz angles;
  angles.alpha = unitTurn(r(0, 2), r(1, 2));
  angles.beta = unitTurn(r(2, 2), std::hypot(r(0, 2), r(1, 2)));
  // R_z(-alpha) R = R_y(beta) R_z(gamma), whose second row is (sin gamma, cos gamma, 0) at any beta: whatever alpha was
  // read from rounding errors near the poles, gamma makes up for it.
  const Turn a = angles.alpha;
  angles.gamma = unitTurn(a.cosine * r(1, 1) - a.sine * r(0, 1), a.cosine * r(1, 0) - a.sine * r(0, 0));
  return angles;
}

void ZyzRotation::apply(const EulerZyz& angles, std::span<const double> in, std::span<double> out) const {
  requireCoefficients(order(), in.size(), "the input of a rotation");
  requireCoefficients(order(), out.size(), "the output of a rotation");
  turn_.rotateZyz(angles.alpha, angles.beta, angles.gamma, in.data(), out.data());
}

void ZyzRotation::apply(const Matrix3d& matrix, std::span<const double> in, std::span<double> out) const {
  apply(eulerZyz(matrix), in, out);
}

}  // namespace shbake::sh
