// Fans of faces: what a half-edge structure can hold of a mesh that is not manifold.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/face_fans.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

std::vector<Vec3f> floatPositions(const Mesh& mesh) {
  return std::vector<Vec3f>(mesh.positions.begin(), mesh.positions.end());
}

PackedLists cornersOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "corners", mesh.triangles.size(), "faces", 4);
  return cornersAtPositions(mesh.triangles, mesh.positions.size(), passes);
}

std::vector<std::uint32_t> oppositesOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "opposites", mesh.triangles.size(), "faces", 1);
  return oppositeHalfEdges(floatPositions(mesh), mesh.triangles, cornersOf(mesh), passes);
}

FaceFans fansOf(const Mesh& mesh) {
  Progress progress;
  Passes passes(progress, "fans", mesh.triangles.size(), "faces", 1);
  return faceFans(mesh.triangles, oppositesOf(mesh), passes);
}

// The number of fans at each vertex of a mesh without coincident vertices.
std::vector<int> fansPerVertex(const Mesh& mesh) {
  const FaceFans fans = fansOf(mesh);
  std::vector<int> counts(mesh.positions.size());
  for (std::uint32_t p : fans.position) ++counts[p];
  return counts;
}

std::vector<int> repeated(std::size_t count, int value) {
  return std::vector<int>(count, value);
}

}  // namespace

TEST_CASE("the corners at a position are all of them, in ascending order", "[face_fans]") {
  const Mesh mesh = shapes::degenerateFaces();
  const PackedLists corners = cornersOf(mesh);
  REQUIRE(corners.size() == mesh.positions.size());
  std::size_t total = 0;
  for (std::size_t p = 0; p < corners.size(); ++p) {
    for (std::uint32_t c : corners[p]) CHECK(positionAt(mesh.triangles, c) == p);
    CHECK(std::is_sorted(corners[p].begin(), corners[p].end()));
    total += corners[p].size();
  }
  CHECK(total == 3 * mesh.triangles.size());
}

TEST_CASE("opposite half-edges run the other way between the same positions", "[face_fans]") {
  for (const Mesh& mesh :
       {shapes::icosphere(2), shapes::flippedFaces(), shapes::moebiusStrip(), shapes::duplicateFaces()}) {
    INFO(mesh.source);
    const std::vector<Triangle>& faces = mesh.triangles;
    const auto opposite = oppositesOf(mesh);
    for (std::uint32_t h = 0; h < opposite.size(); ++h) {
      if (opposite[h] == kNoCorner) continue;
      CHECK(opposite[opposite[h]] == h);
      CHECK(positionAt(faces, opposite[h]) == positionAt(faces, nextCorner(h)));
      CHECK(positionAt(faces, nextCorner(opposite[h])) == positionAt(faces, h));
    }
  }
  const auto opposite = oppositesOf(shapes::icosphere(2));
  CHECK(std::count(opposite.begin(), opposite.end(), kNoCorner) == 0);
}

TEST_CASE("a manifold vertex has one fan", "[face_fans]") {
  CHECK(fansPerVertex(shapes::icosphere(2)) == repeated(162, 1));
  CHECK(fansPerVertex(shapes::corner(3)) == repeated(shapes::corner(3).positions.size(), 1));
}

TEST_CASE("fans are cut where a mesh is not manifold", "[face_fans]") {
  CHECK(fansPerVertex(shapes::bowTie()) == std::vector<int>{2, 1, 1, 1, 1, 1, 1});
  CHECK(fansPerVertex(shapes::conesTipToTip())[0] == 2);
  CHECK(fansPerVertex(shapes::threeFacesOnEdge()) == std::vector<int>{3, 3, 1, 1, 1});
  // Of a face that a mesh holds twice neither copy is the smoother continuation: every corner stands alone.
  CHECK(fansPerVertex(shapes::duplicateFaces()) == repeated(6, 8));
  // The strip's half-twist leaves one edge at which two faces are wound against each other: its two ends are cut.
  const std::vector<int> strip = fansPerVertex(shapes::moebiusStrip(24));
  CHECK(std::count(strip.begin(), strip.end(), 2) == 2);
  CHECK(std::count(strip.begin(), strip.end(), 1) == 46);
}

TEST_CASE("degenerate faces belong to no fan, all other corners to one at their position", "[face_fans]") {
  for (const Mesh& mesh : shapes::defects()) {
    INFO(mesh.source);
    const std::vector<Triangle>& faces = mesh.triangles;
    const FaceFans fans = fansOf(mesh);
    for (std::uint32_t c = 0; c < fans.ofCorner.size(); ++c) {
      if (isDegenerate(faces[c / 3])) {
        CHECK(fans.ofCorner[c] == kNoCorner);
      } else {
        REQUIRE(fans.ofCorner[c] < fans.position.size());
        CHECK(fans.position[fans.ofCorner[c]] == positionAt(faces, c));
      }
    }
  }
}

TEST_CASE("a doubled sheet has one fan for each side, joined at its rim", "[face_fans]") {
  std::vector<int> flat = repeated(16, 1);
  for (std::size_t inner : {5, 6, 9, 10}) flat[inner] = 2;
  CHECK(fansPerVertex(shapes::doubledSheet(3)) == flat);

  const Mesh bowl = shapes::bowl(0.5, 6, 12);
  Mesh doubled = bowl;
  for (const Triangle& t : bowl.triangles) doubled.triangles.push_back({t[0], t[2], t[1]});
  std::vector<int> curved = repeated(bowl.positions.size(), 2);
  std::fill_n(curved.begin(), 12, 1);
  CHECK(fansPerVertex(doubled) == curved);
}

TEST_CASE("a floor goes on under a wall that stands on its edges", "[face_fans]") {
  Mesh mesh = shapes::grid({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
  mesh.positions.push_back({1, 0, 1});
  mesh.positions.push_back({1, 1, 1});
  mesh.triangles.push_back({1, 4, 10});
  mesh.triangles.push_back({1, 10, 9});
  // The wall's foot 1-4: the floor's fan, and the wall's.
  CHECK(fansPerVertex(mesh) == std::vector<int>{1, 2, 1, 1, 2, 1, 1, 1, 1, 1, 1});
}

TEST_CASE("an edge of very many faces is cut altogether", "[face_fans]") {
  Mesh book;
  book.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 40; ++i) {
    book.positions.push_back({std::cos(0.1 * i), std::sin(0.1 * i), 0.5});
    book.triangles.push_back(i % 2 == 0 ? Triangle{0, 1, i + 2} : Triangle{1, 0, i + 2});
  }
  std::vector<int> expected = repeated(42, 1);
  expected[0] = expected[1] = 40;
  CHECK(fansPerVertex(book) == expected);
}
