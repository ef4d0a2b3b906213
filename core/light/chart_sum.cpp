// The basis over blocks of points: loops over the points of a block inside those over degrees and orders, so that each
// step is done for several points at once. Order m at a time, since its colours times cos and sin of m phi meet all
// degrees; the degrees by the recurrence of maths.md (3).
#include "light/chart_sum.h"

#include <cmath>
#include <numbers>

#include "light/vector_clones.h"
#include "sh/basis.h"

namespace shbake {
namespace {

using std::numbers::pi;

constexpr std::size_t kLanes = 8;  ///< independent sums: the order of additions is fixed while vectors may be used

/// cos h and sin h / h are series in -h^2, with 1 / (2k)! and 1 / (2k + 1)!. On a chart h = pi r / 2 <= pi / sqrt
/// 2, where so many terms leave 2e-19.
constexpr std::size_t kTerms = 14;

struct Series {
  std::array<double, kTerms> cosine{}, sine{};
};
constexpr Series makeSeries() {
  Series series;
  double term = 1;
  for (std::size_t k = 0; k < kTerms; ++k) {
    series.cosine[k] = term;
    term /= static_cast<double>(2 * k + 1);
    series.sine[k] = term;
    term /= static_cast<double>(2 * k + 2);
  }
  return series;
}
constexpr Series kSeries = makeSeries();

/// At a distance r from the centre the angle is pi r: sin(pi r) / r and cos(pi r) from half the angle.
SHBAKE_VECTOR_CLONES void angularScales(const double* __restrict s, const double* __restrict t, std::size_t size,
                                        double* __restrict ahead, double* __restrict across,
                                        double* __restrict density) {
  for (std::size_t j = 0; j < size; ++j) {
    const double square = -pi * pi / 4 * (s[j] * s[j] + t[j] * t[j]);
    double cosine = kSeries.cosine[kTerms - 1], sine = kSeries.sine[kTerms - 1];
#pragma GCC unroll 16
    for (std::size_t k = kTerms - 1; k-- > 0;) {
      cosine = cosine * square + kSeries.cosine[k];
      sine = sine * square + kSeries.sine[k];
    }
    ahead[j] = 2 * cosine * cosine - 1;
    across[j] = pi * sine * cosine;
    density[j] = pi * across[j];
  }
}

SHBAKE_VECTOR_CLONES void cubeScales(const double* __restrict s, const double* __restrict t, std::size_t size,
                                     double* __restrict ahead, double* __restrict across, double* __restrict density) {
  for (std::size_t j = 0; j < size; ++j) {
    const double inverse = 1 / std::sqrt(1 + s[j] * s[j] + t[j] * t[j]);
    ahead[j] = across[j] = inverse;
    density[j] = inverse * inverse * inverse;
  }
}

/// One component of the directions, from those of the axes.
SHBAKE_VECTOR_CLONES void turn(const double* __restrict s, const double* __restrict t, const double* __restrict ahead,
                               const double* __restrict across, std::size_t size, const Vec3d& axes,
                               double* __restrict out) {
  const double forward = axes.x, right = axes.y, up = axes.z;
  for (std::size_t j = 0; j < size; ++j) out[j] = ahead[j] * forward + across[j] * (s[j] * right + t[j] * up);
}

/// out = factor * colors, a row of `size` for each channel; `out` may be `colors`.
SHBAKE_VECTOR_CLONES void multiply(const double* factor, const double* colors, std::size_t size, double* out) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t j = 0; j < size; ++j) out[c * size + j] = factor[j] * colors[c * size + j];
  }
}

/// (x + iy)^m from the power before.
SHBAKE_VECTOR_CLONES void raise(const double* __restrict x, const double* __restrict y, std::size_t size,
                                double* __restrict cosine, double* __restrict sine) {
  for (std::size_t j = 0; j < size; ++j) {
    const double c = x[j] * cosine[j] - y[j] * sine[j];
    sine[j] = x[j] * sine[j] + y[j] * cosine[j];
    cosine[j] = c;
  }
}

/// The next degree of q_lm, written over the one before the last.
SHBAKE_VECTOR_CLONES void nextDegree(double a, double b, const double* __restrict z, const double* __restrict squares,
                                     std::size_t size, const double* __restrict last, double* __restrict before) {
  for (std::size_t j = 0; j < size; ++j) before[j] = a * (z[j] * last[j] - b * squares[j] * before[j]);
}

/// Adds the sum of value * color of each channel.
SHBAKE_VECTOR_CLONES void addProducts(const double* __restrict values, const double* __restrict colors,
                                      std::size_t size, Vec3d& sum) {
  double totals[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const double* row = colors + c * size;
    double lanes[kLanes] = {};
    for (std::size_t j = 0; j < size; j += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += values[j + lane] * row[j + lane];
    }
    totals[c] = ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
  }
  sum += {totals[0], totals[1], totals[2]};
}

}  // namespace

ChartSum::ChartSum(MapLayout layout, const CubeFace& chart, int order, std::span<Vec3d> sum)
    : angular_(layout == MapLayout::angular), mirrorsX_(chart.right.x != 0), order_(order), chart_(chart), sum_(sum) {
  for (double l = 1; l < order; ++l) {
    for (double m = 0; m < l; ++m) {
      factors_.push_back(std::sqrt((4 * l * l - 1) / (l * l - m * m)));
      factors_.push_back(l > 1 ? std::sqrt(((l - 1) * (l - 1) - m * m) / (4 * (l - 1) * (l - 1) - 1)) : 0);
    }
  }
  double diagonal = 1 / std::sqrt(4 * pi);
  for (double m = 0; m < order; ++m) {
    if (m > 0) diagonal *= std::sqrt((2 * m + 1) / (2 * m)) * (m == 1 ? std::numbers::sqrt2 : 1);
    factors_.push_back(diagonal);
  }
}

void ChartSum::append(double s, double t, const Vec3d& even, const Vec3d& odd) {
  s_[count_] = s;
  t_[count_] = t;
  const std::array<double, 3> e{even.x, even.y, even.z}, o{odd.x, odd.y, odd.z};
  for (std::size_t c = 0; c < 3; ++c) {
    even_[c][count_] = e[c];
    odd_[c][count_] = o[c];
  }
  if (++count_ == kBlock) flush();
}

/// Directions are forward * ahead + (s right + t up) * across.
void ChartSum::findDirections() {
  Values ahead, across, density;
  (angular_ ? angularScales : cubeScales)(s_.data(), t_.data(), kBlock, ahead.data(), across.data(), density.data());
  const Vec3d &f = chart_.forward, &r = chart_.right, &u = chart_.up;
  const auto component = [&](const Vec3d& axes, Values& out) {
    turn(s_.data(), t_.data(), ahead.data(), across.data(), kBlock, axes, out.data());
  };
  component({f.x, r.x, u.x}, x_);
  component({f.y, r.y, u.y}, y_);
  component({f.z, r.z, u.z}, z_);
  for (Colors* colors : {&even_, &odd_}) multiply(density.data(), (*colors)[0].data(), kBlock, (*colors)[0].data());
}

void ChartSum::flush() {
  if (count_ == 0) return;
  // What fills the block up has no colour.
  while (count_ < kBlock) {
    s_[count_] = t_[count_] = 0;
    for (std::size_t c = 0; c < 3; ++c) even_[c][count_] = odd_[c][count_] = 0;
    ++count_;
  }
  count_ = 0;
  findDirections();
  cosine_.fill(1);
  sine_.fill(0);
  for (int m = 0; m < order_; ++m) addBand(m);
}

/// Adds all degrees of orders m and -m.
void ChartSum::addBand(int m) {
  if (m > 0) raise(x_.data(), y_.data(), kBlock, cosine_.data(), sine_.data());
  // Mirroring y turns the sign of sin m phi, mirroring x that of cos m phi where m is odd, of sin m phi where it is
  // not.
  const bool cosineIsEven = !mirrorsX_ || m % 2 == 0, sineIsEven = mirrorsX_ && m % 2 != 0;
  multiply(cosine_.data(), (cosineIsEven ? even_ : odd_)[0].data(), kBlock, cosineColors_[0].data());
  multiply(sine_.data(), (sineIsEven ? even_ : odd_)[0].data(), kBlock, sineColors_[0].data());
  const auto degrees = static_cast<std::size_t>(order_);
  alignas(64) Values first, second, squares;
  first.fill(factors_[degrees * (degrees - 1) + static_cast<std::size_t>(m)]);
  second.fill(0);
  for (std::size_t j = 0; j < kBlock; ++j) squares[j] = x_[j] * x_[j] + y_[j] * y_[j] + z_[j] * z_[j];
  Values *last = &first, *before = &second;
  for (int l = m; l < order_; ++l) {
    if (l > m) {
      const auto at = static_cast<std::size_t>(l * (l - 1) / 2 + m) * 2;
      nextDegree(factors_[at], factors_[at + 1], z_.data(), squares.data(), kBlock, last->data(), before->data());
      std::swap(last, before);
    }
    addProducts(last->data(), cosineColors_[0].data(), kBlock, sum_[static_cast<std::size_t>(sh::index(l, m))]);
    if (m > 0)
      addProducts(last->data(), sineColors_[0].data(), kBlock, sum_[static_cast<std::size_t>(sh::index(l, -m))]);
  }
}

}  // namespace shbake
