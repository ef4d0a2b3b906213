#include "bake/direction_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

constexpr std::size_t kVector = 4;  // floats in the narrowest vector register

/// The lattice with weights of 1.
std::vector<WeightedDirection> cosineFibonacci(int n) {
  constexpr double kInverseGolden = std::numbers::phi - 1;
  std::vector<WeightedDirection> d(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) / n, r = std::sqrt(u);
    const double azimuth = 2 * std::numbers::pi * (i * kInverseGolden - std::floor(i * kInverseGolden));
    d[static_cast<std::size_t>(i)] = {{r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - u)}, 1};
  }
  return d;
}

using Iterator = std::vector<WeightedDirection>::iterator;

bool lessX(const WeightedDirection& a, const WeightedDirection& b) {
  return a.direction.x < b.direction.x;
}
bool lessY(const WeightedDirection& a, const WeightedDirection& b) {
  return a.direction.y < b.direction.y;
}

/// Lays the 16 directions of a group out in four slabs along its longer side, each sorted along the other.
void sortGroup(Iterator begin, bool alongX) {
  const auto sortBy = [&](Iterator b, Iterator e, bool x) { std::sort(b, e, x ? lessX : lessY); };
  sortBy(begin, begin + 16, alongX);
  for (int slab = 0; slab < 4; ++slab) sortBy(begin + 4 * slab, begin + 4 * slab + 4, !alongX);
}

/// Splits at the median of the longer side of the disc's bounding box until groups of 16 remain.
void sortIntoGroups(Iterator begin, Iterator end) {
  const auto [lowX, highX] = std::minmax_element(begin, end, lessX);
  const auto [lowY, highY] = std::minmax_element(begin, end, lessY);
  const bool alongX = highX->direction.x - lowX->direction.x > highY->direction.y - lowY->direction.y;
  const auto groups = (end - begin) / DirectionSet::kGroup;
  if (groups <= 1) return sortGroup(begin, alongX);
  const auto middle = begin + groups / 2 * DirectionSet::kGroup;
  std::nth_element(begin, middle, end, alongX ? lessX : lessY);
  sortIntoGroups(begin, middle);
  sortIntoGroups(middle, end);
}

}  // namespace

DirectionSet::DirectionSet(int rays, int order) : order_(order) {
  const std::vector<double> own = tabulate(cosineFibonacci((rays + kGroup - 1) / kGroup * kGroup));
  unshadowed_.resize(own.size());
  sh::unshadowedTransfer(order, {0, 0, 1}, 1, std::span(unshadowed_));
  residual_.resize(own.size());
  for (std::size_t k = 0; k < own.size(); ++k) residual_[k] = unshadowed_[k] - own[k];
}

DirectionSet::DirectionSet(std::vector<WeightedDirection> directions, int order) : order_(order) {
  while (directions.size() % kGroup != 0) directions.push_back({directions.back().direction, 0});
  for (WeightedDirection& d : directions) d.weight *= static_cast<double>(directions.size());
  unshadowed_ = tabulate(std::move(directions));
  residual_.assign(unshadowed_.size(), 0);
}

/// Sorts a multiple of 16 directions and tabulates the basis over them, times their weights, whose mean is 1. Returns
/// the mean of the rows.
std::vector<double> DirectionSet::tabulate(std::vector<WeightedDirection> directions) {
  const std::size_t n = directions.size();
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order_));
  stride_ = (count + kVector - 1) / kVector * kVector;
  sortIntoGroups(directions.begin(), directions.end());

  lowestZ_.assign(n / kGroup, 1);
  basis_.assign(n * stride_, 0);
  groupSums_.assign(n / kGroup * stride_, 0);
  std::vector<double> y(count), mean(count);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f d(directions[i].direction);
    x_.push_back(d.x);
    y_.push_back(d.y);
    z_.push_back(d.z);
    float& lowest = lowestZ_[i / kGroup];
    lowest = std::min(lowest, d.z);
    sh::evaluate(order_, directions[i].direction, std::span(y));
    for (std::size_t k = 0; k < count; ++k) {
      y[k] *= directions[i].weight;
      const float value = static_cast<float>(y[k]);
      basis_[i * stride_ + k] = value;
      groupSums_[i / kGroup * stride_ + k] += value;
      mean[k] += y[k];
    }
  }
  for (double& m : mean) m /= static_cast<double>(n);
  return mean;
}

}  // namespace shbake
