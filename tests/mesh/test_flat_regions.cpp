// Which faces lie in flat regions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.h"
#include "mesh/flat_geometry.h"
#include "mesh/flat_parts.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

std::vector<std::uint32_t> regionsOf(const Mesh& mesh, const FlatOptions& options = {}) {
  Progress progress;
  return findFlatParts(mesh, options, progress).regions.ofFace;
}

std::size_t countOf(const Mesh& mesh, const FlatOptions& options = {}) {
  const auto regions = regionsOf(mesh, options);
  std::set<std::uint32_t> different(regions.begin(), regions.end());
  different.erase(FlatRegions::kNone);
  return different.size();
}

/// A cylinder of radius 1 in `sectors` strips without its caps.
Mesh tube(int sectors) {
  Mesh mesh = shapes::lathe({{1, 0}, {1, 1}}, sectors);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.positions[t[0]].z == mesh.positions[t[1]].z && mesh.positions[t[1]].z == mesh.positions[t[2]].z;
  });
  return mesh;
}

}  // namespace

TEST_CASE("the sides of boxes are flat, however they are divided, the faces of curves are not", "[refine]") {
  CHECK(countOf(shapes::cube()) == 6);
  CHECK(countOf(shapes::cubeSplit()) == 6);
  CHECK(countOf(shapes::box({0, 0, 0}, {3, 2, 1}, {3, 4, 5})) == 6);
  CHECK(countOf(shapes::tetrahedron()) == 4);
  for (const int level : {2, 4, 6}) CHECK(countOf(shapes::icosphere(level)) == 0);
  for (const int sectors : {12, 64, 300, 2000}) CHECK(countOf(tube(sectors)) == 0);
  CHECK(countOf(shapes::lathe({{1, 0}, {1, 1}}, 64)) == 2);
}

TEST_CASE("numbers follow the first faces, and agree with the sides", "[refine]") {
  const Mesh box = shapes::box({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const auto regions = regionsOf(box);
  std::uint32_t next = 0;
  for (const std::uint32_t r : regions) {
    REQUIRE(r <= next);
    if (r == next) ++next;
  }
  CHECK(next == 6);
}

TEST_CASE("a plate beside a round edge is flat where a vertex lies all inside it", "[refine]") {
  // A plate of n x n cells that goes on, at x = 1, into a quarter of a cylinder in 18 strips of 5 degrees.
  for (const int n : {1, 2, 5}) {
    Mesh mesh = shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n);
    std::vector<std::uint32_t> edge;
    for (int j = 0; j <= n; ++j) edge.push_back(static_cast<std::uint32_t>(j * (n + 1) + n));
    for (int i = 1; i <= 18; ++i) {
      const double angle = i * 5 * std::numbers::pi / 180;
      std::vector<std::uint32_t> row;
      for (int j = 0; j <= n; ++j) {
        row.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back({1 + 0.2 * std::sin(angle), j / double(n), 0.2 * (std::cos(angle) - 1)});
      }
      for (std::size_t j = 0; j + 1 < row.size(); ++j) {
        mesh.triangles.push_back({edge[j], row[j], row[j + 1]});
        mesh.triangles.push_back({edge[j], row[j + 1], edge[j + 1]});
      }
      edge = row;
    }
    const auto regions = regionsOf(mesh);
    const auto plate = static_cast<std::ptrdiff_t>(2 * n * n);
    const std::uint32_t expected = n == 1 ? FlatRegions::kNone : 0;
    CHECK(std::count(regions.begin(), regions.begin() + plate, expected) == plate);
    CHECK(std::count(regions.begin() + plate, regions.end(), FlatRegions::kNone) ==
          static_cast<std::ptrdiff_t>(regions.size()) - plate);
  }
}

TEST_CASE("a strip so thin that rounding turns its faces joins what lies on both sides of it", "[refine]") {
  // Rows of an inclined plane at these heights, in the precision of a file: the strip is eight units high.
  Mesh mesh;
  const int n = 40;
  const std::vector<double> rows{1, 1.25, 1.25 + 1e-6, 1.5};
  for (const double y : rows) {
    for (int i = 0; i <= n; ++i) {
      const double x = 1 + i / double(n);
      mesh.positions.push_back(roundedToFloat({x, y, 0.3 * x + 0.7 * y}));
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j + 1 < static_cast<int>(rows.size()); ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const Vec3d up = normalized(Vec3d(-0.3, -0.7, 1));
  int turned = 0;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    turned += angleBetween(FaceShape(mesh, f).normal(), up) > std::numbers::pi / 180;
  }
  REQUIRE(turned == 2 * n);
  const auto regions = regionsOf(mesh);
  CHECK(std::count(regions.begin(), regions.end(), 0u) == static_cast<std::ptrdiff_t>(regions.size()));
}

TEST_CASE("bends beyond the crease angle, and those where normals are split, end a region", "[refine]") {
  Mesh roof;
  const double slope = std::tan(20 * std::numbers::pi / 180);
  roof.positions = {{-1, 0, 0}, {0, 0, slope}, {1, 0, 0}, {-1, 1, 0}, {0, 1, slope}, {1, 1, 0}};
  roof.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  CHECK(countOf(roof) == 0);
  CHECK(countOf(roof, {.creaseDegrees = 39}) == 2);
  CHECK(countOf(roof, {.creaseDegrees = 41}) == 0);
  CHECK(countOf(roof, {.flatDegrees = 41}) == 1);
  const double sine = std::sin(20 * std::numbers::pi / 180), cosine = std::cos(20 * std::numbers::pi / 180);
  for (int c = 0; c < 12; ++c) roof.cornerNormals.push_back(Vec3f(Vec3d(c < 6 ? -sine : sine, 0, cosine)));
  CHECK(countOf(roof) == 2);
  roof.cornerNormals.assign(12, Vec3f(0, 0, 1));
  CHECK(countOf(roof) == 0);
}

TEST_CASE("angles out of range are refused", "[refine]") {
  for (const double bad : {-1.0, 46.0, std::nan("")}) CHECK_THROWS_AS(regionsOf(shapes::cube(), {bad, 50}), Error);
  for (const double bad : {-1.0, 181.0, std::nan("")}) CHECK_THROWS_AS(regionsOf(shapes::cube(), {1, bad}), Error);
}
