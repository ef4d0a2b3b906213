// Welding by record.
#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/weld.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

WorkFrame frameOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "frame", mesh.triangles.size(), "faces", 1);
  return workFrameOf(mesh, passes);
}

Weld weldOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "weld", mesh.triangles.size(), "faces", 3);
  return weldPositions(mesh, frameOf(mesh), passes);
}

}  // namespace

TEST_CASE("vertices share an id exactly where their work positions agree", "[weld]") {
  for (const Mesh& mesh : {shapes::cubeSplit(), shapes::city(2, 1, 2), shapes::redFloorWhiteWall(4)}) {
    INFO(mesh.source);
    const WorkFrame frame = frameOf(mesh);
    const Weld weld = weldOf(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      REQUIRE(weld.ofVertex[v] < weld.positions.size());
      CHECK(weld.positions[weld.ofVertex[v]] == frame.toWork(mesh.positions[v]));
    }
    for (std::size_t p = 0; p < weld.positions.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) CHECK_FALSE(weld.positions[p] == weld.positions[q]);
    }
  }
  CHECK(weldOf(shapes::cubeSplit()).positions.size() == 8);
}

TEST_CASE("there is room behind the positions, for Embree to trace them in place", "[weld]") {
  for (const Mesh& mesh : {shapes::cubeSplit(), shapes::icosphere(4)}) {
    const Weld weld = weldOf(mesh);
    CHECK(weld.positions.capacity() == weld.positions.size() + 1);
  }
}

TEST_CASE("a difference of one unit in the last place is not welded, one of zero's sign is", "[weld]") {
  Mesh mesh;
  mesh.positions = {{-1, -1, -1}, {1, 1, 1}, {0.5, -0.0, 0}, {0.5, 0.0, -0.0}, {0.5 + 0x1p-24, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Weld weld = weldOf(mesh);
  CHECK(weld.ofVertex[2] == weld.ofVertex[3]);
  CHECK(weld.ofVertex[2] != weld.ofVertex[4]);
}

TEST_CASE("positions inside one cell of the curve are told apart whatever their order", "[weld]") {
  // Around the centre floats are finer than the curve's cells of 2^-20.
  Mesh mesh = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  for (std::uint32_t i = 0; i < 64; ++i) {
    mesh.positions.push_back({(i * 37 % 16) * 0x1p-25, 0, 0});
    mesh.triangles.push_back({0, 1, 4 + i});
  }
  const Weld weld = weldOf(mesh);
  CHECK(weld.positions.size() == 4 + 16);
  CHECK(weldOf(shapes::shuffled(mesh, 4).mesh).positions == weld.positions);
}

TEST_CASE("a vertex that no face uses has no position", "[weld]") {
  const Weld weld = weldOf(shapes::isolatedVertices());
  CHECK(weld.positions.size() == 3);
  for (std::uint32_t v : {0u, 3u, 5u}) CHECK(weld.ofVertex[v] == Weld::kUnused);
}

TEST_CASE("ids do not depend on the order of vertices and follow the curve", "[weld]") {
  const Mesh mesh = shapes::icosphere(3, 0.1);
  const Weld weld = weldOf(mesh);
  CHECK(weldOf(shapes::shuffled(mesh, 3).mesh).positions == weld.positions);
  // Along a Morton curve the eight octants follow each other, x changing fastest.
  const auto octant = [](const Vec3f& p) { return (p.x >= 0) + 2 * (p.y >= 0) + 4 * (p.z >= 0); };
  CHECK(std::is_sorted(weld.positions.begin(), weld.positions.end(),
                       [&](const Vec3f& p, const Vec3f& q) { return octant(p) < octant(q); }));
}

TEST_CASE("neighbours in number are neighbours in space", "[weld]") {
  const Weld weld = weldOf(shapes::icosphere(5));
  // 10242 points on a sphere of area 4 pi: about 0.035 apart. Along the curve the mean step stays within a few of
  // these; in random order it is 4/3.
  double sum = 0;
  for (std::size_t p = 1; p < weld.positions.size(); ++p) sum += length(weld.positions[p] - weld.positions[p - 1]);
  CHECK(sum / static_cast<double>(weld.positions.size()) < 0.1);
}
