// Matching by position and normal agrees with trying all pairs, at any scale and place.
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/test_ply_files.h"
#include "transfer/point_matcher.h"

using namespace shbake;
using plytest::Random;

namespace {

constexpr double kScales[] = {1e-6, 1, 1e6};

Vec3f unitVector(Random& random) {
  const double z = 2 * random.unit() - 1, phi = 6.283185307179586 * random.unit();
  const double r = std::sqrt(1 - z * z);
  return Vec3f(Vec3d(r * std::cos(phi), r * std::sin(phi), z));
}

PointMatcher matcherOf(const std::vector<Vec3d>& positions, const std::vector<Vec3f>& normals) {
  Progress progress;
  Passes passes(progress, "matcher", positions.size(), "points", 2);
  return PointMatcher(positions, normals, passes);
}

}  // namespace

TEST_CASE("Point matcher: every point finds itself, whatever the scale and shift") {
  for (const double scale : kScales) {
    for (const double shift : {0.0, 1.0, 1e6}) {
      Random random(1);
      std::vector<Vec3d> positions;
      std::vector<Vec3f> normals;
      for (int i = 0; i < 2000; ++i) {
        const Vec3d p(random.unit(), random.unit(), 0.3 * random.unit());
        positions.push_back((p + Vec3d(shift, -shift, 0)) * scale);
        normals.push_back(unitVector(random));
      }
      const PointMatcher matcher = matcherOf(positions, normals);
      std::size_t wrong = 0;
      for (std::uint32_t i = 0; i < positions.size(); ++i) wrong += matcher.find(positions[i], normals[i], 0) != i;
      CHECK(wrong == 0);
      // Just under the distance still matches, one and a half does not; by chance no other point is that near.
      const Vec3d step(matcher.distance(), 0, 0);
      CHECK(matcher.find(positions[7] + step * 0.999, normals[7], 0) == 7u);
      CHECK(matcher.find(positions[7] - step * 0.999, normals[7], 0) == 7u);
      if (shift < 1e6) CHECK_FALSE(matcher.find(positions[7] + step * 1.5, normals[7], 0));
    }
  }
}

TEST_CASE("Point matcher: agrees with trying all pairs where many are near") {
  Random random(2);
  std::vector<Vec3d> positions = {{0, 0, 0}, {1, 1, 1}};  // the box; all others crowd into a few times the distance
  std::vector<Vec3f> normals(2, Vec3f(0, 0, 1));
  const auto crowded = [&] { return Vec3d(0.5 + 2e-5 * random.unit(), 0.5 + 2e-5 * random.unit(), 0.5); };
  const auto tilted = [&] { return Vec3f(normalized(Vec3d(2e-4 * random.unit(), 0, 1))); };
  for (int i = 0; i < 150; ++i) {
    positions.push_back(crowded());
    normals.push_back(tilted());
  }
  const PointMatcher matcher = matcherOf(positions, normals);
  CHECK(matcher.distance() == Approx(PointMatcher::kRelativeDistance));
  std::size_t matched = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = crowded();
    const Vec3f n = tilted();
    std::optional<std::uint32_t> best;
    double nearest = 1e9;
    for (std::uint32_t k = 0; k < positions.size(); ++k) {
      const Vec3d d = positions[k] - p;
      const double apart = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      const bool near =
          apart <= matcher.distance() && angleBetween(Vec3d(normals[k]), Vec3d(n)) <= PointMatcher::kAngle;
      if (near && apart < nearest) {
        nearest = apart;
        best = k;
      }
    }
    CHECK(matcher.find(p, n, 0) == best);
    matched += best ? 1 : 0;
  }
  CHECK(matched > 300);
  CHECK(matched < 900);
}

TEST_CASE("Point matcher: at a crease the normal decides, among twins the preferred number") {
  const Vec3d p(1, 2, 3);
  const std::vector<Vec3d> positions = {{0, 0, 0}, p, p, p, p, {4, 4, 4}};
  const std::vector<Vec3f> normals = {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const PointMatcher matcher = matcherOf(positions, normals);
  CHECK(matcher.find(p, {1, 0, 0}, 9) == 2u);
  CHECK(matcher.find(p, {0, 0, 1}, 9) == 1u);
  CHECK(matcher.find(p, {0, 0, 1}, 2) == 1u);
  CHECK(matcher.find(p, {0, 0, 1}, 4) == 4u);
  CHECK_FALSE(matcher.find(p, {0, 1, 0}, 9));
  CHECK_FALSE(matcher.find(p, {0, 0, -1}, 9));
  // 1e-4 radians are allowed: half of that matches, twice does not.
  CHECK(matcher.find(p, {5e-5f, 0, 1}, 9) == 1u);
  CHECK_FALSE(matcher.find(p, {2e-4f, 0, 1}, 9));
}

TEST_CASE("Point matcher: nothing, one point, and places far outside") {
  const std::vector<Vec3d> none;
  const std::vector<Vec3f> noNormals;
  CHECK_FALSE(matcherOf(none, noNormals).find({0, 0, 0}, {0, 0, 1}, 0));
  const std::vector<Vec3d> origin = {{0, 0, 0}};
  const std::vector<Vec3f> up = {{0, 0, 1}};
  const PointMatcher matcher = matcherOf(origin, up);
  CHECK(matcher.find({0, 0, 0}, {0, 0, 1}, 0) == 0u);
  CHECK_FALSE(matcher.find({1e-30, 0, 0}, {0, 0, 1}, 0));
  for (const double far : {1e18, 1e300, -1e300}) CHECK_FALSE(matcher.find({far, 0, far}, {0, 0, 1}, 0));
}
