// Rotation matrices in space.
#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "sh/matrix3.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("rotations about the axes turn the next axis towards the one after it") {
  REQUIRE(length(rotationAboutX(kPi / 2) * Vec3d{0, 1, 0} - Vec3d{0, 0, 1}) < 1e-15);
  REQUIRE(length(rotationAboutY(kPi / 2) * Vec3d{0, 0, 1} - Vec3d{1, 0, 0}) < 1e-15);
  REQUIRE(length(rotationAboutZ(kPi / 2) * Vec3d{1, 0, 0} - Vec3d{0, 1, 0}) < 1e-15);
}

TEST_CASE("a rotation about any axis agrees with those about the axes, and keeps its axis") {
  for (const double angle : {0.3, -2.0, 1e-9, kPi}) {
    REQUIRE(difference(rotationAbout({5, 0, 0}, angle), rotationAboutX(angle)) < 1e-15);
    REQUIRE(difference(rotationAbout({0, 0.1, 0}, angle), rotationAboutY(angle)) < 1e-15);
    REQUIRE(difference(rotationAbout({0, 0, 7}, angle), rotationAboutZ(angle)) < 1e-15);
    const Vec3d axis = randomDirection(50, 0);
    const Matrix3d r = rotationAbout(axis, angle);
    REQUIRE(length(r * axis - axis) < 1e-15);
    REQUIRE(difference(r * transposed(r), Matrix3d{}) < 1e-15);
  }
  REQUIRE_THROWS_AS(rotationAbout({0, 0, 0}, 1), Error);
  REQUIRE_THROWS_AS(rotationAbout({NAN, 0, 0}, 1), Error);
}

TEST_CASE("the nearest rotation mends rounding, and refuses what is not a rotation") {
  const Matrix3d exact = rotationAbout({1, 2, 3}, 0.8);
  Matrix3d coarse = exact;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) coarse(i, j) += 1e-4 * (hashUnit(51, 3 * i + j) - 0.5);
  }
  const Matrix3d mended = nearestRotation(coarse);
  REQUIRE(difference(mended * transposed(mended), Matrix3d{}) < 1e-15);
  REQUIRE(difference(mended, exact) < 1e-4);
  REQUIRE(difference(nearestRotation(exact), exact) < 1e-15);
  REQUIRE(nearestRotation(Matrix3d{}) == Matrix3d{});

  REQUIRE_THROWS_AS(nearestRotation({{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}}), Error);
  REQUIRE_THROWS_AS(nearestRotation({{{{1.01, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}), Error);
  REQUIRE_THROWS_AS(nearestRotation({{{{1, 0.01, 0}, {0, 1, 0}, {0, 0, 1}}}}), Error);
  REQUIRE_THROWS_AS(nearestRotation({{{{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}), Error);
}
