#include "mesh/position_welder.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/hash.h"

namespace shbake {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFu;
constexpr std::size_t kFewestSlots = 16;

std::uint64_t hashPosition(const Vec3d& p) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v + 0.0); };  // -0 + 0 is +0
  return mixBits(bits(p.x) + 3 * mixBits(bits(p.y) + 5 * mixBits(bits(p.z))));
}

}  // namespace

PositionWelder::PositionWelder(std::size_t expected)
    : slots_(std::bit_ceil(std::max(kFewestSlots, expected + expected / 2)), kFree) {
  positions_.reserve(expected);
}

std::uint32_t PositionWelder::add(const Vec3d& p) {
  std::size_t slot = slotOf(p);
  if (slots_[slot] != kFree) return slots_[slot];
  if (3 * (positions_.size() + 1) > 2 * slots_.size()) {
    grow(2 * slots_.size());
    slot = slotOf(p);
  }
  slots_[slot] = static_cast<std::uint32_t>(positions_.size());
  positions_.push_back(p);
  return slots_[slot];
}

std::vector<Vec3d> PositionWelder::takePositions() {
  slots_.assign(kFewestSlots, kFree);
  return std::exchange(positions_, {});
}

/// The slot that holds `p`, or the free one where it belongs (linear probing).
std::size_t PositionWelder::slotOf(const Vec3d& p) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hashPosition(p) & mask;
  while (slots_[slot] != kFree && positions_[slots_[slot]] != p) slot = (slot + 1) & mask;
  return slot;
}

void PositionWelder::grow(std::size_t slots) {
  slots_.assign(slots, kFree);
  for (std::uint32_t i = 0; i < positions_.size(); ++i) slots_[slotOf(positions_[i])] = i;
}

}  // namespace shbake
