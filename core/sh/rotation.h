// Rotation of coefficients by any rotation matrix.
#pragma once

#include <span>
#include <vector>

#include "sh/matrix3.h"

namespace shbake::sh {

/// The rotation of functions on the sphere, (R f)(d) = f(R^-1 d), as one dense matrix a band: what shone from direction
/// d shines from R d afterwards. Immutable after construction.
class Rotation {
 public:
  /// Bands 0..order-1 of the rotation nearest to `matrix` (see nearestRotation(), whose errors it throws). Orthogonal
  /// to 3e-15 at order 9, 1e-13 at order 33 and 2e-11 at order 65. Throws a usage error unless 1 <= order <=
  /// kMaxBasisOrder.
  Rotation(int order, const Matrix3d& matrix);

  int order() const { return order_; }

  /// Entry (m, n) of the matrix of band l: how much of coefficient (l, n) goes to (l, m).
  double entry(int l, int m, int n) const { return entries_[place(l, m, n)]; }

  /// out = R in; order()^2 coefficients each, in different arrays. Throws a usage error where they do not fit.
  void apply(std::span<const double> in, std::span<double> out) const;
  /// The same for single-precision coefficients, with sums in double.
  void apply(std::span<const float> in, std::span<float> out) const;

  Rotation inverse() const;
  /// The rotation that does `second` after `first`. Throws a usage error when the orders differ.
  friend Rotation operator*(const Rotation& second, const Rotation& first);

 private:
  explicit Rotation(int order);
  static std::size_t place(int l, int m, int n) {
    const auto d = static_cast<std::size_t>(l);
    return d * (4 * d * d - 1) / 3 + (d + m) * (2 * d + 1) + (d + n);
  }

  int order_;
  std::vector<double> entries_;  ///< band after band, each (2l+1) x (2l+1) by rows
};

}  // namespace shbake::sh
