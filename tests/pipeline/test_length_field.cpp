// Edge lengths over flat regions: what was asked for is had, and grows with the distance from it.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
#include "pipeline/length_field.h"

using namespace shbake;

namespace {

Vec3d randomPlace(std::uint64_t i) {
  return {10 * hashUnit(1, 3 * i), 10 * hashUnit(1, 3 * i + 1), 10 * hashUnit(1, 3 * i + 2)};
}

}  // namespace

TEST_CASE("nothing is wanted where nothing was asked for", "[length_field]") {
  LengthField field({0, 0, 0}, 10);
  field.want(field.cellAt(7, {1, 2, 3}, 12));
  for (std::uint64_t i = 0; i < 100; ++i) CHECK(field.levelAt(6, randomPlace(i)) == 0);
  CHECK(LengthField({0, 0, 0}, 1).levelAt(0, {0.5, 0.5, 0.5}) == 0);
}

TEST_CASE("levels are the nearest by ratio", "[length_field]") {
  const LengthField field({0, 0, 0}, 8);
  CHECK(field.levelOf(8) == 0);
  CHECK(field.levelOf(100) == 0);
  CHECK(field.levelOf(4) == 1);
  CHECK(field.levelOf(4 * 1.4) == 1);
  CHECK(field.levelOf(4 * 1.42) == 0);
  CHECK(field.levelOf(1e-300) == LengthField::kMostLevels);
  CHECK(field.lengthOf(3) == 1);
}

TEST_CASE("a cell that is wanted has its length to the border, and the best of all that were asked for",
          "[length_field]") {
  LengthField field({0, 0, 0}, 8);
  field.want(field.cellAt(0, {4.1, 4.1, 4.1}, 6));
  CHECK(field.levelAt(0, {4, 4, 4}) == 6);
  CHECK(field.levelAt(0, {4.124, 4.124, 4.124}) == 6);
  CHECK(field.levelAt(0, {4.126, 4.1, 4.1}) == 5);
  field.want(field.cellAt(0, {4.1, 4.1, 4.1}, 3));
  CHECK(field.levelAt(0, {4.1, 4.1, 4.1}) == 6);
  const std::size_t cells = field.cells();
  field.want(field.cellAt(0, {4.1, 4.1, 4.1}, 6));
  CHECK(field.cells() == cells);
}

TEST_CASE("lengths grow in proportion to the distance from what is wanted", "[length_field]") {
  LengthField field({0, 0, 0}, 10);
  for (std::uint64_t i = 0; i < 5; ++i) {
    field.want(field.cellAt(0, randomPlace(1000 + i), 4 + static_cast<std::uint32_t>(3 * i)));
  }
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec3d a = randomPlace(i), step = (randomPlace(i + 50000) - Vec3d(5, 5, 5)) * std::exp2(-double(i % 16));
    const Vec3d b = a + step;
    const double la = field.lengthOf(field.levelAt(0, a)), lb = field.lengthOf(field.levelAt(0, b));
    // Neighbouring cells differ by one level; a level of cells twice as wide surrounds each for at least its own width.
    CHECK(lb <= 2 * la + 2 * length(step) * std::sqrt(3.0));
  }
}

TEST_CASE("places outside the cube and its corners count as at its border", "[length_field]") {
  LengthField field({0, 0, 0}, 1);
  field.want(field.cellAt(0, {2, 2, 2}, LengthField::kMostLevels));
  CHECK(field.levelAt(0, {1, 1, 1}) == LengthField::kMostLevels);
  field.want(field.cellAt(0, {-1, 0, 0}, 5));
  CHECK(field.levelAt(0, {0, 0, 0}) == 5);
}
