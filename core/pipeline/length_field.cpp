#include "pipeline/length_field.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace shbake {

std::size_t LengthField::Hash::operator()(const Cell& cell) const {
  const std::uint64_t place = (std::uint64_t(cell.x) << 40) ^ (std::uint64_t(cell.y) << 20) ^ cell.z;
  return static_cast<std::size_t>(hashBits((std::uint64_t(cell.region) << 8) + cell.level, place));
}

std::uint32_t LengthField::levelOf(double length) const {
  return static_cast<std::uint32_t>(std::clamp(std::round(std::log2(size_ / length)), 0.0, double(kMostLevels)));
}

LengthField::Cell LengthField::cellAt(std::uint32_t region, const Vec3d& place, std::uint32_t level) const {
  const double cells = static_cast<double>(std::uint64_t(1) << level);
  const auto index = [&](double at, double low) {
    return static_cast<std::uint32_t>(std::clamp(std::floor((at - low) / size_ * cells), 0.0, cells - 1));
  };
  return {region, level, index(place.x, low_.x), index(place.y, low_.y), index(place.z, low_.z)};
}

std::uint32_t LengthField::levelAt(std::uint32_t region, const Vec3d& place) const {
  // A cell is wanted only where those around it on the levels above are.
  std::uint32_t level = 0;
  while (level < kMostLevels && wanted_.count(cellAt(region, place, level + 1)) != 0) ++level;
  return level;
}

void LengthField::want(const Cell& cell) {
  if (cell.level == 0 || !wanted_.insert(cell).second) return;
  if (cell.level == 1) return;
  const std::uint32_t last = (std::uint32_t(1) << (cell.level - 1)) - 1;
  const auto each = [&](std::uint32_t at, const auto& visit) {
    const std::uint32_t parent = at / 2;
    for (std::uint32_t i = parent == 0 ? 0 : parent - 1; i <= std::min(parent + 1, last); ++i) visit(i);
  };
  each(cell.x, [&](std::uint32_t x) {
    each(cell.y, [&](std::uint32_t y) {
      each(cell.z, [&](std::uint32_t z) { want({cell.region, cell.level - 1, x, y, z}); });
    });
  });
}

}  // namespace shbake
