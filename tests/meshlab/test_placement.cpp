// Transforms of layers: points, normals, turns between two of them.
#include <catch2/catch.hpp>
#include <cmath>

#include "meshlab_plugin/placement.h"

using namespace shbake;
using meshlab::Placement;

namespace {

using Rows = std::array<double, 16>;

/// A rotation with a scale of each row and a shift.
Rows rowsOf(const sh::Matrix3d& r, const Vec3d& shift, const Vec3d& scale = {1, 1, 1}) {
  return {scale.x * r(0, 0),
          scale.x * r(0, 1),
          scale.x * r(0, 2),
          shift.x,
          scale.y * r(1, 0),
          scale.y * r(1, 1),
          scale.y * r(1, 2),
          shift.y,
          scale.z * r(2, 0),
          scale.z * r(2, 1),
          scale.z * r(2, 2),
          shift.z,
          0,
          0,
          0,
          1};
}

double distance(const sh::Matrix3d& a, const sh::Matrix3d& b) {
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(a(i, j) - b(i, j)));
  }
  return worst;
}

}  // namespace

TEST_CASE("placement: the identity changes nothing, to the last bit") {
  const Placement identity(rowsOf({}, {}), "layer");
  CHECK(identity.isIdentity());
  const Vec3f oddNormal{0.1f, 3.0f, -7.7f};
  CHECK(identity.normal(oddNormal) == oddNormal);
  CHECK(identity.point({0.1, 0.2, 0.3}) == Vec3d{0.1, 0.2, 0.3});
}

TEST_CASE("placement: a point finds its way back") {
  const sh::Matrix3d turn = sh::rotationAbout({1, 2, 3}, 0.7);
  for (const Vec3d& scale : {Vec3d{2, 0.5, 3}, Vec3d{-1, 1, 4}}) {
    const Placement placement(rowsOf(turn, {1, -2, 3}, scale), "layer");
    const Vec3d p{0.3, -0.7, 5};
    CHECK(length(placement.pointBack(placement.point(p)) - p) < 1e-14);
  }
  CHECK(Placement().pointBack({0.1, 0.2, 0.3}) == Vec3d{0.1, 0.2, 0.3});
}

TEST_CASE("placement: normals stay at right angles to the surface under scaling, and turn with a mirror") {
  // The plane through x + y = 1 becomes 2 x + y = ... when x is halved: its normal is (2, 1, 0).
  const Placement squeezed(rowsOf({}, {5, 6, 7}, {0.5, 1, 1}), "layer");
  const Vec3f n = squeezed.normal(normalized(Vec3f{1, 1, 0}));
  const Vec3f expected = normalized(Vec3f{2, 1, 0});
  CHECK(length(n - expected) < 1e-6f);
  CHECK(length(squeezed.normalBack(n) - normalized(Vec3f{1, 1, 0})) < 1e-6f);
  // In a mirror, what looks along +x looks along -x, and what looks along +y still does.
  const Placement mirror(rowsOf({}, {}, {-1, 1, 1}), "layer");
  CHECK(mirror.mirrors());
  CHECK(mirror.normal({1, 0, 0}) == Vec3f{-1, 0, 0});
  CHECK(mirror.normal({0, 1, 0}) == Vec3f{0, 1, 0});
}

TEST_CASE("placement: the turn between two placements, whatever their shift and scale") {
  const sh::Matrix3d first = sh::rotationAbout({1, 2, 3}, 0.7), second = sh::rotationAbout({-3, 1, 0.5}, 2.1);
  const Placement from(rowsOf(first, {1, 2, 3}, {2, 2, 2}), "layer");
  const Placement to(rowsOf(second, {-4, 0, 9}, {0.3, 0.3, 0.3}), "layer");
  CHECK(distance(to.turnFrom(from), second * sh::transposed(first)) < 1e-14);
  CHECK(to.turnFrom(to) == sh::Matrix3d{});
}

TEST_CASE("placement: what is no turn is refused") {
  const Placement plain(rowsOf({}, {}), "layer");
  CHECK_THROWS_AS(Placement(rowsOf({}, {}, {1, 1, 1.01}), "layer").turnFrom(plain), Error);
  CHECK_THROWS_AS(Placement(rowsOf({}, {}, {-1, 1, 1}), "layer").turnFrom(plain), Error);
}

TEST_CASE("placement: transforms that cannot be undone name the layer") {
  Rows projective = rowsOf({}, {});
  projective[12] = 0.5;
  Rows infinite = rowsOf({}, {});
  infinite[3] = std::nan("");
  using Catch::Matchers::StartsWith;
  CHECK_THROWS_WITH(Placement(projective, "scan"), StartsWith("scan: transform: is not affine"));
  CHECK_THROWS_WITH(Placement(infinite, "scan"), StartsWith("scan: transform: is not finite"));
  CHECK_THROWS_WITH(Placement(rowsOf({}, {}, {1, 0, 1}), "scan"), StartsWith("scan: transform: flattens"));
}
