// When coordinates of text files need double precision.
#include <catch2/catch.hpp>
#include <vector>

#include "base/hash.h"
#include "mesh/position_precision.h"

using namespace shbake;

namespace {

/// Random points in a box of size 2, centred on `centre`, all times `scale`.
std::vector<Vec3d> points(Vec3d centre, double scale) {
  std::vector<Vec3d> list;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d p(hashUnit(1, i), hashUnit(2, i), hashUnit(3, i));
    list.push_back((p * 2 - Vec3d(1, 1, 1) + centre) * scale);
  }
  return list;
}

}  // namespace

TEST_CASE("centred points and boxes at the origin stay in float at any scale") {
  for (const double scale : {1e-20, 1e-6, 1.0, 1e6, 1e20}) {
    CHECK_FALSE(positionsNeedDouble(points({0, 0, 0}, scale)));
    CHECK_FALSE(positionsNeedDouble(points({1, 1, 1}, scale)));
  }
}

TEST_CASE("points many diagonals from the origin need double at any scale") {
  for (const double scale : {1e-20, 1e-6, 1.0, 1e6, 1e20}) {
    CHECK(positionsNeedDouble(points({20, 0, 0}, scale)));
    CHECK(positionsNeedDouble(points({4.5e6, 5.4e6, 300}, scale)));
  }
}

TEST_CASE("points that float holds exactly never need double") {
  CHECK_FALSE(positionsNeedDouble(std::vector<Vec3d>{{4500000, 5400000, 300}, {4500001, 5400000, 300}}));
  CHECK_FALSE(positionsNeedDouble({}));
}

TEST_CASE("numbers beyond the range of float need double") {
  CHECK(positionsNeedDouble(std::vector<Vec3d>{{1e300, 0, 0}, {-1e300, 0, 0}}));
}
