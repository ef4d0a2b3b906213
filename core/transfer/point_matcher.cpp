#include "transfer/point_matcher.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/hash.h"

namespace shbake {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// The distance of two points along the axis where they are farthest apart.
double axisDistance(const Vec3d& a, const Vec3d& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

std::int64_t cellOf(double coordinate, double low, double cell) {
  return static_cast<std::int64_t>(std::floor((coordinate - low) / cell));
}

}  // namespace

PointMatcher::PointMatcher(const std::vector<Vec3d>& positions, const std::vector<Vec3f>& normals, Passes& passes)
    : positions_(positions), normals_(normals) {
  if (positions.empty()) return;
  low_ = high_ = positions[0];
  double largest = 0;
  passes.forEach(positions.size(), [&](std::size_t i) {
    const Vec3d& p = positions[i];
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  });
  constexpr double kFloatStep = std::numeric_limits<float>::epsilon();
  distance_ = std::max(kRelativeDistance * axisDistance(low_, high_), 4 * kFloatStep * largest);
  if (distance_ > 0) cell_ = 2 * distance_;
  mask_ = std::bit_ceil(positions.size()) - 1;
  heads_.assign(mask_ + 1, kNone);
  next_.resize(positions.size());
  passes.forEach(positions.size(), [&](std::size_t fromEnd) {
    const std::size_t i = positions.size() - 1 - fromEnd;
    const Vec3d& p = positions[i];
    std::uint32_t& head =
        heads_[bucket(cellOf(p.x, low_.x, cell_), cellOf(p.y, low_.y, cell_), cellOf(p.z, low_.z, cell_))];
    next_[i] = head;
    head = static_cast<std::uint32_t>(i);
  });
}

std::uint64_t PointMatcher::bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const auto bits = [](std::int64_t i) { return static_cast<std::uint64_t>(i); };
  return mixBits(mixBits(mixBits(bits(x)) + bits(y)) + bits(z)) & mask_;
}

std::optional<std::uint32_t> PointMatcher::find(const Vec3d& position, const Vec3f& normal,
                                                std::uint32_t preferred) const {
  if (positions_.empty()) return {};
  // Beyond the box nothing matches, and cells need not be numbered.
  const Vec3d clamped(std::clamp(position.x, low_.x, high_.x), std::clamp(position.y, low_.y, high_.y),
                      std::clamp(position.z, low_.z, high_.z));
  if (!(axisDistance(clamped, position) <= distance_)) return {};
  std::tuple<double, double, bool, std::uint32_t> best{};
  bool found = false;
  const auto range = [&](double c, double low) {
    return std::pair(cellOf(c - distance_, low, cell_), cellOf(c + distance_, low, cell_));
  };
  const auto [x0, x1] = range(position.x, low_.x);
  const auto [y0, y1] = range(position.y, low_.y);
  const auto [z0, z1] = range(position.z, low_.z);
  for (std::int64_t x = x0; x <= x1; ++x) {
    for (std::int64_t y = y0; y <= y1; ++y) {
      for (std::int64_t z = z0; z <= z1; ++z) {
        for (std::uint32_t i = heads_[bucket(x, y, z)]; i != kNone; i = next_[i]) {
          const double apart = axisDistance(positions_[i], position);
          if (apart > distance_) continue;
          const double angle = angleBetween(Vec3d(normals_[i]), Vec3d(normal));
          if (angle > kAngle) continue;
          const std::tuple candidate(apart, angle, i != preferred, i);
          if (!found || candidate < best) best = candidate;
          found = true;
        }
      }
    }
  }
  return found ? std::optional(std::get<3>(best)) : std::nullopt;
}

}  // namespace shbake
