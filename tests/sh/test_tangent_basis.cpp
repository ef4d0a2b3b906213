// Irradiance in three tangent-space directions.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/ao_cone.h"
#include "sh/irradiance.h"
#include "sh/support.h"
#include "sh/tangent_basis.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("the three directions are unit vectors at 45 degrees, pairwise 1/4, not orthonormal") {
  for (int i = 0; i < 3; ++i) {
    const Vec3d& d = kTangentDirections[i];
    REQUIRE(length(d) == Approx(1).epsilon(1e-15));
    REQUIRE(std::acos(d.z) == Approx(kPi / 4).epsilon(1e-15));
    REQUIRE(dot(d, kTangentDirections[(i + 1) % 3]) == Approx(0.25).epsilon(1e-14));
  }
  REQUIRE(kTangentDirections[0].x < 0);
  REQUIRE(kTangentDirections[1].y < 0);
}

TEST_CASE("the four values are irradiance in world directions") {
  const auto light = randomCoefficients(5, 160);
  const LocalFrame frame = localFrame(randomDirection(161, 0), 0.4);
  const TangentIrradiance t = tangentIrradiance(5, light, frame);
  const double h = std::sqrt(0.5);
  REQUIRE(std::abs(t.front[0] - irradianceAt(5, light, normalized(frame.z * h - frame.x * h))) < 1e-14);
  REQUIRE(std::abs(t.through - irradianceAt(5, light, -frame.z)) < 1e-14);
}

TEST_CASE("interpolation has the four values, and every value of light of order 2") {
  const auto light = randomCoefficients(5, 162);
  const LocalFrame frame = localFrame(randomDirection(163, 0), 0);
  const TangentIrradiance t = tangentIrradiance(5, light, frame);
  for (int i = 0; i < 3; ++i) REQUIRE(std::abs(interpolate(t, kTangentDirections[i]) - t.front[i]) < 1e-14);
  REQUIRE(std::abs(interpolate(t, {0, 0, -1}) - t.through) < 1e-14);
  const TangentIrradiance smooth = tangentIrradiance(2, light, frame);
  for (int i = 0; i < 20; ++i) {
    const Vec3d n = randomDirection(164, i);
    const Vec3d world = normalized(frame.x * n.x + frame.y * n.y + frame.z * n.z);
    REQUIRE(std::abs(interpolate(smooth, n) - irradianceAt(2, light, world)) < 1e-14);
  }
}

TEST_CASE("cones of 45 degrees never see below the surface") {
  // Light from 1 degree below the horizon, at order 33: whole hemispheres take it in, 45 degree cones hardly do, since
  // what little they see is the light's own blur.
  const int order = 33;
  const double below = -std::sin(kPi / 180);
  const Vec3d d{-std::sqrt(1 - below * below), 0, below};
  auto light = basisAt(order, d);
  const LocalFrame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double whole = tangentIrradiance(order, light, frame).front[0];
  // A delta light of radiance integral 1: irradiance is the cosine to the first direction, cos 46 degrees.
  REQUIRE(whole == Approx(std::cos(46 * kPi / 180)).epsilon(0.01));
  // The middle of the cone is 46 degrees away, one degree beyond its edge; 10 degrees beyond, the blur is gone.
  const double deeper = -std::sin(20 * kPi / 180);
  light = basisAt(order, {-std::sqrt(1 - deeper * deeper), 0, deeper});
  const TangentIrradiance narrow = tangentIrradiance(order, light, frame, std::sqrt(0.5));
  REQUIRE(std::abs(narrow.front[0]) < 0.05);
  REQUIRE(tangentIrradiance(order, light, frame).front[0] > 0.4);
}

TEST_CASE("a white sky through cones of 45 degrees gives half its irradiance") {
  const std::vector<double> white{std::sqrt(4 * kPi)};
  const LocalFrame frame = localFrame(randomDirection(165, 0), 0);
  const TangentIrradiance t = tangentIrradiance(1, white, frame, std::sqrt(0.5));
  for (const double v : t.front) REQUIRE(v == Approx(kPi / 2).epsilon(1e-14));
  REQUIRE_THROWS_AS(tangentIrradiance(2, white, frame), Error);
}
