// The mesh doctor on meshes named by their defect, on clean ones, and under changes that must not matter.
#include <catch2/catch.hpp>
#include <limits>

#include "mesh/mesh_check.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

MeshCheck checked(const Mesh& mesh) {
  Progress progress;
  return checkMesh(mesh, progress);
}

/// A tetrahedron wound outwards, moved by `offset`.
Mesh tetrahedron(Vec3d offset = {}) {
  Mesh m;
  for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)})
    m.positions.push_back(p + offset);
  m.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return m;
}

/// The same mesh with three vertices of its own for each face.
Mesh unwelded(const Mesh& mesh) {
  Mesh m;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    for (const std::uint32_t v : t) m.positions.push_back(mesh.positions[v]);
    m.triangles.push_back({first, first + 1, first + 2});
  }
  return m;
}

std::vector<std::size_t> topology(const MeshCheck& c) {
  return {c.positions,           c.edges,          c.degenerateFaces.count,    c.duplicateFaces.count,
          c.boundaryEdges.count, c.parts,          c.nonManifoldEdges.count,   c.flippedEdges.count,
          c.closedParts,         c.insideOutParts, c.nonManifoldVertices.count};
}

bool mentions(const MeshCheck& check, const std::string& part) {
  for (const std::string& line : describeFindings(check)) {
    if (line.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a clean closed mesh has no findings") {
  const MeshCheck c = checked(tetrahedron());
  CHECK(topology(c) == std::vector<std::size_t>{4, 6, 0, 0, 0, 1, 0, 0, 1, 0, 0});
  CHECK(c.eulerCharacteristic == 2);
  CHECK(c.closed());
  CHECK(describeFindings(c).empty());
  CHECK(describeShape(c) == "4 vertices, 4 faces, 1 part, closed, Euler characteristic 2");
}

TEST_CASE("faces meet by position: an unwelded mesh is as closed as a welded one") {
  const MeshCheck c = checked(unwelded(tetrahedron()));
  CHECK(topology(c) == topology(checked(tetrahedron())));
  CHECK(c.duplicatePositions.count == 8);
  CHECK(c.duplicatePositions.examples == std::vector<std::uint32_t>{3, 4, 6, 7, 8});
  CHECK(c.eulerCharacteristic == 2);
}

TEST_CASE("zero of either sign is one position") {
  Mesh m = unwelded(tetrahedron());
  for (std::size_t i = 0; i < m.positions.size(); i += 2) {
    Vec3d& p = m.positions[i];
    p = {p.x == 0 ? -0.0 : p.x, p.y == 0 ? -0.0 : p.y, p.z};
  }
  CHECK(checked(m).closed());
}

TEST_CASE("an open mesh shows its boundary") {
  Mesh m = tetrahedron();
  m.triangles.pop_back();
  const MeshCheck c = checked(m);
  CHECK(c.boundaryEdges.count == 3);
  CHECK(c.boundaryEdges.examples == std::vector<std::array<std::uint32_t, 2>>{{1, 2}, {1, 3}, {2, 3}});
  CHECK_FALSE(c.closed());
  CHECK(c.eulerCharacteristic == 1);
  CHECK(mentions(c, "3 boundary edges: the mesh is open; light enters through the holes (vertices 1-2, 1-3, 2-3)"));
}

TEST_CASE("an edge of three faces, and no Euler characteristic with it") {
  const MeshCheck c = checked(shapes::threeFacesOnEdge());
  CHECK(c.nonManifoldEdges.count == 1);
  CHECK(c.nonManifoldEdges.examples == std::vector<std::array<std::uint32_t, 2>>{{0, 1}});
  CHECK(c.boundaryEdges.count == 6);
  CHECK(c.flippedEdges.count == 0);
  CHECK(c.nonManifoldVertices.count == 0);
  CHECK(c.parts == 1);
  CHECK_FALSE(c.eulerCharacteristic);
}

TEST_CASE("bow-ties are found at their vertex, open or of cones") {
  for (const Mesh& mesh : {shapes::bowTie(), shapes::conesTipToTip()}) {
    const MeshCheck c = checked(mesh);
    CHECK(c.nonManifoldVertices.count == 1);
    CHECK(c.nonManifoldVertices.examples == std::vector<std::uint32_t>{0});
    CHECK(c.nonManifoldEdges.count == 0);
    CHECK(c.parts == 2);
    CHECK_FALSE(c.eulerCharacteristic);
  }
}

TEST_CASE("three fans at one point are one finding") {
  Mesh m = shapes::merged(shapes::merged(tetrahedron(), tetrahedron({-1, 0, 0})), tetrahedron({0, -1, 0}));
  const MeshCheck c = checked(m);
  // The origin carries three tips; (-1,1,0) and the like are apart.
  CHECK(c.nonManifoldVertices.count == 1);
  CHECK(c.parts == 3);
  CHECK(c.closedParts == 3);
}

TEST_CASE("a Moebius strip has no consistent winding") {
  const MeshCheck c = checked(shapes::moebiusStrip());
  CHECK(c.flippedEdges.count >= 1);
  CHECK(c.eulerCharacteristic == 0);
  CHECK(c.nonManifoldEdges.count == 0);
}

TEST_CASE("faces wound the wrong way are found by their edges") {
  Mesh m = tetrahedron();
  std::swap(m.triangles[3][0], m.triangles[3][1]);
  const MeshCheck c = checked(m);
  CHECK(c.flippedEdges.count == 3);
  CHECK(c.closed());
  CHECK(c.insideOutParts == 0);
  CHECK(checked(shapes::flippedFaces()).flippedEdges.count > 0);
}

TEST_CASE("duplicate faces count once for each repetition, in any winding") {
  const MeshCheck octahedron = checked(shapes::duplicateFaces());
  CHECK(octahedron.duplicateFaces.count == 8);
  CHECK(octahedron.nonManifoldEdges.count == 12);
  const Mesh sheet = shapes::doubledSheet();
  const MeshCheck c = checked(sheet);
  CHECK(c.duplicateFaces.count == sheet.triangles.size() / 2);
  CHECK(c.duplicateFaces.examples[0] == sheet.triangles.size() / 2);
}

TEST_CASE("degenerate faces: repeated index, equal positions, a point, a line") {
  const Mesh mesh = shapes::degenerateFaces();
  const MeshCheck c = checked(mesh);
  CHECK(c.degenerateFaces.count == 3);
  CHECK(c.boundaryEdges.count == 4);
  CHECK(checked(shapes::collinearFace()).degenerateFaces.count == 1);
  const MeshCheck only = checked(shapes::onlyDegenerate());
  CHECK(only.degenerateFaces.count == 2);
  CHECK(only.parts == 0);
  CHECK_FALSE(only.closed());
  CHECK_FALSE(only.eulerCharacteristic);
}

TEST_CASE("a thin triangle is not a degenerate one") {
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}};
  m.triangles = {{0, 1, 2}};
  CHECK(checked(m).degenerateFaces.count == 0);
  m.positions[2].y = 1e-17;
  CHECK(checked(m).degenerateFaces.count == 1);
}

TEST_CASE("isolated vertices are found and do not change the topology") {
  const Mesh mesh = shapes::isolatedVertices();
  const MeshCheck c = checked(mesh);
  CHECK(c.isolatedVertices.count == mesh.positions.size() - 3);
  CHECK(c.eulerCharacteristic == 1);
}

TEST_CASE("closed parts of negative volume are inside out, wherever they lie") {
  for (const Vec3d& offset : {Vec3d(0, 0, 0), Vec3d(1e6, -1e6, 1e6), Vec3d(-50, -50, -50)}) {
    CHECK(checked(tetrahedron(offset)).insideOutParts == 0);
    const MeshCheck c = checked(shapes::merged(shapes::flipped(tetrahedron(offset)), tetrahedron({9, 9, 9})));
    CHECK(c.insideOutParts == 1);
    CHECK(c.closedParts == 2);
    CHECK(mentions(c, "1 closed part is inside out"));
  }
}

TEST_CASE("a flat body has no inside to be out, however it is turned") {
  // Two squares on the same corners, cut along different diagonals: turned, they enclose rounding errors of either
  // sign.
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}};
  for (int i = 0; i < 40; ++i) {
    const Mesh turned = shapes::rotated(square, shapes::rotationAbout({1, 2.0 + i, -3}, 0.1 + i));
    const MeshCheck c = checked(shapes::translated(turned, {10, -20, 30}));
    CHECK(c.closed());
    CHECK(c.insideOutParts == 0);
  }
}

TEST_CASE("normals: missing, of other lengths, against the winding") {
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  m.triangles = {{0, 1, 2}, {2, 1, 3}};
  CHECK(checked(m).zeroNormals.count == 0);
  m.vertexNormals = {{0, 0, 1}, {0, 0, 0}, {0, 0, 1.005f}, {0, 0, -3}};
  MeshCheck c = checked(m);
  CHECK_FALSE(c.cornerNormals);
  CHECK(c.zeroNormals.examples == std::vector<std::uint32_t>{1});
  CHECK(c.nonUnitNormals.examples == std::vector<std::uint32_t>{3});
  CHECK(c.opposingNormals.count == 0);
  const Vec3f up(0, 0, 1), down(0, 0, -1), nan(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  m.cornerNormals = {up, up, nan, down, down, up};
  c = checked(m);
  CHECK(c.cornerNormals);
  CHECK(c.zeroNormals.examples == std::vector<std::uint32_t>{2});
  CHECK(c.opposingNormals.examples == std::vector<std::uint32_t>{1});
  CHECK(mentions(c, "1 face whose normals oppose its winding: the side of the normals is lit (faces 1)"));
}

TEST_CASE("findings do not depend on scale, place or the order of the file") {
  for (const Mesh& mesh : shapes::defects()) {
    const MeshCheck c = checked(mesh);
    CHECK(topology(checked(shapes::scaled(mesh, 0x1p-20))) == topology(c));
    CHECK(topology(checked(shapes::scaled(mesh, 0x1p20))) == topology(c));
    CHECK(topology(checked(shapes::shuffled(mesh, 7).mesh)) == topology(c));
  }
}

TEST_CASE("examples are the first ones, and lines say that there are more") {
  Mesh m;
  for (int i = 0; i < 7; ++i) m.positions.push_back({double(i), 0, 0});
  const MeshCheck c = checked(m);
  CHECK(c.isolatedVertices.count == 7);
  CHECK(c.isolatedVertices.examples == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  CHECK(mentions(c, "7 vertices that no face uses: kept in the output, without light (vertices 0, 1, 2, 3, 4, …)"));
  CHECK(describeShape(c) == "7 vertices, 0 faces");
}
