// The frame in which geometry is compared: centre, power-of-two scale, exactness.
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/work_frame.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

Mesh segment(Vec3d from, Vec3d to) {
  Mesh mesh;
  mesh.positions = {from, to};
  mesh.triangles = {{0, 1, 0}};
  return mesh;
}

WorkFrame frameOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "frame", mesh.triangles.size(), "faces", 1);
  return workFrameOf(mesh, passes);
}

}  // namespace

TEST_CASE("the scale is a power of two that brings the largest half-extent into (0.5, 1]", "[work_frame]") {
  for (double extent : {1e-300, 1e-6, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 1024.0, 1e6, 1e300}) {
    INFO(extent);
    const WorkFrame frame = frameOf(segment({-extent, 0, 0}, {extent, extent / 8, 0}));
    int exponent = 0;
    CHECK(std::frexp(frame.scale, &exponent) == 0.5);
    CHECK(extent * frame.scale > 0.5);
    CHECK(extent * frame.scale <= 1);
  }
}

TEST_CASE("the frame looks only at vertices that faces use", "[work_frame]") {
  const WorkFrame frame = frameOf(shapes::isolatedVertices());
  CHECK(frame.centre == Vec3d(0.5, 0.5, 0));
  CHECK(frame.scale == 2);
  CHECK(frame.toWork({1, 0, 0}) == Vec3f(1, -1, 0));
}

TEST_CASE("a mesh without extent, and ones at the ends of the doubles' range, have a finite frame", "[work_frame]") {
  CHECK(frameOf(segment({3, 4, 5}, {3, 4, 5})).scale == 1);
  for (double extent : {1e-320, 1.7e308}) {
    INFO(extent);
    const WorkFrame frame = frameOf(segment({-extent, 0, 0}, {extent, 0, 0}));
    CHECK(std::isfinite(frame.scale));
    CHECK(frame.scale > 0);
    CHECK(frame.toWork({extent, 0, 0}).x > 0);
    CHECK(frame.toWork({extent, 0, 0}).x <= 1);
  }
}

TEST_CASE("the way back from work units is exact where the way there was", "[work_frame]") {
  const WorkFrame frame = frameOf(segment({10, 20, 30}, {16, 24, 38}));
  REQUIRE(frame.centre == Vec3d(13, 22, 34));
  REQUIRE(frame.scale == 0.25);
  CHECK(frame.toFile({0.75, -0.5, 1}) == Vec3d(16, 20, 38));
  for (const Vec3d& p : {Vec3d(10, 20, 30), Vec3d(16, 24, 38), Vec3d(11.5, 23.25, 37)}) {
    CHECK(frame.toFile(Vec3d(frame.toWork(p))) == p);
  }
}

TEST_CASE("floats around an exact centre keep their bits up to the scale", "[work_frame]") {
  const WorkFrame frame = frameOf(segment({-3, -3, -3}, {3, 3, 3}));
  CHECK(frame.scale == 0.25);
  const float third = 1.0f / 3;
  CHECK(frame.toWork(Vec3d(third, -third, 3)) == Vec3f(third / 4, -third / 4, 0.75f));
}

TEST_CASE("work coordinates hold no negative zero", "[work_frame]") {
  const WorkFrame frame = frameOf(segment({-1, -1, -1}, {1, 1, 1}));
  const Vec3f zero = frame.toWork({-0.0, -1e-320, 0.0});
  for (float component : {zero.x, zero.y, zero.z}) CHECK_FALSE(std::signbit(component));
}
