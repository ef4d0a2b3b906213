// Extremes of band-limited functions. The bound of the grid is Riesz's: a trigonometric polynomial of degree L falls
// from a maximum M no faster than M cos(L x) (M. Riesz, "Eine trigonometrische Interpolationsformel", 1914), and a
// spherical function of degree L is one along each great circle.
#include "sh/extremes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"
#include "sh/projection.h"

namespace shbake::sh {
namespace {

using std::numbers::pi;

constexpr int kRingsPerOrder = 8;

/// Values on rings of equal polar steps and azimuths of equal steps; no point lies on a pole.
class RingGrid {
 public:
  RingGrid(int order, std::span<const double> coefficients)
      : rings_(kRingsPerOrder * order), azimuths_(2 * rings_), values_(std::size_t(rings_) * azimuths_) {
    std::vector<double> cosines(azimuths_), sines(azimuths_), y(coefficientCount(order)), c(order), s(order);
    for (int k = 0; k < azimuths_; ++k) {
      cosines[k] = std::cos(2 * pi * k / azimuths_);
      sines[k] = std::sin(2 * pi * k / azimuths_);
    }
    for (int ring = 0; ring < rings_; ++ring) {
      const Vec3d d = direction(ring, 0);
      evaluate(order, d, y);
      // On a ring the function is a Fourier sum of `order` frequencies.
      std::fill(c.begin(), c.end(), 0.0);
      std::fill(s.begin(), s.end(), 0.0);
      for (int l = 0; l < order; ++l) {
        for (int m = 0; m <= l; ++m) {
          c[m] += coefficients[index(l, m)] * y[index(l, m)];
          if (m > 0) s[m] += coefficients[index(l, -m)] * y[index(l, m)];
        }
      }
      for (int k = 0; k < azimuths_; ++k) {
        double sum = c[0];
        for (int m = 1, step = k; m < order; ++m, step = (step + k < azimuths_ ? step + k : step + k - azimuths_)) {
          sum += c[m] * cosines[step] + s[m] * sines[step];
        }
        values_[std::size_t(ring) * azimuths_ + k] = sum;
      }
    }
  }

  Vec3d direction(int ring, int k) const {
    const double theta = pi * (ring + 0.5) / rings_, phi = 2 * pi * k / azimuths_;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }

  int rings() const { return rings_; }
  int azimuths() const { return azimuths_; }
  const std::vector<double>& values() const { return values_; }
  double spacing() const { return pi / rings_; }

  /// The value at a ring and azimuth that may lie beyond a pole or a full turn.
  double at(int ring, int k) const {
    if (ring < 0 || ring >= rings_) {
      ring = ring < 0 ? -1 - ring : 2 * rings_ - 1 - ring;
      k += azimuths_ / 2;
    }
    return values_[std::size_t(ring) * azimuths_ + (k + azimuths_) % azimuths_];
  }

 private:
  int rings_, azimuths_;
  std::vector<double> values_;
};

/// The greatest distance that a proven bound allows between an extreme and the best grid point: with the centre c and
/// amplitude A of the function, the extreme's grid neighbour at distance x <= spacing / sqrt 2 has |value - c| >= A
/// cos(L x).
double gridBound(int order, const RingGrid& grid) {
  const auto [low, high] = std::minmax_element(grid.values().begin(), grid.values().end());
  const double cosine = std::cos((order - 1) * grid.spacing() / std::numbers::sqrt2);
  const double amplitude = (*high - *low) / 2 / cosine;
  return amplitude * (1 - cosine);
}

/// sign * f, with room for the basis.
class Function {
 public:
  Function(int order, std::span<const double> coefficients, double sign)
      : order_(order), coefficients_(coefficients), sign_(sign), y_(coefficientCount(order)) {}

  double operator()(const Vec3d& d) {
    evaluate(order_, d, y_);
    return sign_ * productIntegral(coefficients_, y_);
  }

 private:
  int order_;
  std::span<const double> coefficients_;
  double sign_;
  std::vector<double> y_;
};

struct Move {
  double u, v;
};

/// Newton's step from derivatives gu, gv, guu, gvv, guv, downhill along both axes of curvature and at most `radius`
/// long.
Move newtonMove(double gu, double gv, double guu, double gvv, double guv, double radius) {
  // The axes of curvature: an angle whose double turns (guu - gvv, 2 guv) onto the first axis.
  const double angle = std::atan2(2 * guv, guu - gvv) / 2, c = std::cos(angle), s = std::sin(angle);
  const double mean = (guu + gvv) / 2, half = std::hypot(guu - gvv, 2 * guv) / 2;
  const double g1 = c * gu + s * gv, g2 = c * gv - s * gu;
  // A curvature near zero or negative would step uphill or far away; the radius bounds the step instead.
  const double floor = std::max(std::hypot(gu, gv) / radius / 4, 1e-300);
  const double a = -g1 / std::max(std::abs(mean + half), floor), b = -g2 / std::max(std::abs(mean - half), floor);
  const double shrink = std::min(1.0, radius / std::max(std::hypot(a, b), 1e-300));
  return {shrink * (c * a - s * b), shrink * (s * a + c * b)};
}

/// Walks downhill from a grid point by Newton's method in the tangent plane, with derivatives from differences.
Extreme descend(Function& f, const Vec3d& start, double spacing) {
  Extreme best{f(start), start};
  // Differences over h misplace the extreme by (L h)^2 / 6L, and its value by the square of that: 1e-14 relative at the
  // floor, spacing / 1000 = 4e-4 / L, where their rounding is no greater.
  double h = spacing / 8, radius = 2 * spacing;
  for (int step = 0; step < 40 && radius > 1e-9 * spacing; ++step) {
    const Vec3d helper = std::abs(best.direction.z) < 0.7 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
    const Vec3d u = normalized(cross(helper, best.direction)), v = cross(best.direction, u);
    const auto at = [&](double a, double b) { return f(normalized(best.direction + u * a + v * b)); };
    const double left = at(-h, 0), right = at(h, 0), down = at(0, -h), up = at(0, h);
    const double mixed = at(h, h) + at(-h, -h) - left - right - down - up + 2 * best.value;
    const Move move =
        newtonMove((right - left) / (2 * h), (up - down) / (2 * h), (left + right - 2 * best.value) / (h * h),
                   (down + up - 2 * best.value) / (h * h), mixed / (2 * h * h), radius);
    const Vec3d d = normalized(best.direction + u * move.u + v * move.v);
    const double value = f(d);
    const bool better = value < best.value;
    if (better) best = {value, d};
    radius = better ? std::max(2 * std::hypot(move.u, move.v), radius / 4) : radius / 8;
    h = std::max(h / 4, spacing / 1000);
  }
  return best;
}

/// The least value of sign * f, as f has it.
Extreme lowest(int order, std::span<const double> coefficients, double sign, const RingGrid& grid, double bound) {
  struct Start {
    double value;
    int ring, azimuth;
  };
  std::vector<Start> starts;
  double best = INFINITY;
  for (const double v : grid.values()) best = std::min(best, sign * v);
  for (int ring = 0; ring < grid.rings(); ++ring) {
    for (int k = 0; k < grid.azimuths(); ++k) {
      const double value = sign * grid.at(ring, k);
      if (value > best + bound) continue;
      bool isLowest = true;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) isLowest = isLowest && value <= sign * grid.at(ring + i, k + j);
      }
      if (isLowest) starts.push_back({value, ring, k});
    }
  }
  // A function that is constant along circles is equally low in many places; a few of them stand for all.
  constexpr std::size_t kMaxStarts = 32;
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.value < b.value; });
  if (starts.size() > kMaxStarts) starts.resize(kMaxStarts);
  Function f(order, coefficients, sign);
  Extreme result{INFINITY, {}};
  for (const Start& s : starts) {
    const Extreme found = descend(f, grid.direction(s.ring, s.azimuth), grid.spacing());
    if (found.value < result.value) result = found;
  }
  result.value *= sign;
  return result;
}

void requireFinite(int order, std::span<const double> coefficients) {
  requireOrder(order, 1, kMaxBasisOrder, "a function");
  requireCoefficients(order, coefficients.size(), "the function whose range is asked for");
  for (int i = 0; i < coefficientCount(order); ++i) {
    if (!std::isfinite(coefficients[i])) {
      throw usageError("coefficient " + std::to_string(i) + " is not finite", "give finite coefficients");
    }
  }
}

}  // namespace

Range valueRange(int order, std::span<const double> coefficients) {
  requireFinite(order, coefficients);
  const RingGrid grid(order, coefficients);
  const double bound = gridBound(order, grid);
  return {lowest(order, coefficients, 1, grid, bound), lowest(order, coefficients, -1, grid, bound), bound};
}

bool staysAbove(int order, std::span<const double> coefficients, double floor) {
  requireFinite(order, coefficients);
  const RingGrid grid(order, coefficients);
  const double least = *std::min_element(grid.values().begin(), grid.values().end());
  if (least < floor) return false;
  const double bound = gridBound(order, grid);
  return least - bound >= floor || lowest(order, coefficients, 1, grid, bound).value >= floor;
}

}  // namespace shbake::sh
