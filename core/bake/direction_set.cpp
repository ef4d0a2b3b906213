#include "bake/direction_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

constexpr std::size_t kVector = 4;  // floats in the narrowest vector register

std::vector<Vec3d> cosineFibonacci(int n) {
  constexpr double kInverseGolden = std::numbers::phi - 1;
  std::vector<Vec3d> d(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) / n, r = std::sqrt(u);
    const double azimuth = 2 * std::numbers::pi * (i * kInverseGolden - std::floor(i * kInverseGolden));
    d[static_cast<std::size_t>(i)] = {r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - u)};
  }
  return d;
}

using Iterator = std::vector<Vec3d>::iterator;

/// Lays the 16 directions of a group out in four slabs along its longer side, each sorted along the other.
void sortGroup(Iterator begin, bool alongX) {
  const auto byX = [](const Vec3d& a, const Vec3d& b) { return a.x < b.x; };
  const auto byY = [](const Vec3d& a, const Vec3d& b) { return a.y < b.y; };
  const auto sortBy = [&](Iterator b, Iterator e, bool x) { x ? std::sort(b, e, byX) : std::sort(b, e, byY); };
  sortBy(begin, begin + 16, alongX);
  for (int slab = 0; slab < 4; ++slab) sortBy(begin + 4 * slab, begin + 4 * slab + 4, !alongX);
}

/// Splits at the median of the longer side of the disc's bounding box until groups of 16 remain.
void sortIntoGroups(Iterator begin, Iterator end) {
  const auto [lowX, highX] = std::minmax_element(begin, end, [](auto& a, auto& b) { return a.x < b.x; });
  const auto [lowY, highY] = std::minmax_element(begin, end, [](auto& a, auto& b) { return a.y < b.y; });
  const bool alongX = highX->x - lowX->x > highY->y - lowY->y;
  const auto groups = (end - begin) / DirectionSet::kGroup;
  if (groups <= 1) return sortGroup(begin, alongX);
  const auto middle = begin + groups / 2 * DirectionSet::kGroup;
  std::nth_element(begin, middle, end, [alongX](auto& a, auto& b) { return alongX ? a.x < b.x : a.y < b.y; });
  sortIntoGroups(begin, middle);
  sortIntoGroups(middle, end);
}

}  // namespace

DirectionSet::DirectionSet(int rays, int order) : order_(order) {
  const int n = (rays + kGroup - 1) / kGroup * kGroup;
  const int count = sh::coefficientCount(order);
  stride_ = (static_cast<std::size_t>(count) + kVector - 1) / kVector * kVector;
  auto directions = cosineFibonacci(n);
  sortIntoGroups(directions.begin(), directions.end());

  lowestZ_.assign(static_cast<std::size_t>(n / kGroup), 1);
  basis_.assign(static_cast<std::size_t>(n) * stride_, 0);
  groupSums_.assign(static_cast<std::size_t>(n / kGroup) * stride_, 0);
  std::vector<double> y(static_cast<std::size_t>(count)), sum(y.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3f d(directions[i]);
    x_.push_back(d.x);
    y_.push_back(d.y);
    z_.push_back(d.z);
    float& lowest = lowestZ_[i / kGroup];
    lowest = std::min(lowest, d.z);
    sh::evaluate(order, directions[i], std::span(y));
    for (std::size_t k = 0; k < y.size(); ++k) {
      const float value = static_cast<float>(y[k]);
      basis_[i * stride_ + k] = value;
      groupSums_[i / kGroup * stride_ + k] += value;
      sum[k] += y[k];
    }
  }
  unshadowed_.resize(y.size());
  sh::unshadowedTransfer(order, {0, 0, 1}, 1, std::span(unshadowed_));
  residual_.resize(y.size());
  for (std::size_t k = 0; k < y.size(); ++k) residual_[k] = unshadowed_[k] - sum[k] / n;
}

}  // namespace shbake
