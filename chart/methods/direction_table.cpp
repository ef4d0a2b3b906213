// Directions of the local hemisphere: sorting, tabulating, summing.
#include "chart/methods/direction_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/wide.h"
#include "sh/basis.h"

namespace shbake::chart {
namespace {

/// Groups summed in float before the sum moves to double.
constexpr std::size_t kChunk = 64;
constexpr std::size_t kVector = 4;

using Iterator = std::vector<WeightedDirection>::iterator;

/// Splits at the median of the longer side of the disc's bounding box until groups of 16 remain.
void sortIntoGroups(Iterator begin, Iterator end) {
  const auto groups = (end - begin + DirectionTable::kGroup - 1) / DirectionTable::kGroup;
  if (groups <= 1) return;
  const auto spread = [&](auto component) {
    const auto [low, high] =
        std::minmax_element(begin, end, [&](const auto& a, const auto& b) { return component(a) < component(b); });
    return component(*high) - component(*low);
  };
  const auto x = [](const WeightedDirection& w) { return w.direction.x; };
  const auto y = [](const WeightedDirection& w) { return w.direction.y; };
  const bool alongX = spread(x) > spread(y);
  const auto middle = begin + groups / 2 * DirectionTable::kGroup;
  std::nth_element(begin, middle, end,
                   [&](const auto& a, const auto& b) { return alongX ? x(a) < x(b) : y(a) < y(b); });
  sortIntoGroups(begin, middle);
  sortIntoGroups(middle, end);
}

/// Adds the rows of groups first..last-1 whose bits are set; S is the stride, known to the compiler so that the running
/// sums stay in registers. Groups mostly seen start from their stored sum.
template <std::size_t S>
[[gnu::always_inline]] inline void addGroups(const float* rows, const float* groupSums, const std::uint16_t* whole,
                                             std::span<const std::uint16_t> sky, std::size_t first, std::size_t last,
                                             double* total) {
  std::array<float, S> sum{};
  for (std::size_t g = first; g < last; ++g) {
    unsigned bits = sky[g];
    const float* group = rows + g * DirectionTable::kGroup * S;
    const bool most = std::popcount(bits) > DirectionTable::kGroup / 2;
    if (most) {
      for (std::size_t k = 0; k < S; ++k) sum[k] += groupSums[g * S + k];
      bits = whole[g] & ~bits;
    }
    const float sign = most ? -1.0f : 1.0f;
    for (; bits != 0; bits &= bits - 1) {
      const float* row = group + static_cast<std::size_t>(std::countr_zero(bits)) * S;
      for (std::size_t k = 0; k < S; ++k) sum[k] += sign * row[k];
    }
  }
  for (std::size_t k = 0; k < S; ++k) total[k] += static_cast<double>(sum[k]);
}

SHBAKE_WIDE void addGroupsOf(std::size_t stride, const float* rows, const float* sums, const std::uint16_t* whole,
                             std::span<const std::uint16_t> sky, std::size_t first, std::size_t last, double* total) {
  switch (stride) {
    case 4:  // orders 1, 2
      return addGroups<4>(rows, sums, whole, sky, first, last, total);
    case 12:
      return addGroups<12>(rows, sums, whole, sky, first, last, total);
    case 16:
      return addGroups<16>(rows, sums, whole, sky, first, last, total);
    case 28:
      return addGroups<28>(rows, sums, whole, sky, first, last, total);
    case 36:
      return addGroups<36>(rows, sums, whole, sky, first, last, total);
    case 52:
      return addGroups<52>(rows, sums, whole, sky, first, last, total);
    default:  // order 8
      return addGroups<64>(rows, sums, whole, sky, first, last, total);
  }
}

}  // namespace

Vec3d cosineDirection(double x, double y) {
  const double a = 2 * x - 1, b = 2 * y - 1;
  double r = 0, phi = 0;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = std::numbers::pi / 4 * b / a;
  } else if (b != 0) {
    r = b;
    phi = std::numbers::pi / 2 - std::numbers::pi / 4 * a / b;
  }
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, (1 - r) * (1 + r)))};
}

DirectionTable::DirectionTable(std::vector<WeightedDirection> set, int order)
    : order_(order), size_(static_cast<int>(set.size())) {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  stride_ = (count + kVector - 1) / kVector * kVector;
  sortIntoGroups(set.begin(), set.end());
  const std::size_t groups = (set.size() + kGroup - 1) / kGroup;
  masks_.assign(groups, 0);
  lowestZ_.assign(groups, 1);
  rows_.assign(groups * kGroup * stride_, 0);
  groupSums_.assign(groups * stride_, 0);
  // What pads the last group is never active, but is turned and handed to Embree like the others.
  x_.assign(groups * kGroup, 0);
  y_.assign(groups * kGroup, 0);
  z_.assign(groups * kGroup, 1);
  std::vector<double> y(count);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Vec3f d(set[i].direction);
    x_[i] = d.x;
    y_[i] = d.y;
    z_[i] = d.z;
    masks_[i / kGroup] |= static_cast<std::uint16_t>(1u << (i % kGroup));
    lowestZ_[i / kGroup] = std::min(lowestZ_[i / kGroup], d.z);
    sh::evaluate(order, set[i].direction, std::span(y));
    for (std::size_t k = 0; k < count; ++k) {
      rows_[i * stride_ + k] = static_cast<float>(set[i].weight * y[k]);
      groupSums_[i / kGroup * stride_ + k] += rows_[i * stride_ + k];
    }
  }
}

void DirectionTable::sum(std::span<const std::uint16_t> sky, std::span<double> local) const {
  std::array<double, 64> total{};
  for (std::size_t first = 0; first < sky.size(); first += kChunk) {
    addGroupsOf(stride_, rows_.data(), groupSums_.data(), masks_.data(), sky, first,
                std::min(first + kChunk, sky.size()), total.data());
  }
  std::copy_n(total.begin(), local.size(), local.begin());
}

}  // namespace shbake::chart
