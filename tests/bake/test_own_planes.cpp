// Rays along the faces of their own position: which ones rounding may let meet them, and that none is blocked by them.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bake/own_planes.h"
#include "bake/ray_scene.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Vec3f kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

/// Uniform in -1..1.
double drawn(std::uint64_t seed, std::uint64_t i) {
  return 2 * hashUnit(seed, i) - 1;
}

/// A fan of faces about position 0, which no other faces are near: edges of lengths `shortest`..1 at any angles.
LightingPoints fan(int faces, double shortest, std::uint64_t seed) {
  LightingPoints points;
  points.positions.push_back(Vec3f(Vec3d(drawn(seed, 0), drawn(seed, 1), drawn(seed, 2))));
  for (std::uint32_t k = 0; k < std::uint32_t(faces); ++k) {
    const std::uint64_t i = 4 * k + 4;
    for (const std::uint64_t end : {i, i + 2}) {
      const double length = std::pow(shortest, hashUnit(seed + 1, end));
      points.positions.push_back(Vec3f(Vec3d(points.positions[0]) + randomDirection(seed, end) * length));
    }
    // The position is each of the three corners in turn: the sum of the edges is rounded differently.
    const Triangle t{0, 2 * k + 1, 2 * k + 2};
    points.faces.push_back({t[k % 3], t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  points.positionFaces.starts.assign(points.positions.size() + 1, std::uint32_t(faces));
  points.positionFaces.starts[0] = 0;
  for (std::uint32_t k = 0; k < std::uint32_t(faces); ++k) points.positionFaces.items.push_back(k);
  for (std::uint32_t k = 1; k < points.positions.size(); ++k) {
    points.positionFaces.items.push_back((k - 1) / 2);
    points.positionFaces.starts[k + 1] = std::uint32_t(points.positionFaces.items.size());
  }
  return points;
}

/// A unit direction that rises above the plane of face `f` of a fan by about 10^-9..1 radians.
Vec3f alongFace(const LightingPoints& points, std::uint32_t f, std::uint64_t seed, std::uint64_t i) {
  const Triangle& t = points.faces[f];
  const Vec3d a(points.positions[t[0]]), b(points.positions[t[1]]), c(points.positions[t[2]]);
  const Vec3d normal = normalized(cross(b - a, c - a)), u = normalized(b - a), v = cross(normal, u);
  const double phi = kPi * drawn(seed, 3 * i), rise = std::pow(1e-9, hashUnit(seed, 3 * i + 1));
  return Vec3f(normalized(u * std::cos(phi) + v * std::sin(phi) + normal * (rise * (i % 2 == 0 ? 1 : -1))));
}

/// The distance along d at which the float arithmetic of Moeller and Trumbore puts the plane of a face.
float floatDistance(const LightingPoints& points, const Triangle& t, const Vec3f& origin, const Vec3f& d) {
  const Vec3f &v0 = points.positions[t[0]], &v1 = points.positions[t[1]], &v2 = points.positions[t[2]];
  const Vec3f normal = cross(v2 - v0, v0 - v1);
  return std::abs(dot(normal, v0 - origin)) / std::abs(dot(normal, d));
}

}  // namespace

TEST_CASE("every ray that rounding puts before its own face is known to be close to it", "[own_planes]") {
  long met = 0, flagged = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LightingPoints points = fan(7, seed % 2 == 0 ? 1e-3 : 0.5, seed);
    for (const float near : {1e-7f, 1e-5f}) {
      OwnPlanes planes;
      planes.setPosition(points, 0, kX, kY, kZ, near);
      for (std::uint64_t i = 0; i < 100; ++i) {
        std::array<float, 16> x{}, y{}, z{};
        for (std::size_t k = 0; k < 16; ++k) {
          const Vec3f d = alongFace(points, std::uint32_t(i % 7), seed, 16 * i + k);
          x[k] = d.x, y[k] = d.y, z[k] = d.z;
        }
        const unsigned close = planes.close(x.data(), y.data(), z.data(), 0xFFFF);
        for (std::size_t k = 0; k < 16; ++k) {
          const bool isClose = (close >> k & 1) != 0;
          for (const Triangle& t : points.faces) {
            const bool isMet = floatDistance(points, t, points.positions[0], {x[k], y[k], z[k]}) > near;
            met += isMet;
            if (isMet) REQUIRE(isClose);
          }
          flagged += isClose;
          ++asked;
        }
      }
    }
  }
  INFO(met << " of " << asked << " directions meet their own face by rounding, " << flagged << " are close");
  CHECK(met > 1000);
}

TEST_CASE("few directions are close, and none that is not asked for", "[own_planes]") {
  // Faces with edges of 1/2..1 and rays that begin 1e-4 away: a strip of 16 half ulp * L^3 / near on both sides of each
  // plane, L <= 2 and twice the area 1/4 on average, over which directions are spread by the sine of their height.
  const LightingPoints points = fan(6, 0.5, 3);
  OwnPlanes planes;
  planes.setPosition(points, 0, kX, kY, kZ, 1e-4f);
  long close = 0;
  constexpr long kGroups = 4096;
  for (std::uint64_t g = 0; g < kGroups; ++g) {
    std::array<float, 16> x{}, y{}, z{};
    for (std::size_t k = 0; k < 16; ++k) {
      const Vec3d d = randomDirection(9, 16 * g + k);
      x[k] = float(d.x), y[k] = float(d.y), z[k] = float(std::abs(d.z));
    }
    const unsigned all = planes.close(x.data(), y.data(), z.data(), 0xFFFF);
    const auto asked = std::uint16_t(hashBits(5, g));
    REQUIRE(planes.close(x.data(), y.data(), z.data(), asked) == (all & asked));
    for (unsigned k = 0; k < 16; ++k) close += all >> k & 1;
  }
  double expected = 0;
  for (const Triangle& t : points.faces) {
    const Vec3d a(points.positions[t[0]]), b(points.positions[t[1]]), c(points.positions[t[2]]);
    expected += 16 * kHalfUlp * 8 / 1e-4 / length(cross(b - a, c - a));
  }
  CHECK(double(close) / (16 * kGroups) < expected + 5 * std::sqrt(expected / (16 * kGroups)));
}

TEST_CASE("a fan alone never blocks a ray from its own position", "[own_planes][ray_scene]") {
  Progress progress;
  int rays = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const LightingPoints points = fan(7, seed % 2 == 0 ? 1e-3 : 0.5, seed);
    const RayScene scene(points, kInfinity, Parallel(1), progress);
    if (!scene.contacts().isClear(0)) continue;
    const RayScene::BuffersPtr buffers = scene.makeBuffers();
    std::vector<float> x(1024), y(1024), z(1024);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3f d = alongFace(points, std::uint32_t(i % 7), seed, i);
      x[i] = d.x, y[i] = d.y, z[i] = d.z;
    }
    const std::vector<std::uint16_t> active(64, 0xFFFF);
    std::vector<std::uint16_t> hit(64), front(64);
    std::vector<Hit> hits(x.size());
    const RayScene::Rays all{0, 64, x.data(), y.data(), z.data(), kX, kY, kZ, active.data()};
    scene.occluded(all, *buffers, hit.data());
    for (const std::uint16_t mask : hit) REQUIRE(mask == 0);
    scene.closest(all, *buffers, hit.data(), front.data(), hits.data());
    for (const std::uint16_t mask : hit) REQUIRE(mask == 0);
    rays += 1024;
  }
  CHECK(rays >= 1024 * 40);
}
