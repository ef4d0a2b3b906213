// Rotation of coefficients by Euler angles about z, y, z: independent of the recursion in rotation.h, and faster for
// one vector, because no matrix of the whole rotation is built.
#pragma once

#include <span>

#include "sh/matrix3.h"
#include "sh/quarter_turn.h"

namespace shbake::sh {

/// R_z(alpha) R_y(beta) R_z(gamma) as cosines and sines; 0 <= beta <= pi.
struct EulerZyz {
  Turn alpha, beta, gamma;
};

/// The Euler angles of a rotation matrix. No digits are lost at beta = 0 or pi, where only alpha + gamma or alpha -
/// gamma is determined: the product of the three rotations is `matrix` to 1e-15. Throws what nearestRotation() throws.
EulerZyz eulerZyz(const Matrix3d& matrix);

/// Rotates coefficient vectors of one order. Immutable and free of allocation after construction.
class ZyzRotation {
 public:
  /// Throws a usage error unless 1 <= order <= kMaxTurnOrder.
  explicit ZyzRotation(int order) : turn_(order) {}

  int order() const { return turn_.order(); }

  /// out = R in, (R f)(d) = f(R^-1 d), order()^2 coefficients each; `in` and `out` may be the same array. Throws a
  /// usage error where they are too short.
  void apply(const EulerZyz& angles, std::span<const double> in, std::span<double> out) const;
  void apply(const Matrix3d& matrix, std::span<const double> in, std::span<double> out) const;

 private:
  QuarterTurn turn_;
};

}  // namespace shbake::sh
