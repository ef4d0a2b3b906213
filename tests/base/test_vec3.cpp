// Vectors: identities of the products, and angles where the cosine has lost them.
#include <catch2/catch.hpp>
#include <limits>

#include "base/hash.h"
#include "base/vec3.h"

using namespace shbake;

namespace {

Vec3d randomVector(std::uint64_t index) {
  return {hashUnit(1, index) - 0.5, hashUnit(2, index) - 0.5, hashUnit(3, index) - 0.5};
}

}  // namespace

TEST_CASE("products satisfy the right-hand rule and Lagrange's identity") {
  CHECK(cross(Vec3d(1, 0, 0), Vec3d(0, 1, 0)) == Vec3d(0, 0, 1));
  CHECK(cross(Vec3d(0, 1, 0), Vec3d(0, 0, 1)) == Vec3d(1, 0, 0));
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d a = randomVector(2 * i), b = randomVector(2 * i + 1), c = cross(a, b);
    // Components are below 1/2 and sums have at most 8 terms: rounding stays under 8 ulp of 1.
    const double tolerance = 8 * std::numeric_limits<double>::epsilon();
    REQUIRE(std::abs(dot(a, c)) < tolerance);
    REQUIRE(std::abs(dot(c, c) + dot(a, b) * dot(a, b) - dot(a, a) * dot(b, b)) < tolerance);
  }
}

TEST_CASE("normalized vectors have length 1, and zero stays zero") {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    REQUIRE(std::abs(length(normalized(randomVector(i))) - 1) < 4 * std::numeric_limits<double>::epsilon());
  }
  CHECK(normalized(Vec3f()) == Vec3f());
}

TEST_CASE("components are rounded to float, each of them") {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d v = randomVector(i) * 1000, rounded = roundedToFloat(v);
    const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
    REQUIRE(rounded == Vec3d(x, y, z));
    REQUIRE(rounded != v);
  }
}

TEST_CASE("isFinite refuses every bad component") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  CHECK(isFinite(Vec3f(1, 2, 3)));
  for (const float bad : {nan, inf, -inf}) {
    CHECK_FALSE(isFinite(Vec3f(bad, 0, 0)));
    CHECK_FALSE(isFinite(Vec3f(0, bad, 0)));
    CHECK_FALSE(isFinite(Vec3f(0, 0, bad)));
  }
}

TEST_CASE("angles keep their precision near 0 and pi, whatever the lengths") {
  const double pi = std::acos(-1.0);
  for (const double angle : {1e-12, 1e-9, 1e-3, 1.0, pi / 2, 3.0, pi - 1e-9}) {
    const Vec3d a(2, 0, 0), b = 3e5 * Vec3d(std::cos(angle), std::sin(angle), 0);
    // cos and sin round at 1e-16 absolute, which is what can be lost of the angle itself.
    CHECK(std::abs(angleBetween(a, b) - angle) < 1e-15 * std::max(1.0, angle));
  }
  CHECK(angleBetween(Vec3d(1, 0, 0), Vec3d(5, 0, 0)) == 0);
}
