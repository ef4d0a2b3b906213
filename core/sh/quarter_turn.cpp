// R_x(+-90) from Wigner's d at 90 degrees: Trapani and Navaza, "Calculation of spherical harmonics and Wigner d
// functions by FFT", Acta Cryst. A 2006, whose recurrence runs downwards in the second index and is stable at all
// degrees.
#include "sh/quarter_turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <type_traits>
#include <utility>

#include "base/wide.h"
#include "sh/basis.h"
#include "sh/check.h"

namespace shbake::sh {
namespace {

/// D_{ab} for 0 <= a, b <= l, row-major with rows of length l + 1: Trapani and Navaza's Delta of degree l.
class DeltaBand {
 public:
  DeltaBand() : edge_{1}, values_{1} {}

  /// From degree l - 1 to degree l, maths.md (18).
  void advance() {
    const double l = ++l_;
    std::vector<double> edge(l_ + 1);  // D_{a,l}
    edge[0] = -std::sqrt((2 * l - 1) / (2 * l)) * edge_[0];
    for (int a = 1; a <= l_; ++a) edge[a] = std::sqrt(l / 2 * (2 * l - 1) / ((l + a) * (l + a - 1))) * edge_[a - 1];
    edge_ = std::move(edge);
    values_.assign(std::size_t(l_ + 1) * (l_ + 1), 0.0);
    for (int a = 0; a <= l_; ++a) {
      double above = 0, value = edge_[a];
      at(a, l_) = value;
      for (int b = l_ - 1; b >= 0; --b) {
        const double scale = 1 / std::sqrt((l - b) * (l + b + 1));
        const double next = scale * (2 * a * value - std::sqrt((l - b - 1) * (l + b + 2)) * above);
        above = value;
        at(a, b) = value = next;
      }
    }
  }

  int degree() const { return l_; }
  double operator()(int a, int b) const { return values_[std::size_t(a) * (l_ + 1) + b]; }

 private:
  double& at(int a, int b) { return values_[std::size_t(a) * (l_ + 1) + b]; }

  int l_ = 0;
  std::vector<double> edge_;
  std::vector<double> values_;
};

/// Entry (m, n) of the real rotation by +90 degrees about y: it joins cosines with cosines where l + m + n is even, and
/// sines with sines where it is odd.
double yTurn(const DeltaBand& delta, int m, int n) {
  const int a = std::abs(m), b = std::abs(n);
  const bool sines = m < 0;
  if (sines != (n < 0) || ((delta.degree() + a + b) % 2 != 0) != sines) return 0;
  if (a == 0 && b == 0) return delta(0, 0);
  return (a == 0 || b == 0 ? std::numbers::sqrt2 : 2.0) * delta(a, b);
}

/// One coefficient turned by 90 degrees about z: coefficient m becomes `sign` times coefficient `m`.
struct SignedOrder {
  int m;
  double sign;
};

SignedOrder quarterAboutZ(int m, int direction) {
  const int a = std::abs(m), quarter = ((direction * a) % 4 + 4) % 4;
  switch (quarter) {
    case 0:
      return {m, 1};
    case 2:
      return {m, -1};
    default: {
      const double sine = quarter == 1 ? 1 : -1;
      return {-m, m > 0 ? sine : -sine};
    }
  }
}

/// The columns of one row that symmetry leaves: |n| = first, first + 2, ... up to l, all with one sign.
struct RowPattern {
  int first, sign;

  constexpr int count(int l) const { return first > l ? 0 : (l - first) / 2 + 1; }
  constexpr int column(int l, int k) const { return l + sign * (first + 2 * k); }
};

/// Seen before the turns about z, which swap sine and cosine of odd orders, a row belongs to the cosines or to the
/// sines.
constexpr RowPattern rowPattern(int l, int m) {
  const int a = m < 0 ? -m : m;
  const bool cosines = (m >= 0) == (a % 2 == 0);
  const bool even = ((l + a) % 2 == 0) == cosines;
  if (cosines) return even ? RowPattern{0, 1} : RowPattern{1, -1};
  return even ? RowPattern{2, -1} : RowPattern{1, 1};
}

/// Where row m begins among the entries of band l.
constexpr int rowStart(int l, int m) {
  int start = 0;
  for (int row = -l; row < m; ++row) start += rowPattern(l, row).count(l);
  return start;
}

/// A degree that the compiler knows, so that it unrolls the loops of a band. The low bands are those of every bake.
template <int l>
using Degree = std::integral_constant<int, l>;

// T is double, or Four of four functions. All of it is inlined, so that it is compiled for wide vector units where its
// caller is.
#define SHBAKE_INLINE [[gnu::always_inline]] inline

template <int l, int m, class T, int... k>
SHBAKE_INLINE T fixedRow(const double* values, const T* in, std::integer_sequence<int, k...>) {
  return (T(0) + ... + (values[rowStart(l, m) + k] * in[rowPattern(l, m).column(l, k)]));
}

template <int l, class T, int... row>
SHBAKE_INLINE void fixedRows(const double* values, const T* in, T* out, std::integer_sequence<int, row...>) {
  ((out[row] = fixedRow<l, row - l>(values, in, std::make_integer_sequence<int, rowPattern(l, row - l).count(l)>())),
   ...);
}

/// out = X in for one band, X given by the entries that symmetry leaves.
template <int l, class T>
SHBAKE_INLINE void multiply(Degree<l>, const double* values, const T* in, T* out) {
  fixedRows<l>(values, in, out, std::make_integer_sequence<int, 2 * l + 1>());
}

template <class T>
SHBAKE_INLINE void multiply(int l, const double* values, const T* in, T* out) {
  for (int m = -l; m <= l; ++m) {
    const RowPattern pattern = rowPattern(l, m);
    const int count = pattern.count(l);
    T sum = 0;
    for (int k = 0; k < count; ++k) sum = sum + values[k] * in[pattern.column(l, k)];
    values += count;
    out[m + l] = sum;
  }
}

/// R_z(last) R_x(-90) R_z(middle) R_x(90) R_z(first) on one band.
template <class T>
struct BandZyz {
  ZRotationOf<T> last, middle, first;

  /// `l` is an int or a Degree.
  template <class L>
  SHBAKE_INLINE void apply(L l, const double* forward, const double* backward, const T* in, T* out) const {
    std::array<T, 2 * kMaxTurnOrder - 1> a, b;
    std::copy_n(in, 2 * l + 1, a.data());
    first.apply(l, a.data());
    multiply(l, forward, a.data(), b.data());
    middle.apply(l, b.data());
    multiply(l, backward, b.data(), a.data());
    last.apply(l, a.data());
    std::copy_n(a.data(), 2 * l + 1, out);
  }
};

}  // namespace

QuarterTurn::QuarterTurn(int order) : order_(order) {
  requireOrder(order, 1, kMaxTurnOrder, "a rotation");
  DeltaBand delta;
  for (int l = 0; l < order; ++l) {
    if (l > 0) delta.advance();
    // R_x(90) = R_z(-90) R_y(90) R_z(90): follow each column through the signed permutations on both sides.
    const int size = 2 * l + 1;
    std::vector<double> dense(coefficientCount(size));
    for (int n = -l; n <= l; ++n) {
      const SignedOrder in = quarterAboutZ(n, 1);
      for (int m = -l; m <= l; ++m) {
        const SignedOrder out = quarterAboutZ(m, -1);
        dense[(out.m + l) * size + n + l] = in.sign * out.sign * yTurn(delta, m, in.m);
      }
    }
    starts_.push_back(forward_.size());
    for (int row = 0; row < size; ++row) {
      const RowPattern pattern = rowPattern(l, row - l);
      for (int k = 0; k < pattern.count(l); ++k) {
        const int column = pattern.column(l, k);
        forward_.push_back(dense[row * size + column]);
        backward_.push_back(dense[column * size + row]);
      }
    }
  }
}

void QuarterTurn::apply(int l, const double* in, double* out) const {
  multiply(l, forward_.data() + starts_[l], in, out);
}

void QuarterTurn::applyInverse(int l, const double* in, double* out) const {
  multiply(l, backward_.data() + starts_[l], in, out);
}

/// What a rotation reads.
struct QuarterTurn::Bands {
  int order;
  const double *forward, *backward;
  const std::size_t* starts;

  template <class T>
  SHBAKE_INLINE void rotate(const BandZyz<T>& turns, const T* in, T* out) const {
    const auto band = [&](auto l) __attribute__((always_inline)) {
      const int start = index(l, -l);
      turns.apply(l, forward + starts[l], backward + starts[l], in + start, out + start);
    };
    out[0] = in[0];
    if (order > 1) band(Degree<1>());
    if (order > 2) band(Degree<2>());
    if (order > 3) band(Degree<3>());
    if (order > 4) band(Degree<4>());
    for (int l = 5; l < order; ++l) band(l);
  }

  SHBAKE_WIDE static void rotateFour(const Bands& bands, const TurnOf<Four>& last, const TurnOf<Four>& middle,
                                     const TurnOf<Four>& first, const Four* in, Four* out) {
    const int order = bands.order;
    bands.rotate(BandZyz<Four>{{order, last}, {order, middle}, {order, first}}, in, out);
  }
};

QuarterTurn::Bands QuarterTurn::bands() const {
  return {order_, forward_.data(), backward_.data(), starts_.data()};
}

void QuarterTurn::rotateZyz(Turn last, Turn middle, Turn first, const double* in, double* out) const {
  bands().rotate(BandZyz<double>{ZRotation(order_, last), ZRotation(order_, middle), ZRotation(order_, first)}, in,
                 out);
}

void QuarterTurn::rotateZyz(const TurnOf<Four>& last, const TurnOf<Four>& middle, const TurnOf<Four>& first,
                            const Four* in, Four* out) const {
  Bands::rotateFour(bands(), last, middle, first, in, out);
}

}  // namespace shbake::sh
