// Colours, normals, texture coordinates and other properties through a refinement.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <set>

#include "base/hash.h"
#include "mesh/column.h"
#include "mesh/refine_attributes.h"
#include "refine_checks.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

template <class T>
std::vector<T> valuesOf(const Property& p) {
  std::vector<T> values(p.values.size() / sizeof(T));
  std::memcpy(values.data(), p.values.data(), p.values.size());
  return values;
}

Mesh square(int n) {
  return shapes::grid({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, n, n);
}

}  // namespace

TEST_CASE("colours of vertices that change affinely do so on new ones, and others within their faces", "[refine]") {
  Mesh mesh = square(4);
  for (const Vec3d& p : mesh.positions) {
    mesh.vertexColors.push_back(Rgb(Vec3d(p.x / 4, p.y / 4, 0.5)));
  }
  const Mesh affine = refinedTo(mesh, 0.2).mesh;
  REQUIRE(affine.vertexColors.size() == affine.positions.size());
  for (std::size_t v = 0; v < affine.positions.size(); ++v) {
    CHECK(affine.vertexColors[v].x == Approx(affine.positions[v].x / 4).margin(1e-6));
    CHECK(affine.vertexColors[v].y == Approx(affine.positions[v].y / 4).margin(1e-6));
    CHECK(affine.vertexColors[v].z == 0.5f);
  }

  // Any colours: each face interpolates on its own, so that all its edges must stay edges.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const float value = static_cast<float>(hashUnit(1, v));
    mesh.vertexColors[v] = Rgb(value, 1 - value, 0.25f);
  }
  const RefinedMesh coloured = refinedTo(mesh, 0.2);
  checkKept(mesh, coloured);
  for (std::size_t f = 0; f < coloured.mesh.triangles.size(); ++f) {
    const std::uint32_t source = coloured.sourceFace[f];
    std::array<Vec3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.triangles[source][k]];
    for (const std::uint32_t v : coloured.mesh.triangles[f]) {
      const Blend blend = blendAt(corners, coloured.mesh.positions[v]);
      // Inside the source: no edge of the input was crossed.
      CHECK(blend.weightB >= -1e-6);
      CHECK(blend.weightC >= -1e-6);
      CHECK(blend.weightB + blend.weightC <= 1 + 1e-6);
      const auto& [a, b, c] = mesh.triangles[source];
      const double red = blend.apply(mesh.vertexColors[a].x, mesh.vertexColors[b].x, mesh.vertexColors[c].x);
      CHECK(coloured.mesh.vertexColors[v].x == Approx(red).margin(1e-6));
    }
  }
}

TEST_CASE("8-bit colours stay 8-bit ones, in the mesh's colours and in the property alike", "[refine]") {
  Mesh mesh = square(1);
  const std::vector<std::uint8_t> red{0, 255, 17, 200};
  mesh.vertexProperties.push_back(scalarColumn("red", red));
  mesh.vertexColorEncoding = ColorEncoding::srgb;
  for (const std::uint8_t r : red) mesh.vertexColors.emplace_back(static_cast<float>(r) / 255, 0.0f, 1.0f);
  const Mesh refined = refinedTo(mesh, 0.5).mesh;
  const auto bytes = valuesOf<std::uint8_t>(refined.vertexProperties[0]);
  REQUIRE(bytes.size() == refined.positions.size());
  std::set<std::uint8_t> different;
  for (std::size_t v = 0; v < bytes.size(); ++v) {
    CHECK(refined.vertexColors[v].x * 255 == Approx(bytes[v]).margin(1e-4));
    different.insert(bytes[v]);
  }
  CHECK(different.size() > 20);
}

TEST_CASE("colours and properties of faces belong to what becomes of them", "[refine]") {
  Mesh mesh = square(4);
  std::vector<std::int32_t> label;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto cell = static_cast<std::int32_t>(f / 2);
    label.push_back(cell);
    mesh.sourcePolygons.push_back(static_cast<std::uint32_t>(cell));
    mesh.faceColors.emplace_back(0.0f, static_cast<float>(cell % 2), 1.0f);
  }
  mesh.faceProperties.push_back(scalarColumn("label", label));
  mesh.faceProperties.push_back(listColumn("pair", std::vector<std::int16_t>(2 * label.size(), 7), 2));
  const RefinedMesh refined = refinedTo(mesh, 0.2);
  checkKept(mesh, refined);
  const auto labels = valuesOf<std::int32_t>(refined.mesh.faceProperties[0]);
  REQUIRE(labels.size() == refined.mesh.triangles.size());
  REQUIRE(refined.mesh.faceColors.size() == labels.size());
  REQUIRE(refined.mesh.faceProperties[1].listStarts.size() == labels.size() + 1);
  CHECK(refined.mesh.faceProperties[1].listStarts.back() == 2 * labels.size());
  for (std::size_t f = 0; f < labels.size(); ++f) {
    Vec3d centre;
    for (const std::uint32_t v : refined.mesh.triangles[f]) centre += refined.mesh.positions[v] * (1.0 / 3);
    const int cell = static_cast<int>(centre.y) * 4 + static_cast<int>(centre.x);
    CHECK(labels[f] == cell);
    CHECK(refined.mesh.sourcePolygons[f] == static_cast<std::uint32_t>(cell));
    CHECK(refined.mesh.faceColors[f] == Rgb(0.0f, static_cast<float>(cell % 2), 1.0f));
  }
}

TEST_CASE("normals of corners are interpolated by direction and keep their length", "[refine]") {
  Mesh mesh = square(1);
  const auto normalAt = [](const Vec3d& p) { return Vec3f(normalized(Vec3d(p.x - 2, p.y - 2, 4)) * 3.0); };
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) mesh.cornerNormals.push_back(normalAt(mesh.positions[v]));
  }
  const RefinedMesh refined = refinedTo(mesh, 0.4);
  REQUIRE(refined.mesh.cornerNormals.size() == 3 * refined.mesh.triangles.size());
  // The four normals are one affine function, (x - 2, y - 2, 4) times a number.
  for (std::size_t c = 0; c < refined.mesh.cornerNormals.size(); ++c) {
    const Vec3d n(refined.mesh.cornerNormals[c]);
    const Vec3d expected(normalAt(refined.mesh.positions[refined.mesh.triangles[c / 3][c % 3]]));
    CHECK(length(n - expected) < 1e-5);
  }
  Mesh vertices = square(1);
  for (const Vec3d& p : vertices.positions) vertices.vertexNormals.push_back(normalAt(p));
  const Mesh smooth = refinedTo(vertices, 0.4).mesh;
  for (std::size_t v = 0; v < smooth.positions.size(); ++v) {
    CHECK(length(Vec3d(smooth.vertexNormals[v]) - Vec3d(normalAt(smooth.positions[v]))) < 1e-5);
  }
}

TEST_CASE("texture coordinates of corners follow their faces, across a seam too", "[refine]") {
  Mesh mesh = square(2);
  // The left half is mapped by (x, y), the right half by (10 - x, y).
  std::vector<float> texture;
  for (const Triangle& t : mesh.triangles) {
    double middle = 0;
    for (const std::uint32_t v : t) middle += mesh.positions[v].x / 3;
    for (const std::uint32_t v : t) {
      const auto x = static_cast<float>(mesh.positions[v].x), y = static_cast<float>(mesh.positions[v].y);
      texture.insert(texture.end(), {middle < 2 ? x : 10 - x, y});
    }
  }
  mesh.faceProperties.push_back(listColumn("texcoord", texture, 6));
  const RefinedMesh refined = refinedTo(mesh, 0.3);
  checkKept(mesh, refined);
  const auto uv = valuesOf<float>(refined.mesh.faceProperties[0]);
  REQUIRE(uv.size() == 6 * refined.mesh.triangles.size());
  for (std::size_t f = 0; f < refined.mesh.triangles.size(); ++f) {
    const Triangle& t = refined.mesh.triangles[f];
    double middle = 0;
    for (const std::uint32_t v : t) middle += refined.mesh.positions[v].x / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d p = refined.mesh.positions[t[k]];
      CHECK(uv[6 * f + 2 * k] == Approx(middle < 2 ? p.x : 10 - p.x).margin(1e-5));
      CHECK(uv[6 * f + 2 * k + 1] == Approx(p.y).margin(1e-5));
    }
  }
}

TEST_CASE("both sides of a seam of vertices are divided alike, each with its own vertices", "[refine]") {
  Mesh mesh =
      shapes::merged(shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), shapes::grid({1, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  std::vector<float> s;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    s.push_back(static_cast<float>(mesh.positions[v].x) + (v < 4 ? 0.0f : 100.0f));
  }
  mesh.vertexProperties.push_back(scalarColumn("s", s));
  const RefinedMesh refined = refinedTo(mesh, 0.1);
  checkKept(mesh, refined);
  const auto values = valuesOf<float>(refined.mesh.vertexProperties[0]);
  std::multiset<double> left, right;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const Vec3d& p = refined.mesh.positions[v];
    CHECK(std::fmod(values[v], 100) == Approx(p.x).margin(1e-4));
    if (p.x == 1) (values[v] < 50 ? left : right).insert(p.y);
  }
  CHECK(left.size() == 9);
  CHECK(left == right);
}

TEST_CASE("lists of vertices come from the heaviest corner, and whole numbers are rounded", "[refine]") {
  Mesh mesh = square(1);
  mesh.vertexProperties.push_back(listColumn("ids", std::vector<std::int32_t>{1, 1, 2, 2, 3, 3, 4, 4}, 2));
  mesh.vertexProperties.push_back(scalarColumn("height", std::vector<double>{1, 2, 3, 4}));
  mesh.vertexProperties.push_back(scalarColumn("count", std::vector<std::int16_t>{-3, 0, 0, 3}));
  const std::vector<Blend> blends{{0, 1, 2, 0.2, 0.5}, {0, 3, 0, 0.25, 0}};
  const std::vector<Vec3d> positions{{1, 1, 0}, {2, 2, 0}};
  appendVertices(mesh, blends, positions);
  CHECK(mesh.positions.size() == 6);
  CHECK(valuesOf<std::int32_t>(mesh.vertexProperties[0]) ==
        std::vector<std::int32_t>{1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 1, 1});
  CHECK(mesh.vertexProperties[0].listStarts == std::vector<std::uint64_t>{0, 2, 4, 6, 8, 10, 12});
  CHECK(valuesOf<double>(mesh.vertexProperties[1])[4] == Approx(1 + 0.2 * 1 + 0.5 * 2));
  CHECK(valuesOf<std::int16_t>(mesh.vertexProperties[2])[4] == -1);  // -3 + 0.2 * 3 + 0.5 * 3 = -0.9
  CHECK(valuesOf<std::int16_t>(mesh.vertexProperties[2])[5] == -2);  // -3 + 0.25 * 6 = -1.5, to even
}

TEST_CASE("attributes of faces that stay are copied bit for bit", "[refine]") {
  Mesh mesh = shapes::degenerateFaces();
  std::vector<float> texture;
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    mesh.cornerNormals.emplace_back(0.1f * static_cast<float>(c), 1e-30f, -0.0f);
    texture.insert(texture.end(), {static_cast<float>(c) / 3, -0.0f});
  }
  mesh.faceProperties.push_back(listColumn("texcoord", texture, 6));
  CHECK(sameMesh(refinedTo(mesh, 100).mesh, mesh));
}
