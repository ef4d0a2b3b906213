// Integrals over lat-long pixels, which separate: y_lm = q_lm(theta) times cos or sin of m phi, so that a row of pixels
// meets all degrees through the Fourier coefficients of its radiance alone.
#include "light/lat_long_projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "light/quadrature_size.h"
#include "sh/basis.h"

namespace shbake {
namespace {

using std::numbers::pi;

constexpr int kStripRows = 8;
constexpr int kBlock = 256;  ///< columns whose folded colours stay in the first-level cache
constexpr int kLanes = 8;    ///< independent sums: the order of additions is fixed while the compiler may use vectors

/// Colours of a block of columns and their half-turn partners: sums meet even m, differences odd m.
struct Folded {
  std::array<std::array<double, kBlock>, 3> even, odd;

  void load(const Rgb* row, const Rgb* partner, int count) {
    for (int j = 0; j < count; ++j) {
      const Vec3d a(row[j]), b = partner ? Vec3d(partner[j]) : Vec3d{};
      set(even, j, a + b);
      set(odd, j, partner ? a - b : a);
    }
    // The table may be read past the columns by less than kLanes: zeros add nothing.
    for (int j = count; j < (count + kLanes - 1) / kLanes * kLanes; ++j) {
      set(even, j, {});
      set(odd, j, {});
    }
  }

 private:
  static void set(std::array<std::array<double, kBlock>, 3>& to, int j, const Vec3d& v) {
    to[0][j] = v.x;
    to[1][j] = v.y;
    to[2][j] = v.z;
  }
};

/// The sum over a block of factor * value.
double weightedSum(const double* factors, const std::array<double, kBlock>& values, int count) {
  std::array<double, kLanes> sums{};
  for (int j = 0; j < count; j += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) sums[lane] += factors[j + lane] * values[j + lane];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

Vec3d weightedSum(const double* factors, const std::array<std::array<double, kBlock>, 3>& colors, int count) {
  return {weightedSum(factors, colors[0], count), weightedSum(factors, colors[1], count),
          weightedSum(factors, colors[2], count)};
}

}  // namespace

/// The sums over a row of colour times cos and sin of m phi.
struct LatLongProjector::Moments {
  std::vector<Vec3d> cosine, sine;
};

LatLongProjector::LatLongProjector(const MapShape& shape, int order) : shape_(shape), order_(order) {
  if (shape.border && (shape.width < 2 || shape.height < 2)) {
    throw Error({.place = "header", .cause = "a map with pixels on its edge needs 2 rows and 2 columns"});
  }
  // With a border, the first and the last column lie on the same half circle and share one cell.
  columns_ = shape.border ? shape.width - 1 : shape.width;
  half_ = columns_ % 2 == 0 ? columns_ / 2 : columns_;
  const double rowHeight = pi / (shape.border ? shape.height - 1 : shape.height);
  // q_lm sin(theta) is a trigonometric polynomial of degree l + 1 <= order.
  rule_ = sh::gaussLegendre(gaussNodes(trigonometricGrowth(order), rowHeight / 2));

  const std::size_t stride = static_cast<std::size_t>(half_);
  cosines_.assign(stride * order + kLanes, 0);
  sines_.assign(stride * order + kLanes, 0);
  const long long period = 2LL * columns_;
  for (int m = 0; m < order; ++m) {
    for (int j = 0; j < half_; ++j) {
      // phi_j = pi (columns - 2j - 1) / columns, without the -1 where cells are centred on the edge. Reduced as
      // integers, so that no digit of the angle is lost.
      const long long steps = m * (columns_ - 2LL * j - (shape.border ? 0 : 1)) % period;
      const double angle = pi * static_cast<double>(steps) / columns_;
      cosines_[m * stride + j] = std::cos(angle);
      sines_[m * stride + j] = std::sin(angle);
    }
  }
}

std::vector<RowStrip> LatLongProjector::strips() const {
  std::vector<RowStrip> strips;
  for (int y = 0; y < shape_.height; y += kStripRows) strips.push_back({y, std::min(y + kStripRows, shape_.height)});
  return strips;
}

void LatLongProjector::project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const {
  Moments moments;
  std::vector<Rgb> merged;
  for (int y = strip.begin; y < strip.end; ++y) {
    const Rgb* row = pixels.data() + static_cast<std::size_t>(y - strip.begin) * shape_.width;
    if (shape_.border) {
      merged.assign(row, row + columns_);
      merged[0] = 0.5f * (row[0] + row[columns_]);
      row = merged.data();
    }
    moments.cosine.assign(order_, {});
    moments.sine.assign(order_, {});
    addRowMoments(row, moments);
    addRow(y, moments, sum);
  }
}

void LatLongProjector::addRowMoments(const Rgb* row, Moments& moments) const {
  Folded folded;
  for (int begin = 0; begin < half_; begin += kBlock) {
    const int count = std::min(kBlock, half_ - begin);
    folded.load(row + begin, half_ < columns_ ? row + half_ + begin : nullptr, count);
    for (int m = 0; m < order_; ++m) {
      const auto& colors = m % 2 == 0 ? folded.even : folded.odd;
      const std::size_t at = static_cast<std::size_t>(m) * half_ + begin;
      moments.cosine[m] += weightedSum(&cosines_[at], colors, count);
      if (m > 0) moments.sine[m] += weightedSum(&sines_[at], colors, count);
    }
  }
}

/// Where row i begins, as an angle from the pole.
double LatLongProjector::rowEdge(int i) const {
  if (!shape_.border) return pi * i / shape_.height;
  return pi * std::clamp((i - 0.5) / (shape_.height - 1), 0.0, 1.0);
}

void LatLongProjector::addRow(int row, const Moments& moments, std::span<Vec3d> sum) const {
  const double top = rowEdge(row), thickness = rowEdge(row + 1) - top;
  std::vector<double> y(sum.size()), q(sum.size());
  for (std::size_t k = 0; k < rule_.nodes.size(); ++k) {
    const double theta = top + thickness * (1 + rule_.nodes[k]) / 2, s = std::sin(theta);
    sh::evaluate(order_, Vec3d{s, 0, std::cos(theta)}, y);
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += rule_.weights[k] * thickness / 2 * s * y[i];
  }
  const double step = 2 * pi / columns_;
  for (int m = 0; m < order_; ++m) {
    // The integral of cos m phi over a cell is its value at the middle times this.
    const double width = m == 0 ? step : 2 * std::sin(m * step / 2) / m;
    for (int l = m; l < order_; ++l) {
      const double factor = width * q[sh::index(l, m)];
      sum[sh::index(l, m)] += factor * moments.cosine[m];
      if (m > 0) sum[sh::index(l, -m)] += factor * moments.sine[m];
    }
  }
}

}  // namespace shbake
