// Pairs of boxes that meet, against all pairs looked at.
#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "mesh/box_pairs.h"

using namespace shbake;

namespace {

std::vector<Box> randomBoxes(std::size_t count, std::uint64_t seed) {
  std::vector<Box> boxes;
  std::uint64_t drawn = 0;
  const auto next = [&] { return hashUnit(seed, drawn++); };
  for (std::size_t i = 0; i < count; ++i) {
    // On a coarse grid, so that many touch; some have no extent.
    const auto cell = [&](double most) { return std::floor(most * next()); };
    const Vec3d low(cell(12), cell(12), cell(12));
    boxes.push_back({low, low + Vec3d(cell(4), cell(4), cell(4))});
  }
  return boxes;
}

bool meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace

TEST_CASE("each pair of boxes that meet or touch is visited once", "[refine]") {
  const std::vector<Box> a = randomBoxes(300, 1), b = randomBoxes(500, 2);
  std::vector<std::pair<std::size_t, std::size_t>> visited, expected;
  forEachMeeting(a, b, [&](std::size_t i, std::size_t j) { visited.emplace_back(i, j); });
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (meet(a[i], b[j])) expected.emplace_back(i, j);
    }
  }
  std::sort(visited.begin(), visited.end());
  CHECK(visited == expected);
}

TEST_CASE("no boxes meet none, and a visit may stop the search", "[refine]") {
  const auto refuse = [](std::size_t, std::size_t) { throw std::runtime_error("stop"); };
  const std::vector<Box> some = randomBoxes(20, 3);
  CHECK_NOTHROW(forEachMeeting({}, some, refuse));
  CHECK_NOTHROW(forEachMeeting(some, {}, refuse));
  CHECK_THROWS_AS(forEachMeeting(some, some, refuse), std::runtime_error);
}
