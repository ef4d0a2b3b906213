// Layers to meshes and back: deleted vertices, splits, colours, turns; and bakes that are cancelled again and again.
#include <catch2/catch.hpp>
#include <fstream>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/filters.h"
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
  declareParameters(Filter::bake, parameters);
  parameters.setValue("rays", IntValue(rays));
  return parameters;
}

bool goOn(int, const std::string&) {
  return true;
}

void bakeLayer(MeshDocument& document, int rays = 64) {
  Filters().apply(Filter::bake, document, bakeParameters(rays), goOn);
}

std::size_t residentBytes() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * 4096;
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
  std::size_t settled = 0;
  for (int i = 0; i < 50; ++i) {
    const auto cancel = [](int, const std::string&) { return false; };
    CHECK_THROWS_AS(filters.apply(Filter::bake, document, bakeParameters(kLongBake), cancel), Error);
    if (i == 9) settled = residentBytes();
  }
  CHECK_FALSE(holdsTransfer(layer));
  CHECK(layer.cm.vn == 12);
  // A new thread may find another heap once. Forty bakes that kept a fortieth of their table of directions each,
  // order^2 floats a ray, would exceed this.
  CHECK(residentBytes() < settled + std::size_t(kLongBake) * 16 * sizeof(float));
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
