// Scenes: a mesh and its blockers joined, with their normals and albedos kept.
#include <catch2/catch.hpp>

#include "pipeline/scene.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

Albedo uniform(Rgb value) {
  return {Albedo::Per::mesh, {value}};
}

Albedo each(Albedo::Per per, std::size_t size, Rgb value) {
  return {per, std::vector<Rgb>(size, value)};
}

}  // namespace

TEST_CASE("the mesh comes first, blockers follow with their own vertices", "[scene]") {
  const Mesh mesh = shapes::cube(), a = shapes::tetrahedron(), b = shapes::octahedron();
  const Scene scene = joinScene(mesh, uniform({1, 1, 1}), {a, b}, {uniform({1, 1, 1}), uniform({1, 1, 1})});
  REQUIRE(scene.mesh.positions.size() == 8 + 4 + 6);
  REQUIRE(scene.mesh.triangles.size() == 12 + 4 + 8);
  CHECK(scene.mesh.source == mesh.source);
  for (std::size_t i = 0; i < 8; ++i) CHECK(scene.mesh.positions[i] == mesh.positions[i]);
  for (std::size_t f = 0; f < 8; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(scene.mesh.positions[scene.mesh.triangles[16 + f][k]] == b.positions[b.triangles[f][k]]);
    }
  }
  // One albedo for all stays one.
  CHECK(scene.albedo.per == Albedo::Per::mesh);
  CHECK(scene.albedo.values == std::vector<Rgb>{{1, 1, 1}});
}

TEST_CASE("normals are kept where a part has them, and left to be computed where not", "[scene]") {
  Mesh plain = shapes::tetrahedron(), withVertex = shapes::tetrahedron(), withCorner = shapes::tetrahedron();
  for (std::uint32_t v = 0; v < 4; ++v) withVertex.vertexNormals.push_back({float(v), 1, 0});
  for (std::uint32_t c = 0; c < 12; ++c) withCorner.cornerNormals.push_back({float(c), 0, 1});
  const Albedo white = uniform({1, 1, 1});

  const Scene vertices = joinScene(plain, white, {withVertex}, {white});
  REQUIRE(vertices.mesh.vertexNormals.size() == 8);
  CHECK(vertices.mesh.cornerNormals.empty());
  for (std::size_t v = 0; v < 4; ++v) {
    CHECK(vertices.mesh.vertexNormals[v] == Vec3f());
    CHECK(vertices.mesh.vertexNormals[4 + v] == withVertex.vertexNormals[v]);
  }

  // Corner normals win over vertex normals in a mesh; among parts, each keeps what it has.
  const Scene corners = joinScene(withVertex, white, {plain, withCorner}, {white, white});
  REQUIRE(corners.mesh.cornerNormals.size() == 36);
  for (std::size_t c = 0; c < 12; ++c) {
    CHECK(corners.mesh.cornerNormals[c] == withVertex.vertexNormals[withVertex.triangles[c / 3][c % 3]]);
    CHECK(corners.mesh.cornerNormals[12 + c] == Vec3f());
    CHECK(corners.mesh.cornerNormals[24 + c] == withCorner.cornerNormals[c]);
  }
  for (const Vec3f& n : joinScene(plain, white, {plain}, {white}).mesh.vertexNormals) CHECK(n == Vec3f());
}

TEST_CASE("the mesh's kind of albedo is kept exactly, blockers' are turned into it", "[scene]") {
  const Mesh mesh = shapes::cube(), blocker = shapes::tetrahedron();
  const Rgb red(1, 0, 0), blue(0, 0, 1);

  // Two uniform albedos: a value a face.
  const Scene two = joinScene(mesh, uniform(red), {blocker}, {uniform(blue)});
  CHECK(two.albedo.per == Albedo::Per::face);
  REQUIRE(two.albedo.values.size() == 16);
  CHECK(two.albedo.values[11] == red);
  CHECK(two.albedo.values[12] == blue);

  // The mesh by vertex, the blocker by face: each of a tetrahedron's vertices has three of the four faces.
  Albedo faces = each(Albedo::Per::face, 4, {0, 0, 0});
  faces.values[0] = {0.9f, 0.6f, 0.3f};
  const Scene vertices = joinScene(mesh, each(Albedo::Per::vertex, 8, red), {blocker}, {faces});
  CHECK(vertices.albedo.per == Albedo::Per::vertex);
  REQUIRE(vertices.albedo.values.size() == 12);
  CHECK(vertices.albedo.values[7] == red);
  for (std::uint32_t v = 0; v < 4; ++v) {
    const Triangle& t = blocker.triangles[0];
    const bool touches = t[0] == v || t[1] == v || t[2] == v;
    CHECK(vertices.albedo.values[8 + v].x == Approx(touches ? 0.3 : 0).margin(1e-7));
    CHECK(vertices.albedo.values[8 + v].z == Approx(touches ? 0.1 : 0).margin(1e-7));
  }

  // The mesh by face, the blocker by vertex: the mean over a face's corners.
  Albedo corners = each(Albedo::Per::vertex, 4, {0, 0, 0});
  corners.values[1] = {0.9f, 0.9f, 0.9f};
  const Scene byFace = joinScene(mesh, each(Albedo::Per::face, 12, blue), {blocker}, {corners});
  CHECK(byFace.albedo.per == Albedo::Per::face);
  for (std::size_t f = 0; f < 4; ++f) {
    const Triangle& t = blocker.triangles[f];
    const bool touches = t[0] == 1 || t[1] == 1 || t[2] == 1;
    CHECK(byFace.albedo.values[12 + f].x == Approx(touches ? 0.3 : 0).margin(1e-7));
  }

  // A uniform mesh beside coloured blockers keeps its value.
  const Scene beside = joinScene(mesh, uniform(red), {blocker}, {each(Albedo::Per::vertex, 4, blue)});
  CHECK(beside.albedo.per == Albedo::Per::vertex);
  CHECK(beside.albedo.values[0] == red);
  CHECK(beside.albedo.values[8] == blue);
}
