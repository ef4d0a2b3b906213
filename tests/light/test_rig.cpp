// Local rigs.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/rig.h"
#include "light/simplex_weights.h"
#include "light/support.h"
#include "light/synthetic.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

Vec3d randomPoint(std::uint64_t seed, std::uint64_t i) {
  return {hashUnit(seed, 3 * i), hashUnit(seed, 3 * i + 1), hashUnit(seed, 3 * i + 2)};
}

double affine(const Vec3d& p) {
  return 2 + 3 * p.x - p.y + 0.5 * p.z;
}

/// Samples at these places whose light is an affine function of place.
LightRig affineRig(const std::vector<Vec3d>& places, RigMethod method = RigMethod::barycentric) {
  std::vector<LightSample> samples;
  for (const Vec3d& p : places) samples.push_back({p, constantLight(2, Vec3d{1, 2, 3} * affine(p))});
  RigOptions options;
  options.method = method;
  return LightRig(std::move(samples), options);
}

double valueAt(const LightRig& rig, const Vec3d& place) {
  return rig.at(place).coefficients[0].x / std::sqrt(4 * kPi);
}

double total(const std::vector<RigWeight>& weights) {
  double sum = 0;
  for (const RigWeight& w : weights) sum += w.weight;
  return sum;
}

const std::vector<Vec3d> kCube{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};

}  // namespace

TEST_CASE("weights are positive and sum to one, equal samples give that sample") {
  for (const RigMethod method : {RigMethod::inverseDistance, RigMethod::barycentric}) {
    std::vector<LightSample> samples;
    const Light light = randomLight(3, 1);
    for (int i = 0; i < 30; ++i) samples.push_back({randomPoint(2, i), light});
    const LightRig rig(samples, {method, 10});
    for (int i = 0; i < 200; ++i) {
      const Vec3d place = 3 * randomPoint(3, i) - Vec3d{1, 1, 1};
      const std::vector<RigWeight> weights = rig.weights(place);
      for (const RigWeight& w : weights) REQUIRE(w.weight > 0);
      REQUIRE(total(weights) == Approx(1).epsilon(1e-14));
      REQUIRE(maxDifference(rig.at(place), light) < 1e-14);
    }
  }
}

TEST_CASE("inverse distances have their power, and a sample's own place takes it alone") {
  const LightRig rig = affineRig({{0, 0, 0}, {3, 0, 0}, {0, 9, 0}}, RigMethod::inverseDistance);
  const std::vector<RigWeight> at = rig.weights({1, 0, 0});
  REQUIRE(at[1].weight / at[0].weight == Approx(std::pow(0.5, 10)).epsilon(1e-13));
  REQUIRE(rig.weights({3, 0, 0}) == std::vector<RigWeight>{{1, 1.0}});
  // Far away and very near, no power overflows.
  REQUIRE(total(rig.weights({1e200, 0, 0})) == Approx(1));
  REQUIRE(rig.weights({1e-200, 0, 0})[0].weight == 1);
}

TEST_CASE("samples in one place share its weight") {
  for (const RigMethod method : {RigMethod::inverseDistance, RigMethod::barycentric}) {
    std::vector<LightSample> samples{{{0, 0, 0}, Light(1)}, {{1, 0, 0}, Light(1)}, {{0, 0, 0}, Light(1)}};
    const LightRig rig(samples, {method, 10});
    REQUIRE(rig.weights({0, 0, 0}) == std::vector<RigWeight>{{0, 0.5}, {2, 0.5}});
  }
}

TEST_CASE("an affine field is reproduced inside the hull") {
  std::vector<Vec3d> scattered = kCube;
  for (int i = 0; i < 40; ++i) scattered.push_back(randomPoint(4, i));
  for (const auto& places : {kCube, scattered}) {
    const LightRig rig = affineRig(places);
    for (int i = 0; i < 300; ++i) {
      const Vec3d place = randomPoint(5, i);
      REQUIRE(valueAt(rig, place) == Approx(affine(place)).epsilon(1e-12));
      REQUIRE(rig.weights(place).size() <= 4);
    }
    for (const Vec3d& corner : places) REQUIRE(valueAt(rig, corner) == Approx(affine(corner)).epsilon(1e-13));
  }
}

TEST_CASE("outside of the hull its nearest point counts") {
  const LightRig rig = affineRig(kCube);
  for (int i = 0; i < 200; ++i) {
    const Vec3d place = 5 * randomPoint(6, i) - Vec3d{2, 2, 2};
    const Vec3d nearest{std::clamp(place.x, 0.0, 1.0), std::clamp(place.y, 0.0, 1.0), std::clamp(place.z, 0.0, 1.0)};
    REQUIRE(valueAt(rig, place) == Approx(affine(nearest)).epsilon(1e-12));
  }
}

TEST_CASE("samples in a plane, on a line or in one place are enough") {
  const LightRig plane = affineRig({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.6, 0}});
  REQUIRE(valueAt(plane, {0.25, 0.5, 7}) == Approx(affine({0.25, 0.5, 0})).epsilon(1e-12));
  REQUIRE(valueAt(plane, {2, 0.5, 7}) == Approx(affine({1, 0.5, 0})).epsilon(1e-12));
  const LightRig line = affineRig({{0, 0, 0}, {2, 2, 2}, {1, 1, 1}});
  REQUIRE(valueAt(line, {1.5, 1.5, 1.5}) == Approx(affine({1.5, 1.5, 1.5})).epsilon(1e-12));
  REQUIRE(valueAt(line, {-4, 0, 0}) == Approx(affine({0, 0, 0})).epsilon(1e-12));
  const LightRig point = affineRig({{3, 3, 3}});
  REQUIRE(valueAt(point, {0, 0, 0}) == Approx(affine({3, 3, 3})).epsilon(1e-14));
}

TEST_CASE("the scene's scale and place do not change weights") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Vec3d> places;
    for (int i = 0; i < 20; ++i) places.push_back(scale * (randomPoint(7, i) + Vec3d{1, 2, 3}));
    const LightRig rig(
        [&] {
          std::vector<LightSample> samples;
          for (const Vec3d& p : places)
            samples.push_back({p, constantLight(1, Vec3d{1, 1, 1} * affine(p * (1 / scale)))});
          return samples;
        }(),
        {RigMethod::barycentric, 10});
    const Vec3d middle{1.5, 2.5, 3.5};
    REQUIRE(valueAt(rig, scale * middle) == Approx(affine(middle)).epsilon(1e-11));
  }
}

TEST_CASE("the nearest point of a triangle is found, flat ones included") {
  const Vec3d a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0};
  REQUIRE(nearestOnTriangle({0.5, 0.5, 3}, a, b, c) == std::array{0.5, 0.25, 0.25});
  REQUIRE(nearestOnTriangle({2, 2, 1}, a, b, c) == std::array{0.0, 0.5, 0.5});
  REQUIRE(nearestOnTriangle({-1, -1, 0}, a, b, c) == std::array{1.0, 0.0, 0.0});
  REQUIRE(nearestOnTriangle({1, 1, 0}, a, b, b) == std::array{0.5, 0.5, 0.0});
  REQUIRE(nearestOnTriangle({1, 1, 0}, a, a, a)[0] == 1);
}

TEST_CASE("rigs that cannot be are refused") {
  REQUIRE_THROWS_AS(LightRig({}, {}), Error);
  REQUIRE_THROWS_AS(LightRig({{{NAN, 0, 0}, Light(1)}}, {}), Error);
  REQUIRE_THROWS_AS(LightRig({{{0, 0, 0}, Light(1)}}, {RigMethod::inverseDistance, 0}), Error);
  REQUIRE_THROWS_AS(affineRig(kCube).weights({0, INFINITY, 0}), Error);
}

TEST_CASE("a rig is turned as a whole") {
  std::vector<LightSample> samples;
  for (int i = 0; i < 6; ++i) samples.push_back({randomPoint(8, i), randomLight(3, 20 + i)});
  const sh::Matrix3d turn = sh::rotationAbout({1, 2, -1}, 0.7);
  const Vec3d about{0.4, -2, 1};
  for (const RigMethod method : {RigMethod::inverseDistance, RigMethod::barycentric}) {
    const LightRig rig(samples, {method, 3}), turned = rotated(rig, turn, about);
    CHECK(turned.options().method == method);
    for (int i = 0; i < 50; ++i) {
      const Vec3d place = randomPoint(9, i);
      const Light expected = rotated(rig.at(place), turn);
      REQUIRE(maxDifference(turned.at(about + turn * (place - about)), expected) < 1e-12);
    }
  }
}
