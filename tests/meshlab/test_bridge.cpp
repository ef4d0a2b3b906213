// Layers to meshes and back: deleted vertices, splits, colours, turns, new vertices; and bakes that are cancelled again
// and again.
#include <malloc.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/filters.h"
#include "meshlab_plugin/parameter_values.h"
#include "meshlab_plugin/parameters.h"

using namespace shbake;
using namespace shbake::meshlab;

namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

/// A box standing on a floor of two triangles: shadows and creases. `deleted` vertices precede its own.
MeshModel& addBox(MeshDocument& document, int deleted = 0) {
  MeshModel& layer = *document.addNewMesh("", "box", true);
  CMeshO& m = layer.cm;
  std::vector<Point3m> points(static_cast<std::size_t>(deleted), Point3m(9, 9, 9));
  for (const float x : {-2.f, 2.f}) {
    for (const float y : {-2.f, 2.f}) points.emplace_back(x, y, 0.f);
  }
  for (const float x : {-.5f, .5f}) {
    for (const float y : {-.5f, .5f}) {
      for (const float z : {0.f, 1.f}) points.emplace_back(x, y, z);
    }
  }
  Allocator::AddVertices(m, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) m.vert[i].P() = points[i];
  const int quads[6][4] = {{0, 2, 3, 1}, {5, 9, 11, 7}, {4, 5, 7, 6}, {8, 10, 11, 9}, {4, 8, 9, 5}, {6, 7, 11, 10}};
  for (const auto& q : quads) {
    for (const auto& t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      Allocator::AddFace(m, static_cast<std::size_t>(t[0] + deleted), static_cast<std::size_t>(t[1] + deleted),
                         static_cast<std::size_t>(t[2] + deleted));
    }
  }
  for (int i = 0; i < deleted; ++i) Allocator::DeleteVertex(m, m.vert[static_cast<std::size_t>(i)]);
  return layer;
}

/// Rays that take longer than the first look at the progress, after 50 ms, and are cancelled soon after it.
constexpr int kLongBake = 1 << 18;

RichParameterList bakeParameters(int rays) {
  RichParameterList parameters;
  declareParameters(Filter::bake, nullptr, parameters);
  parameters.setValue("rays", IntValue(rays));
  return parameters;
}

bool goOn(int, const std::string&) {
  return true;
}

void bakeLayer(MeshDocument& document, int rays = 64) {
  Filters().apply(Filter::bake, document, bakeParameters(rays), goOn);
}

std::vector<std::string> refineLayer(MeshDocument& document, float length, bool keepNormals = false) {
  RichParameterList parameters;
  declareParameters(Filter::refine, document.mm(), parameters);
  parameters.setValue("length", AbsPercValue(length));
  parameters.setValue("keep_normals", BoolValue(keepNormals));
  return Filters().apply(Filter::refine, document, parameters, goOn);
}

/// Gives each vertex and corner of a layer what is an affine function of its place.
void paintByPlace(MeshModel& layer) {
  layer.updateDataMask(MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_FACECOLOR |
                       MeshModel::MM_WEDGTEXCOORD);
  for (CVertexO& v : layer.cm.vert) {
    v.C() = vcg::Color4b(static_cast<unsigned char>(100 + 40 * v.cP()[0]), 60, 200, 255);
    v.Q() = 2 * v.cP()[0] - v.cP()[2];
  }
  for (CFaceO& f : layer.cm.face) {
    f.C() = vcg::Color4b(10, 20, 30, 255);
    for (int k = 0; k < 3; ++k) {
      f.WT(k).P() = {f.cV(k)->cP()[0] / 4, f.cV(k)->cP()[1] / 2};
      f.WT(k).N() = 3;
    }
  }
}

/// Checks that all vertices and corners of a layer have what paintByPlace() gave them, to rounding.
void checkPaint(const CMeshO& m) {
  for (const CVertexO& v : m.vert) {
    // Whole numbers of colours are rounded once more in between.
    CHECK(std::abs(v.cC()[0] - (100 + 40 * v.cP()[0])) <= 1);
    CHECK(v.cC()[1] == 60);
    CHECK(v.cC()[2] == 200);
    CHECK(std::abs(v.cQ() - (2 * v.cP()[0] - v.cP()[2])) < 1e-5f);
  }
  for (const CFaceO& f : m.face) {
    CHECK(f.cC()[2] == 30);
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(f.cWT(k).U() - f.cV(k)->cP()[0] / 4) < 1e-6f);
      CHECK(std::abs(f.cWT(k).V() - f.cV(k)->cP()[1] / 2) < 1e-6f);
      CHECK(f.cWT(k).N() == 3);
    }
  }
}

/// What all threads hold of the heap, with the freed pieces that they keep at hand for themselves.
std::size_t allocatedBytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("bridge: deleted vertices are left out, and found around") {
  MeshDocument document;
  const LayerMesh read = readLayer(addBox(document, 5));
  CHECK(read.mesh.positions.size() == 12);
  CHECK(read.vertexPlaces[0] == 5);
  CHECK(read.mesh.triangles[0] == Triangle{0, 2, 3});
}

TEST_CASE("bridge: creases split vertices of the layer, whose faces follow") {
  MeshDocument document;
  MeshModel& layer = addBox(document, 3);
  bakeLayer(document);
  // The box has no bottom: its lower corners have two sides, its upper ones three. The floor stays in one piece.
  CHECK(layer.cm.vn == 4 + 4 * 2 + 4 * 3);
  const StoredTransfer stored = readTransfer(layer);
  CHECK(stored.transfer.size() == 24);
  CHECK(readSurface(layer).triangles.size() == 12);
  for (const CFaceO& face : layer.cm.face) {
    // All corners of a face have its own normal now, and are where they were.
    const Point3m n = vcg::TriangleNormal(face).Normalize();
    for (int k = 0; k < 3; ++k) CHECK((face.cV(k)->cN() - n).Norm() < 1e-6f);
  }
}

TEST_CASE("bridge: a second bake replaces the first, whatever its order") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  RichParameterList large = bakeParameters(16);
  large.setValue("order", IntValue(8));
  Filters().apply(Filter::bake, document, large, goOn);
  bakeLayer(document, 16);
  CHECK(readTransfer(layer).transfer.order == 4);
  CHECK(layer.cm.vert_attr.size() < 64);
}

TEST_CASE("bridge: mirrored and turned layers are baked where they stand") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  layer.cm.Tr.SetScale(-1, 1, 1);
  bakeLayer(document);
  const BakedPly baked = readBakedLayer(layer, SavedColors::own);
  for (const Triangle& t : baked.mesh.triangles) {
    const auto& p = baked.mesh.positions;
    const Vec3d n = normalized(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    CHECK(length(n - Vec3d(baked.mesh.vertexNormals[t[0]])) < 1e-6);
  }
  // The layer's own faces still wind as they did.
  const CFaceO& floor = layer.cm.face[0];
  CHECK(vcg::TriangleNormal(floor)[2] * vcg::TriangleNormal(layer.cm.face[2])[2] > 0);
}

TEST_CASE("bridge: a preview that is taken back leaves the layer's own colours its own") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  layer.updateDataMask(MeshModel::MM_VERTCOLOR);
  for (CVertexO& v : layer.cm.vert) v.C() = vcg::Color4b(200, 100, 50, 255);
  bakeLayer(document, 16);
  const StoredTransfer stored = readTransfer(layer);
  std::vector<vcg::Color4b> grey;
  for (const CVertexO& v : layer.cm.vert) grey.push_back(v.cC());
  const std::vector<ByteColor> lit(stored.vertexPlaces.size(), ByteColor{1, 2, 3});
  for (int i = 0; i < 3; ++i) {
    showColors(layer, stored.vertexPlaces, lit);
    for (std::size_t v = 0; v < grey.size(); ++v) layer.cm.vert[v].C() = grey[v];  // as MeshLab's preview does
  }
  const Rgb own{200 / 255.f, 100 / 255.f, 50 / 255.f};
  for (const Rgb& c : readLayer(layer).mesh.vertexColors) CHECK(c == own);
  // Painting the layer makes new colours its own.
  for (CVertexO& v : layer.cm.vert) v.C() = vcg::Color4b(0, 255, 0, 255);
  for (const Rgb& c : readLayer(layer).mesh.vertexColors) CHECK(c == Rgb{0, 1, 0});
}

TEST_CASE("bridge: refining keeps vertices, colours, quality, texture coordinates and the transform") {
  MeshDocument document;
  MeshModel& layer = addBox(document, 3);
  paintByPlace(layer);
  layer.cm.Tr.SetTranslate(5, 6, 7);
  const LayerMesh before = readLayer(layer, Axes::own);
  const std::vector<std::string> lines = refineLayer(document, 0.5f);
  // Eight squares of this length along each side of the floor, and two along those of the box.
  CHECK(layer.cm.vn > 12 + 60);
  CHECK(layer.cm.vert.size() == static_cast<std::size_t>(layer.cm.vn));
  CHECK(layer.cm.Tr.ElementAt(1, 3) == 6);
  for (std::size_t v = 0; v < 12; ++v) CHECK(Vec3d(readSurface(layer).positions[v]) == before.mesh.positions[v]);
  checkPaint(layer.cm);
  CHECK_THAT(lines[0], Catch::Matchers::Contains("6 refined"));
  // The area is that of the floor, of the box's four sides and its top.
  double area = 0;
  for (const CFaceO& f : layer.cm.face) area += vcg::DoubleArea(f) / 2;
  CHECK(area == Approx(16 + 4 + 1).epsilon(1e-6));
}

TEST_CASE("bridge: normals are made anew, or kept and interpolated") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  const bool keep = GENERATE(false, true);
  for (CVertexO& v : layer.cm.vert) v.N() = Point3m(0, 0.6f, 0.8f);
  refineLayer(document, 0.5f, keep);
  const Point3m given(0, 0.6f, 0.8f), up(0, 0, 1);
  const Point3m expected = keep ? given : up;
  std::size_t onFloor = 0;
  for (const CVertexO& v : layer.cm.vert) {
    if (v.cP()[2] > 0 || std::abs(v.cP()[0]) <= 0.5f) continue;
    CHECK((v.cN() - expected).Norm() < 1e-6f);
    ++onFloor;
  }
  CHECK(onFloor > 30);
}

TEST_CASE("bridge: refining drops a bake and shows the layer's own colours again") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  const bool colored = GENERATE(false, true);
  if (colored) paintByPlace(layer);
  bakeLayer(document, 16);
  const std::vector<std::string> lines = refineLayer(document, 0.5f);
  CHECK_FALSE(holdsTransfer(layer));
  CHECK(layer.cm.vert_attr.empty());
  CHECK_THAT(lines.back(), Catch::Matchers::Contains("has been dropped"));
  CHECK(layer.hasDataMask(MeshModel::MM_VERTCOLOR) == colored);
  for (const CVertexO& v : layer.cm.vert) CHECK(v.cC()[1] == (colored ? 60 : 255));
  bakeLayer(document, 16);
  CHECK(readTransfer(layer).transfer.size() == static_cast<std::size_t>(layer.cm.vn));
}

TEST_CASE("bridge: a bake that refines gives the layer its mesh, where it stands") {
  MeshDocument document;
  MeshModel& layer = addBox(document, 2);
  paintByPlace(layer);
  layer.cm.Tr.SetScale(-2, 2, 2);
  RichParameterList parameters = bakeParameters(16);
  parameters.setValue("refine", EnumValue(1));
  parameters.setValue("refine_length", AbsPercValue(1));
  Filters().apply(Filter::bake, document, parameters, goOn);
  CHECK(layer.cm.vn > 24 + 60);
  const StoredTransfer stored = readTransfer(layer);
  CHECK(stored.transfer.size() == static_cast<std::size_t>(layer.cm.vn));
  // Faces wind as they did, and corners have the places and texture coordinates of their vertices.
  const BakedPly baked = readBakedLayer(layer, SavedColors::own);
  for (const Triangle& f : baked.mesh.triangles) {
    const auto& p = baked.mesh.positions;
    const Vec3d n = normalized(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]));
    CHECK(length(n - Vec3d(baked.mesh.vertexNormals[f[0]])) < 1e-5);
  }
  for (const CFaceO& f : layer.cm.face) {
    for (int k = 0; k < 3; ++k) CHECK(std::abs(f.cWT(k).U() - f.cV(k)->cP()[0] / 4) < 1e-6f);
  }
  for (std::size_t v = 0; v < baked.mesh.positions.size(); ++v) {
    const double x = baked.mesh.positions[v].x / -2;
    CHECK(std::abs(baked.mesh.vertexColors[v].x - static_cast<float>((100 + 40 * x) / 255)) <= 1.f / 255);
  }
  CHECK(std::ranges::count(baked.sourceVertex, kNewVertex) > 60);
}

TEST_CASE("bridge: two layers are baked in turn") {
  MeshDocument document;
  MeshModel& first = addBox(document);
  bakeLayer(document, 16);
  MeshModel& second = addBox(document);
  second.cm.Tr.SetTranslate(10, 0, 0);
  bakeLayer(document, 16);
  CHECK(readTransfer(first).transfer.size() == 24);
  CHECK(readTransfer(second).transfer.size() == 24);
}

TEST_CASE("bridge: fifty cancelled bakes leave the layer and the memory as they were") {
  MeshDocument document;
  MeshModel& layer = addBox(document);
  Filters filters;
  std::size_t allocated = 0;
  for (int i = 0; i < 50; ++i) {
    const auto cancel = [](int, const std::string&) { return false; };
    CHECK_THROWS_AS(filters.apply(Filter::bake, document, bakeParameters(kLongBake), cancel), Error);
    if (i == 9) allocated = allocatedBytes();
  }
  CHECK_FALSE(holdsTransfer(layer));
  CHECK(layer.cm.vn == 12);
  // glibc lets a thread keep 7 freed pieces of each of 64 sizes from 24 to 1032 bytes; all else has been freed. How
  // much of it the system has back is up to glibc, which keeps the end of each thread's heap.
  constexpr std::size_t kKept = 7 * 64 * (24 + 1032) / 2;
  CHECK(allocatedBytes() < allocated + (std::thread::hardware_concurrency() + 2) * kKept);
}

TEST_CASE("bridge: a filter that is called while another runs says so") {
  MeshDocument document;
  addBox(document);
  Filters filters;
  std::string refusal;
  const auto enterAgain = [&](int, const std::string&) {
    try {
      filters.apply(Filter::bake, document, bakeParameters(16), goOn);
    } catch (const Error& error) {
      refusal = error.what();
    }
    return false;
  };
  CHECK_THROWS_AS(filters.apply(Filter::bake, document, bakeParameters(kLongBake), enterAgain), Error);
  CHECK_THAT(refusal, Catch::Matchers::StartsWith("shbake is still at work"));
}

TEST_CASE("bridge: a number is what was typed, not its nearest float") {
  CHECK(typedNumber(0.01f) == 0.01);
  CHECK(typedNumber(20.5f) == 20.5);
  CHECK(typedNumber(1e-4f) == 1e-4);
  CHECK(std::isnan(typedNumber(std::nanf(""))));
}
