// Fans of faces: what a half-edge structure can hold of a mesh that is not manifold.
#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/face_fans.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

// The number of fans at each vertex of a mesh without coincident vertices.
std::vector<int> fansPerVertex(const Mesh& mesh) {
  const PackedLists corners = cornersAtPositions(mesh.triangles, mesh.positions.size());
  const FaceFans fans = faceFans(mesh.triangles, oppositeHalfEdges(mesh.triangles, corners));
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
  const PackedLists corners = cornersAtPositions(mesh.triangles, mesh.positions.size());
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
    const auto opposite = oppositeHalfEdges(faces, cornersAtPositions(faces, mesh.positions.size()));
    for (std::uint32_t h = 0; h < opposite.size(); ++h) {
      if (opposite[h] == kNoCorner) continue;
      CHECK(opposite[opposite[h]] == h);
      CHECK(positionAt(faces, opposite[h]) == positionAt(faces, nextCorner(h)));
      CHECK(positionAt(faces, nextCorner(opposite[h])) == positionAt(faces, h));
    }
  }
  const Mesh closed = shapes::icosphere(2);
  const auto opposite =
      oppositeHalfEdges(closed.triangles, cornersAtPositions(closed.triangles, closed.positions.size()));
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
  // No edge of a mesh that holds every face twice has exactly two faces: every corner stands alone.
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
    const FaceFans fans = faceFans(faces, oppositeHalfEdges(faces, cornersAtPositions(faces, mesh.positions.size())));
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
