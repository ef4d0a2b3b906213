// The whole way from a mesh to its baked transfer.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.h"
#include "pipeline/bake_mesh.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

constexpr double kPi = std::numbers::pi;

BakeMeshOptions options(TransferKind kind, int rays = 64) {
  BakeMeshOptions o;
  o.bake.kind = kind;
  o.bake.order = 3;
  o.bake.rays = rays;
  o.bake.bounces = 2;
  return o;
}

BakedMesh bake(const Mesh& mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& o) {
  const Parallel parallel(1);
  Progress progress;
  return bakeMesh(mesh, blockers, o, parallel, progress);
}

template <class T>
Property column(const char* name, ScalarType type, const std::vector<T>& values) {
  Property property;
  property.name = name;
  property.type = type;
  property.values.resize(values.size() * sizeof(T));
  std::memcpy(property.values.data(), values.data(), property.values.size());
  return property;
}

template <class T>
std::vector<T> valuesOf(const Property& property) {
  std::vector<T> values(property.values.size() / sizeof(T));
  std::memcpy(values.data(), property.values.data(), property.values.size());
  return values;
}

bool mentions(const std::vector<std::string>& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("a smooth mesh keeps its vertices one to one, with normals and facts", "[bake_mesh]") {
  Mesh mesh = shapes::icosphere(2);
  mesh.source = "some/folder/ball.ply";
  const BakedMesh baked = bake(mesh, {}, options(TransferKind::shadowed));
  CHECK(baked.mesh.positions == mesh.positions);
  CHECK(baked.mesh.triangles == mesh.triangles);
  CHECK(baked.sourceVertex.empty());
  REQUIRE(baked.transfer.size() == mesh.positions.size());
  CHECK(baked.transfer.visibility == std::vector<float>(mesh.positions.size(), 1.0f));
  REQUIRE(baked.mesh.vertexNormals.size() == mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    // The mean of five or six faces around a vertex of a sphere whose faces span 0.3 rad.
    CHECK(double(dot(baked.mesh.vertexNormals[v], Vec3f(mesh.positions[v]))) > std::cos(0.3));
  }
  CHECK(baked.facts.kind == TransferKind::shadowed);
  CHECK(baked.facts.rays == 64);
  CHECK(baked.facts.sampler == "cosine-fibonacci");
  CHECK(baked.facts.source == "ball.ply");
  CHECK(baked.facts.sourceVertices == mesh.positions.size());
  CHECK(baked.facts.lightingPoints == mesh.positions.size());
  CHECK_FALSE(baked.facts.version.empty());
  CHECK(baked.albedoNote == "uniform 0.8");
  CHECK(bake(mesh, {}, options(TransferKind::unshadowed)).facts.sampler == "closed-form");
}

TEST_CASE("split vertices are appended and carry what their source carries", "[bake_mesh]") {
  Mesh mesh = shapes::cube();
  std::vector<std::int32_t> numbers(8);
  for (std::int32_t v = 0; v < 8; ++v) numbers[std::size_t(v)] = 100 + v;
  mesh.vertexProperties.push_back(column("number", ScalarType::int32, numbers));
  std::vector<std::uint16_t> items;
  std::vector<std::uint64_t> starts{0};
  for (std::uint16_t v = 0; v < 8; ++v) {
    items.insert(items.end(), v % 3, std::uint16_t(v * 10));
    starts.push_back(items.size());
  }
  Property list = column("list", ScalarType::uint16, items);
  list.isList = true;
  list.listStarts = starts;
  mesh.vertexProperties.push_back(list);
  mesh.vertexColors.resize(8);
  for (std::size_t v = 0; v < 8; ++v) mesh.vertexColors[v] = {float(v) / 10, 0.5f, 0.5f};
  mesh.faceProperties.push_back(column("face", ScalarType::uint8, std::vector<std::uint8_t>(12, 7)));

  const BakedMesh baked = bake(mesh, {}, options(TransferKind::shadowed));
  // Every corner of a cube meets three sides: 24 points, 16 of them appended.
  REQUIRE(baked.mesh.positions.size() == 24);
  REQUIRE(baked.sourceVertex.size() == 24);
  CHECK(baked.facts.lightingPoints == 24);
  CHECK(baked.facts.sourceVertices == 8);
  CHECK(baked.transfer.size() == 24);
  const auto carried = valuesOf<std::int32_t>(baked.mesh.vertexProperties[0]);
  const Property& lists = baked.mesh.vertexProperties[1];
  REQUIRE(carried.size() == 24);
  REQUIRE(lists.listStarts.size() == 25);
  const auto listItems = valuesOf<std::uint16_t>(lists);
  for (std::uint32_t v = 0; v < 24; ++v) {
    const std::uint32_t source = baked.sourceVertex[v];
    if (v < 8) CHECK(source == v);
    CHECK(baked.mesh.positions[v] == mesh.positions[source]);
    CHECK(baked.mesh.vertexColors[v] == mesh.vertexColors[source]);
    CHECK(carried[v] == std::int32_t(100 + source));
    CHECK(lists.listStarts[v + 1] - lists.listStarts[v] == source % 3);
    for (std::uint64_t i = lists.listStarts[v]; i < lists.listStarts[v + 1]; ++i) CHECK(listItems[i] == source * 10);
  }
  CHECK(baked.mesh.faceProperties == mesh.faceProperties);
  // Faces keep their order and winding, and each refers to vertices of its own normal.
  for (std::size_t f = 0; f < 12; ++f) {
    const auto corner = [&](std::size_t k) { return baked.mesh.positions[baked.mesh.triangles[f][k]]; };
    const Vec3d normal = normalized(cross(corner(1) - corner(0), corner(2) - corner(0)));
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(baked.sourceVertex[baked.mesh.triangles[f][k]] == mesh.triangles[f][k]);
      CHECK(dot(Vec3d(baked.mesh.vertexNormals[baked.mesh.triangles[f][k]]), normal) > 0.999);
    }
  }
}

TEST_CASE("blockers occlude and reflect but get no vertices", "[bake_mesh]") {
  const Mesh floor = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
  const Mesh ceiling = shapes::flipped(shapes::grid({-3, -3, 1}, {6, 0, 0}, {0, 6, 0}, 6, 6));
  const BakedMesh open = bake(floor, {}, options(TransferKind::interreflected));
  const BakedMesh covered = bake(floor, {ceiling}, options(TransferKind::interreflected, 256));
  const BakedMesh direct = bake(floor, {ceiling}, options(TransferKind::shadowed, 256));
  CHECK(covered.mesh.positions == floor.positions);
  CHECK(covered.mesh.triangles == floor.triangles);
  CHECK(covered.sourceVertex.empty());
  CHECK(covered.transfer.size() == 9);
  CHECK(covered.facts.lightingPoints == 9);
  CHECK(covered.facts.sourceVertices == 9);
  for (std::size_t v = 0; v < 9; ++v) {
    CHECK(open.transfer.visibility[v] == 1);
    CHECK(covered.transfer.visibility[v] < 0.2f);
    // Light comes in by way of floor and ceiling.
    CHECK(covered.transfer.at(v, 0)[0] > direct.transfer.at(v, 0)[0]);
  }
  // Sheets of one scene and a mesh with a blocker are the same thing.
  const BakedMesh joined = bake(shapes::merged(floor, ceiling), {}, options(TransferKind::interreflected, 256));
  for (std::size_t v = 0; v < 9; ++v) {
    const auto a = covered.transfer.at(v, 0), b = joined.transfer.at(v, 0);
    CHECK(std::equal(a.begin(), a.end(), b.begin()));
  }
}

TEST_CASE("blockers have their own colours, and split vertices of theirs stay out", "[bake_mesh]") {
  const Mesh floor = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
  const Mesh redBox = shapes::colored(shapes::box({0.2, 0.2, 0}, {0.6, 0.6, 0.5}), {1, 0, 0});
  const BakedMesh baked = bake(floor, {redBox}, options(TransferKind::interreflected, 256));
  CHECK(baked.mesh.positions == floor.positions);
  CHECK(baked.transfer.channels == 3);
  // The floor's middle sees the box's red sides beside the sky.
  const double red = double(baked.transfer.at(4, 0)[0]), green = double(baked.transfer.at(4, 1)[0]);
  CHECK(red > green);
  CHECK(green > 0);
}

TEST_CASE("a fit changes the transfer that is written, and the facts tell of it", "[bake_mesh]") {
  const Mesh mesh =
      shapes::merged(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 2, 2), shapes::grid({}, {0, 1, 0}, {0, 0, 1}, 2, 2));
  const Mesh blocker = shapes::grid({0.6, 0.2, 0.1}, {0.3, 0, 0}, {0, 0, 0.5});
  BakeMeshOptions o = options(TransferKind::shadowed, 256);
  const BakedMesh plain = bake(mesh, {blocker}, o);
  CHECK_FALSE(plain.facts.fit.any());
  CHECK(!plain.fit);
  o.fit.kind = FitKind::surface;
  const BakedMesh fitted = bake(mesh, {blocker}, o);
  // Each vertex is a lighting point of its own, but those of the crease are two.
  CHECK(fitted.facts.fit.fittedPoints == plain.facts.lightingPoints);
  CHECK(fitted.facts.fit.after < fitted.facts.fit.before);
  CHECK(fitted.fit->reason == "asked for");
  CHECK(fitted.transfer.error == plain.transfer.error);
  CHECK(fitted.transfer.visibility == plain.transfer.visibility);
  CHECK(fitted.transfer.coefficients != plain.transfer.coefficients);
  o.fit.kind = FitKind::automatic;
  o.bake.kind = TransferKind::unshadowed;
  const BakedMesh open = bake(mesh, {blocker}, o);
  CHECK_FALSE(open.facts.fit.any());
  CHECK(open.fit->reason == "unshadowed transfer has a closed form, which is kept");
  o.fit.samplesPerPoint = 0;
  CHECK_THROWS_WITH(bake(mesh, {blocker}, o), Catch::Contains("samples per point 0"));
}

TEST_CASE("isolated vertices keep their place with zero transfer, and are told", "[bake_mesh]") {
  const Mesh mesh = shapes::isolatedVertices();
  const BakedMesh baked = bake(mesh, {}, options(TransferKind::shadowed));
  REQUIRE(baked.transfer.size() == mesh.positions.size());
  CHECK(baked.mesh.positions == mesh.positions);
  std::size_t isolated = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const bool used = std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                                  [&](const Triangle& t) { return t[0] == v || t[1] == v || t[2] == v; });
    isolated += !used;
    for (const float value : baked.transfer.at(v, 0)) {
      if (!used) CHECK(value == 0);
    }
    CHECK((baked.transfer.at(v, 0)[0] > 0) == used);
  }
  CHECK(mentions(baked.warnings, std::to_string(isolated) + " vertices belong to no face"));
}

TEST_CASE("isolated vertices of blockers are nobody's concern", "[bake_mesh]") {
  const BakedMesh baked = bake(shapes::cube(), {shapes::isolatedVertices()}, options(TransferKind::shadowed));
  CHECK_FALSE(mentions(baked.warnings, "belong to no face"));
}

TEST_CASE("warnings of the mesh come through", "[bake_mesh]") {
  Mesh mesh = shapes::cube();
  mesh.warnings = {"the file said something odd"};
  CHECK(mentions(bake(mesh, {}, options(TransferKind::unshadowed)).warnings, "the file said something odd"));
}

TEST_CASE("what cannot be baked is an Error that names the mesh", "[bake_mesh]") {
  Mesh empty = shapes::cube();
  empty.triangles.clear();
  empty.source = "cloud.ply";
  for (const std::vector<Mesh>& blockers : {std::vector<Mesh>{}, std::vector<Mesh>{shapes::tetrahedron()}}) {
    try {
      bake(empty, blockers, options(TransferKind::shadowed));
      FAIL("no Error was thrown");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::work);
      CHECK(error.parts().file == "cloud.ply");
    }
  }
  BakeMeshOptions wrong = options(TransferKind::shadowed);
  wrong.bake.order = 0;
  CHECK_THROWS_AS(bake(shapes::cube(), {}, wrong), Error);
}

TEST_CASE("too little memory is told, and changes nothing", "[bake_mesh]") {
  BakeMeshOptions o = options(TransferKind::interreflected);
  const BakedMesh rich = bake(shapes::corner(4), {}, o);
  o.bake.memory = 1;
  const BakedMesh poor = bake(shapes::corner(4), {}, o);
  CHECK(poor.transfer.coefficients == rich.transfer.coefficients);
  CHECK(mentions(poor.warnings, "traced again"));
  CHECK_FALSE(mentions(rich.warnings, "traced again"));
}

TEST_CASE("cancelling ends the bake with an Error of its own kind, soon", "[bake_mesh]") {
  const Mesh mesh = shapes::inwardSphere(5);
  const Parallel parallel(2);
  Progress progress([](const ProgressState& state) { return state.stage != "tracing"; });
  const auto start = std::chrono::steady_clock::now();
  try {
    // 10,242 points of 65,536 rays: minutes, if it ran on.
    bakeMesh(mesh, {}, options(TransferKind::interreflected, 65536), parallel, progress);
    FAIL("no Error was thrown");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::cancelled);
  }
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 20);
}

TEST_CASE("white light on an open mesh sends out the albedo that the note names", "[bake_mesh]") {
  BakeMeshOptions o = options(TransferKind::interreflected);
  o.albedo.uniform = {0.25f, 0.5f, 1};
  const BakedMesh baked = bake(shapes::icosphere(1), {}, o);
  REQUIRE(baked.transfer.channels == 3);
  const double albedo[] = {0.25, 0.5, 1};
  for (std::size_t v = 0; v < baked.transfer.size(); ++v) {
    for (int c = 0; c < 3; ++c) {
      // One rounding to float, one product.
      CHECK(std::sqrt(4 * kPi) * double(baked.transfer.at(v, c)[0]) == Approx(albedo[c]).epsilon(0x1p-23));
    }
  }
  CHECK(baked.albedoNote == "uniform 0.25,0.5,1");
}
