// 3x3 matrices, for rotations.
#pragma once

#include <array>

#include "base/vec3.h"

namespace shbake::sh {

/// A matrix by rows; m * v turns the column vector v.
struct Matrix3d {
  std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  constexpr double operator()(int row, int column) const { return m[row][column]; }
  constexpr double& operator()(int row, int column) { return m[row][column]; }
  friend constexpr bool operator==(const Matrix3d&, const Matrix3d&) = default;
};

Vec3d operator*(const Matrix3d& a, const Vec3d& v);
Matrix3d operator*(const Matrix3d& a, const Matrix3d& b);
Matrix3d transposed(const Matrix3d& a);

/// Rotations by `angle` radians, counter-clockwise seen from the tip of the axis.
Matrix3d rotationAboutX(double angle);
Matrix3d rotationAboutY(double angle);
Matrix3d rotationAboutZ(double angle);
/// The same about any axis, which need not have unit length. Throws a usage error when it is zero or not finite.
Matrix3d rotationAbout(const Vec3d& axis, double angle);

/// The rotation nearest to `a` (the orthogonal factor of its polar decomposition), orthonormal to rounding. Throws a
/// usage error when `a` mirrors, or when a^T a differs from the identity by more than 1e-3 in some entry: a matrix read
/// from a file in single or low precision passes, one that scales or shears does not.
Matrix3d nearestRotation(const Matrix3d& a);

}  // namespace shbake::sh
