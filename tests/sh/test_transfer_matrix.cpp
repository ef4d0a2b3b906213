// Transfer matrices of a function.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/projection.h"
#include "sh/rotation.h"
#include "sh/support.h"
#include "sh/transfer_matrix.h"
#include "sh/zonal.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("the matrix of y_2^2 has 54 non-zero entries of 625, and is symmetric") {
  std::vector<double> b(9);
  b[index(2, 2)] = 1;
  const TransferMatrix m(5, 5, 3, b);
  int nonZero = 0;
  for (int i = 0; i < 25; ++i) {
    for (int j = 0; j < 25; ++j) {
      nonZero += m(i, j) != 0;
      REQUIRE(std::abs(m(i, j) - m(j, i)) < 1e-15);
    }
  }
  REQUIRE(nonZero == 54);
}

TEST_CASE("the matrix of one is the identity") {
  const std::vector<double> one{std::sqrt(4 * kPi)};
  const TransferMatrix m(6, 6, 1, one);
  for (int i = 0; i < 36; ++i) {
    for (int j = 0; j < 36; ++j) REQUIRE(std::abs(m(i, j) - (i == j ? 1 : 0)) < 1e-14);
  }
}

TEST_CASE("multiplying after projection is exact for light kept to the sum of degrees, and only then") {
  const int orderOut = 4, orderB = 4;
  const auto b = randomCoefficients(orderB, 120);
  REQUIRE(TransferMatrix::exactOrder(orderOut, orderB) == 7);
  const int orderLight = 10;
  const auto light = randomCoefficients(orderLight, 121);
  const auto exact = project(
      orderOut, [&](const Vec3d& d) { return valueAt(orderB, b, d) * valueAt(orderLight, light, d); },
      orderB + orderLight - 2);
  const auto shadowed = [&](int order) {
    std::vector<double> out(coefficientCount(orderOut));
    TransferMatrix(orderOut, order, orderB, b).apply(light, out);
    return out;
  };
  REQUIRE(maxDifference(shadowed(7), exact) < 1e-13);
  // Erratum: "exactly the same" does not hold for light cut to the order of the output.
  REQUIRE(maxDifference(shadowed(orderOut), exact) > 0.1);
}

TEST_CASE("proxy shadows: a cap taken out about z, wherever the light stands") {
  // Light times (1 - cap), by rotating the light so that the blocker is at z, equals the matrix of the rotated blocker.
  const int order = 4, orderLight = 7;
  const Vec3d blocker = randomDirection(122, 0);
  auto cap = zonalCap(order, 0.6);
  for (double& z : cap) z = -z;
  cap[0] += std::sqrt(4 * kPi);
  std::vector<double> atZ(16), turned(16);
  rotateZonal(cap, {0, 0, 1}, atZ);
  rotateZonal(cap, blocker, turned);
  const auto light = randomCoefficients(orderLight, 123);
  std::vector<double> direct(16), local(49), shadowed(16), back(16);
  TransferMatrix(order, orderLight, order, turned).apply(light, direct);

  // A rotation that takes the blocker to z: about the axis between them.
  const Matrix3d toZ = rotationAbout(cross(blocker, Vec3d{0, 0, 1}), angleBetween(blocker, Vec3d{0, 0, 1}));
  Rotation(orderLight, toZ).apply(light, local);
  TransferMatrix(order, orderLight, order, atZ).apply(local, shadowed);
  Rotation(order, transposed(toZ)).apply(shadowed, back);
  REQUIRE(maxDifference(back, direct) < 1e-13);
}

TEST_CASE("a cap of the whole sphere leaves no light") {
  auto cap = zonalCap(4, kPi);
  std::vector<double> none(16), out(16);
  for (double& z : cap) z = -z;
  cap[0] += std::sqrt(4 * kPi);
  rotateZonal(cap, {0, 0, 1}, none);
  TransferMatrix(4, 4, 4, none).apply(randomCoefficients(4, 124), out);
  for (const double v : out) REQUIRE(std::abs(v) < 1e-14);
}

TEST_CASE("transfer matrices refuse arrays that do not fit") {
  const std::vector<double> b(9), eight(8);
  REQUIRE_THROWS_AS(TransferMatrix(3, 3, 4, b), Error);
  REQUIRE_THROWS_AS(TransferMatrix(0, 3, 3, b), Error);
  const TransferMatrix m(2, 3, 3, b);
  std::vector<double> out(4);
  REQUIRE_THROWS_AS(m.apply(eight, out), Error);
  REQUIRE_THROWS_AS(m.apply(b, std::span<double>(out).first(3)), Error);
}
