// Real spherical harmonics: indices and values.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake::sh {

/// Coefficients of order `order` (bands of degree 0..order-1): order^2.
constexpr int coefficientCount(int order) {
  return order * order;
}

/// The place of degree l >= 0 and order m, -l <= m <= l, in a coefficient vector: l(l+1) + m.
constexpr int index(int l, int m) {
  return l * (l + 1) + m;
}

/// The degree l of coefficient i >= 0: floor(sqrt(i)), exact for every int.
constexpr int degreeOf(int i) {
  // Newton's iteration from above in integers; it stops at the floor.
  long long root = i, next = (root + 1) / 2;
  while (next < root) {
    root = next;
    next = (root + i / root) / 2;
  }
  return static_cast<int>(root);
}

/// The order m of coefficient i >= 0, -degreeOf(i)..degreeOf(i).
constexpr int orderOf(int i) {
  return i - index(degreeOf(i), 0);
}

/// The highest order whose values evaluate() gives: beyond it intermediate values leave the range of double.
inline constexpr int kMaxBasisOrder = 1401;

/// Writes y_lm(direction) to out[index(l, m)] for all degrees below `order`: the real orthonormal basis without
/// Condon-Shortley phase (maths.md (1)). `direction` has unit length; `out` holds order^2 values. No trigonometric
/// function is called and the poles are not special. Relative to sqrt((2l+1)/4pi), the error of degree l stays below
/// what the rounding of the direction itself can cause, (10 + l^2) 2^-52. Throws a usage error when order is not
/// in 1..kMaxBasisOrder or `out` is too short.
void evaluate(int order, const Vec3d& direction, std::span<double> out);
/// The same in single precision: relative to the largest value of the degree, exact to float rounding of the
/// direction and the result.
void evaluate(int order, const Vec3f& direction, std::span<float> out);

namespace oracle {

/// evaluate() by the recurrence at every order, without the polynomials of the low orders: the slow twin they are
/// tested and timed against.
void evaluateByRecurrence(int order, const Vec3d& direction, std::span<double> out);

}  // namespace oracle

}  // namespace shbake::sh
