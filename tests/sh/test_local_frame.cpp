// Local frames and the rotations to and from them.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/local_frame.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

std::vector<Vec3d> hardNormals() {
  std::vector<Vec3d> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (const double e : {5e-324, 1e-300, 3e-162, 1e-161, 1e-140, 1e-17, 1e-12, 1e-8, 1e-4, 1e-2}) {
    normals.push_back(normalized(Vec3d{e, -e, 1}));
    normals.push_back(normalized(Vec3d{-e, 2 * e, -1}));
  }
  for (int i = 0; i < 50; ++i) normals.push_back(randomDirection(10, i));
  for (int i = 0; i < 50; ++i) normals.push_back(randomDirection(11, i) * (1 + 2e-6 * (hashUnit(12, i) - 0.5)));
  return normals;
}

}  // namespace

TEST_CASE("local frames are right-handed, orthonormal and end at the normal") {
  for (const Vec3d& n : hardNormals()) {
    for (const double spin : {0.0, 0.7, -3.0}) {
      const LocalFrame f = localFrame(n, spin);
      REQUIRE(length(f.z - normalized(n)) < 4e-16);
      REQUIRE(std::abs(dot(f.x, f.y)) < 1e-15);
      REQUIRE(std::abs(dot(f.y, f.z)) < 1e-15);
      REQUIRE(std::abs(dot(f.x, f.z)) < 1e-15);
      REQUIRE(length(cross(f.x, f.y) - f.z) < 1e-15);
      REQUIRE(length(f.x) == Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("the spin turns the frame about the normal, counter-clockwise seen from its tip") {
  const Vec3d n = randomDirection(13, 0);
  const LocalFrame a = localFrame(n, 0), b = localFrame(n, 0.3);
  REQUIRE(length(b.x - (a.x * std::cos(0.3) + a.y * std::sin(0.3))) < 1e-15);
}

TEST_CASE("rotated coefficients are the function seen in the local axes") {
  for (const int order : {1, 2, 3, 4, 5, 9, 33, kMaxTurnOrder}) {
    const FrameRotation rotation(order);
    const auto local = randomCoefficients(order, 20);
    std::vector<double> world(local.size());
    const auto normals = hardNormals();
    for (std::size_t i = 0; i<normals.size(); i += order> 9 ? 9 : 1) {
      const double spin = 6 * hashUnit(21, i);
      rotation.toWorld(normals[i], spin, local, world);
      const LocalFrame f = localFrame(normals[i], spin);
      const Vec3d d = randomDirection(22, i);
      const Vec3d inFrame = normalized(Vec3d{dot(d, f.x), dot(d, f.y), dot(d, f.z)});
      // order^2 random coefficients of size 1 meet values whose squares sum to order^2 / 4 pi. The direction itself is
      // rounded, and degree l amplifies that l times.
      REQUIRE(std::abs(valueAt(order, world, d) - valueAt(order, local, inFrame)) < 1e-15 * (10 + order * order));
    }
  }
}

TEST_CASE("toLocal undoes toWorld, in place too") {
  for (const int order : {1, 4, 33, 65, kMaxTurnOrder}) {
    const FrameRotation rotation(order);
    const auto local = randomCoefficients(order, 30);
    for (const Vec3d& n : hardNormals()) {
      auto turned = local;
      rotation.toWorld(n, 1.1, turned, turned);
      rotation.toLocal(n, 1.1, turned, turned);
      REQUIRE(maxDifference(turned, local) < 1e-15 * (5 + order));
      if (order > 33) break;
    }
  }
}

TEST_CASE("quarter turns are orthogonal to rounding at every degree") {
  const QuarterTurn turn(kMaxTurnOrder);
  for (int l = 0; l < kMaxTurnOrder; l += l < 10 ? 1 : 13) {
    const int size = 2 * l + 1;
    std::vector<double> unit(size), forth(size), back(size);
    for (int i = 0; i < size; ++i) {
      std::fill(unit.begin(), unit.end(), 0.0);
      unit[i] = 1;
      turn.apply(l, unit.data(), forth.data());
      turn.applyInverse(l, forth.data(), back.data());
      REQUIRE(maxDifference(back, unit) < 2e-15 * (1 + l));
    }
  }
}

TEST_CASE("the quarter turn takes y to z: names fit the basis without Condon-Shortley phase") {
  const QuarterTurn turn(2);
  const double y[] = {1, 0, 0};
  double out[3];
  turn.apply(1, y, out);
  REQUIRE(out[1] == Approx(1).epsilon(1e-15));
  turn.applyInverse(1, y, out);
  REQUIRE(out[1] == Approx(-1).epsilon(1e-15));
}

TEST_CASE("frame rotations reject orders and arrays that do not fit") {
  REQUIRE_THROWS_AS(FrameRotation(0), Error);
  REQUIRE_THROWS_AS(FrameRotation(kMaxTurnOrder + 1), Error);
  const FrameRotation rotation(3);
  std::vector<double> nine(9), eight(8);
  REQUIRE_THROWS_AS(rotation.toWorld({0, 0, 1}, 0, eight, nine), Error);
  REQUIRE_THROWS_AS(rotation.toWorld({0, 0, 1}, 0, nine, eight), Error);
  REQUIRE_THROWS_AS(rotation.toLocal({0, 0, 1}, 0, nine, eight), Error);
}
