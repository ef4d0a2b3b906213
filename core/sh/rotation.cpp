// Rotation matrices of real spherical harmonics by recursion over the degree: Ivanic and Ruedenberg, "Rotation Matrices
// for Real Spherical Harmonics. Direct Determination by Recursion", J. Phys. Chem. 1996, with the corrections of 1998.
// Where Green's copy (GDC 2003, appendix) departs from what is orthogonal, maths.md lists it: V for m < 0, and w for
// |n| = l.
#include "sh/rotation.h"

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"

namespace shbake::sh {
namespace {

/// The matrices of two successive bands: builds entry (m, n) of degree l from degree l - 1 and degree 1.
class BandRecursion {
 public:
  /// `one` and `before` are the matrices of degrees 1 and l - 1 by rows.
  BandRecursion(int l, const double* one, const double* before) : l_(l), one_(one), before_(before) {}

  /// maths.md (19): M = u U + v V + w W. A factor that is zero stands before a term outside the band.
  double entry(int m, int n) const {
    const int a = std::abs(m);
    const double scale = 1 / (std::abs(n) < l_ ? double(l_ + n) * (l_ - n) : 2.0 * l_ * (2 * l_ - 1));
    double sum = 0;
    if (a < l_) sum += std::sqrt((l_ + m) * (l_ - m) * scale) * p(0, m, n);
    const double v = std::sqrt((m == 0 ? 2.0 : 1.0) * (l_ + a - 1) * (l_ + a) * scale) / 2 * (m == 0 ? -1 : 1);
    sum += v * bigV(m, n);
    if (m != 0 && a < l_ - 1) sum -= std::sqrt(double(l_ - a - 1) * (l_ - a) * scale) / 2 * bigW(m, n);
    return sum;
  }

 private:
  double one(int i, int j) const { return one_[(i + 1) * 3 + j + 1]; }
  double before(int a, int b) const { return before_[(a + l_ - 1) * (2 * l_ - 1) + b + l_ - 1]; }

  double p(int i, int a, int b) const {
    if (b == l_) return one(i, 1) * before(a, l_ - 1) - one(i, -1) * before(a, 1 - l_);
    if (b == -l_) return one(i, 1) * before(a, 1 - l_) + one(i, -1) * before(a, l_ - 1);
    return one(i, 0) * before(a, b);
  }

  double bigV(int m, int n) const {
    if (m == 0) return p(1, 1, n) + p(-1, -1, n);
    if (m == 1) return std::sqrt(2.0) * p(1, 0, n);
    if (m == -1) return std::sqrt(2.0) * p(-1, 0, n);
    return m > 0 ? p(1, m - 1, n) - p(-1, 1 - m, n) : p(1, m + 1, n) + p(-1, -m - 1, n);
  }

  double bigW(int m, int n) const {
    return m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, 1 - m, n);
  }

  int l_;
  const double* one_;
  const double* before_;
};

template <class T>
void applyBands(const std::vector<double>& entries, int order, std::span<const T> in, std::span<T> out) {
  requireCoefficients(order, in.size(), "the input of a rotation");
  requireCoefficients(order, out.size(), "the output of a rotation");
  if (in.data() == out.data()) throw usageError("a rotation was asked to overwrite its input", "give another output");
  const double* entry = entries.data();
  for (int l = 0; l < order; ++l) {
    const int start = index(l, -l), size = 2 * l + 1;
    for (int row = 0; row < size; ++row) {
      double sum = 0;
      for (int column = 0; column < size; ++column) sum += *entry++ * in[start + column];
      out[start + row] = static_cast<T>(sum);
    }
  }
}

}  // namespace

Rotation::Rotation(int order) : order_(order) {
  requireOrder(order, 1, kMaxBasisOrder, "a rotation");
  entries_.resize(place(order, -order, -order));
}

Rotation::Rotation(int order, const Matrix3d& matrix) : Rotation(order) {
  const Matrix3d r = nearestRotation(matrix);
  entries_[0] = 1;
  if (order == 1) return;
  // Band 1 is the matrix itself in the order y, z, x.
  constexpr int axis[] = {1, 2, 0};
  for (int m = -1; m <= 1; ++m) {
    for (int n = -1; n <= 1; ++n) entries_[place(1, m, n)] = r(axis[m + 1], axis[n + 1]);
  }
  for (int l = 2; l < order; ++l) {
    const BandRecursion band(l, &entries_[place(1, -1, -1)], &entries_[place(l - 1, 1 - l, 1 - l)]);
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) entries_[place(l, m, n)] = band.entry(m, n);
    }
  }
}

void Rotation::apply(std::span<const double> in, std::span<double> out) const {
  applyBands(entries_, order_, in, out);
}

void Rotation::apply(std::span<const float> in, std::span<float> out) const {
  applyBands(entries_, order_, in, out);
}

Rotation Rotation::inverse() const {
  Rotation result(order_);
  for (int l = 0; l < order_; ++l) {
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) result.entries_[place(l, m, n)] = entry(l, n, m);
    }
  }
  return result;
}

Rotation operator*(const Rotation& second, const Rotation& first) {
  if (second.order_ != first.order_) {
    throw usageError("rotations of orders " + std::to_string(second.order_) + " and " + std::to_string(first.order_) +
                         " cannot be composed",
                     "build both for one order");
  }
  Rotation result(first.order_);
  for (int l = 0; l < result.order_; ++l) {
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) {
        double sum = 0;
        for (int k = -l; k <= l; ++k) sum += second.entry(l, m, k) * first.entry(l, k, n);
        result.entries_[Rotation::place(l, m, n)] = sum;
      }
    }
  }
  return result;
}

}  // namespace shbake::sh
