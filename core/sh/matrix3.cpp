// 3x3 matrices. Polar decomposition by Newton's iteration: Higham, "Computing the polar decomposition - with
// applications", SIAM J. Sci. Stat. Comput. 1986.
#include "sh/matrix3.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace shbake::sh {
namespace {

/// Largest entry of a^T a - 1; infinity when `a` holds what is not finite.
double orthogonalityError(const Matrix3d& a) {
  const Matrix3d gram = transposed(a) * a;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double error = std::abs(gram(i, j) - (i == j ? 1 : 0));
      if (!std::isfinite(error)) return INFINITY;
      largest = std::max(largest, error);
    }
  }
  return largest;
}

Vec3d row(const Matrix3d& a, int i) {
  return {a(i, 0), a(i, 1), a(i, 2)};
}

}  // namespace

Vec3d operator*(const Matrix3d& a, const Vec3d& v) {
  return {dot(row(a, 0), v), dot(row(a, 1), v), dot(row(a, 2), v)};
}

Matrix3d operator*(const Matrix3d& a, const Matrix3d& b) {
  Matrix3d c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  }
  return c;
}

Matrix3d transposed(const Matrix3d& a) {
  Matrix3d t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t(i, j) = a(j, i);
  }
  return t;
}

Matrix3d rotationAboutX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{{1, 0, 0}, {0, c, -s}, {0, s, c}}}};
}

Matrix3d rotationAboutY(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}}};
}

Matrix3d rotationAboutZ(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}};
}

Matrix3d rotationAbout(const Vec3d& axis, double angle) {
  const Vec3d u = normalized(axis);
  if (!isFinite(u) || u == Vec3d{}) throw usageError("the axis of a rotation has no direction", "give a non-zero axis");
  // 1 - cos(angle) without cancellation.
  const double c = std::cos(angle), s = std::sin(angle), v = 2 * std::sin(angle / 2) * std::sin(angle / 2);
  return {{{{c + v * u.x * u.x, v * u.x * u.y - s * u.z, v * u.x * u.z + s * u.y},
            {v * u.y * u.x + s * u.z, c + v * u.y * u.y, v * u.y * u.z - s * u.x},
            {v * u.z * u.x - s * u.y, v * u.z * u.y + s * u.x, c + v * u.z * u.z}}}};
}

Matrix3d nearestRotation(const Matrix3d& a) {
  constexpr double kMaxError = 1e-3;
  if (!(orthogonalityError(a) <= kMaxError)) {
    throw usageError("the matrix is not a rotation: its columns are not orthogonal unit vectors",
                     "remove scale, shear and values that are not finite");
  }
  if (dot(row(a, 0), cross(row(a, 1), row(a, 2))) < 0) {
    throw usageError("the matrix mirrors", "give a rotation, whose determinant is +1");
  }
  // The error is squared by each step: 1e-3, 1e-7, 1e-14, rounding.
  Matrix3d r = a;
  for (int step = 0; step < 4; ++step) {
    const Vec3d x = row(r, 0), y = row(r, 1), z = row(r, 2);
    const double scale = 1 / dot(x, cross(y, z));
    const Vec3d inverseTransposed[] = {cross(y, z) * scale, cross(z, x) * scale, cross(x, y) * scale};
    for (int i = 0; i < 3; ++i) {
      const Vec3d mean = (row(r, i) + inverseTransposed[i]) * 0.5;
      r.m[i] = {mean.x, mean.y, mean.z};
    }
  }
  return r;
}

}  // namespace shbake::sh
