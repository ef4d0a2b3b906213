// What is written reads back as it was, to the bit; and files appear whole or not at all.
#include <catch2/catch.hpp>
#include <thread>

#include "mesh/ply_columns.h"
#include "mesh/ply_reader.h"
#include "mesh/ply_writer.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

constexpr PlyEncoding kEncodings[] = {PlyEncoding::ascii, PlyEncoding::binaryLittleEndian,
                                      PlyEncoding::binaryBigEndian};

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0.1f, -1.5}, {1e30f, 0, 1e-9f}, {16777216, -0.0, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

TEST_CASE("PLY writer: any mesh reads back to the bit, in every encoding") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  Progress progress;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Mesh mesh = plytest::randomMesh(seed);
    for (const PlyEncoding encoding : kEncodings) {
      INFO("seed " << seed << ", " << encodingName(encoding));
      writePly(path, mesh, {encoding}, progress);
      const Mesh once = readPly(path, progress);
      CHECK(plytest::difference(mesh, once) == "");
      CHECK(once.source == path);
      const std::string bytes = plytest::readBytes(path);
      writePly(path, once, {encoding}, progress);
      CHECK(plytest::readBytes(path) == bytes);
    }
  }
}

TEST_CASE("PLY writer: header and rows exactly as meant") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  Progress progress;
  Mesh mesh = triangle();
  mesh.vertexNormals.assign(3, Vec3f(0, 0.5f, 1));
  mesh.comments = {"hello"};
  writePly(path, mesh, {PlyEncoding::ascii}, progress);
  CHECK(plytest::readBytes(path) ==
        "ply\nformat ascii 1.0\ncomment hello\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0.1 -1.5 0 0.5 1\n1e+30 0 1e-09 0 0.5 1\n16777216 -0 1 0 0.5 1\n3 0 1 2\n");
  mesh.vertexNormals.clear();
  mesh.comments.clear();
  mesh.doublePositions = true;
  writePly(path, mesh, {}, progress);
  const std::string bytes = plytest::readBytes(path);
  CHECK(bytes.starts_with("ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\n"));
  CHECK(bytes.size() == bytes.find("end_header\n") + 11 + 3 * 24 + 13);
}

TEST_CASE("PLY writer: text takes the shortest form that reads back to the same float and double") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  Progress progress;
  Mesh mesh;
  mesh.doublePositions = true;
  mesh.positions = {{0.1, 1.0 / 3, 1e22}};
  Property p{"f", ScalarType::float32, false, ScalarType::uint8, {}, {}};
  const float value = 0.1f;
  p.values.resize(4);
  std::memcpy(p.values.data(), &value, 4);
  mesh.vertexProperties = {p};
  writePly(path, mesh, {PlyEncoding::ascii}, progress);
  CHECK_THAT(plytest::readBytes(path), Catch::EndsWith("\n0.1 0.3333333333333333 1e+22 0.1\n"));
}

TEST_CASE("PLY writer: colours that no property holds are written as what they are") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  Progress progress;
  Mesh mesh = triangle();
  for (int i = 0; i < 3; ++i) {
    const float byte = static_cast<float>(100 * i + 55) / 255;
    mesh.vertexColors.push_back({byte, 0, 1});
  }
  mesh.vertexColorEncoding = ColorEncoding::srgb;
  mesh.faceColors = {{0.1f, 3, -1}};
  for (const PlyEncoding encoding : kEncodings) {
    writePly(path, mesh, {encoding}, progress);
    const Mesh back = readPly(path, progress);
    CHECK(back.vertexColors == mesh.vertexColors);
    CHECK(back.vertexColorEncoding == ColorEncoding::srgb);
    CHECK(back.faceColors == mesh.faceColors);
    CHECK(back.faceColorEncoding == ColorEncoding::linear);
    CHECK(findColumn(back.vertexProperties, "green")->type == ScalarType::uint8);
  }
  SECTION("display values between two bytes are rounded, those outside are clamped") {
    mesh.vertexColors = {{0.5f, 0.4999f, 1.0f / 600}, {-1, 2, 0.1f}, {0, 0, 0}};
    writePly(path, mesh, {PlyEncoding::ascii}, progress);
    const Mesh back = readPly(path, progress);
    CHECK(back.vertexColors[0] == Rgb(128 / 255.0f, 127 / 255.0f, 0));
    CHECK(back.vertexColors[1] == Rgb(0, 1, 26 / 255.0f));
  }
  SECTION("all 8-bit values survive") {
    mesh.positions.assign(256, Vec3d());
    mesh.vertexColors.clear();
    for (int i = 0; i < 256; ++i) mesh.vertexColors.push_back(Rgb(1, 1, 1) * (static_cast<float>(i) / 255));
    writePly(path, mesh, {}, progress);
    CHECK(readPly(path, progress).vertexColors == mesh.vertexColors);
  }
}

TEST_CASE("PLY writer: a carried property gives way to what the mesh itself knows") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  Progress progress;
  plytest::Random random(3);
  Mesh mesh = triangle();
  for (const char* name : {"x", "ny", "kept"}) {
    mesh.vertexProperties.push_back(plytest::randomColumn(random, name, ScalarType::int8, false, 3));
  }
  mesh.vertexNormals.assign(3, Vec3f(0, 1, 0));
  writePly(path, mesh, {}, progress);
  const Mesh back = readPly(path, progress);
  CHECK(back.positions == mesh.positions);
  CHECK(back.vertexNormals == mesh.vertexNormals);
  REQUIRE(back.vertexProperties.size() == 1);
  CHECK(back.vertexProperties[0] == mesh.vertexProperties[2]);
}

TEST_CASE("PLY writer: lists that their length cannot tell") {
  const plytest::Folder folder;
  Progress progress;
  Mesh mesh = triangle();
  Property list{"l", ScalarType::uint8, true, ScalarType::uint8, std::vector<std::byte>(256), {0, 0, 256, 256}};
  mesh.vertexProperties = {list};
  const auto error = errorOf([&] { writePly(folder.path("a.ply"), mesh, {}, progress); });
  REQUIRE(error);
  CHECK(error->place == "vertex 1");
  CHECK_THAT(error->cause, Catch::Contains("list l has 256 entries"));
  CHECK(folder.files() == 0);
  mesh.vertexProperties[0].countType = ScalarType::int16;
  writePly(folder.path("a.ply"), mesh, {}, progress);
  CHECK(plytest::difference(readPly(folder.path("a.ply"), progress), mesh) == "");
}

TEST_CASE("PLY writer: arrays of the wrong size are a usage error") {
  const auto refused = [](auto change) {
    Mesh mesh = triangle();
    change(mesh);
    return errorOf([&] { viewMesh(mesh); })->kind == ErrorKind::usage;
  };
  CHECK(refused([](Mesh& m) { m.vertexNormals.resize(2); }));
  CHECK(refused([](Mesh& m) { m.cornerNormals.resize(2); }));
  CHECK(refused([](Mesh& m) { m.vertexColors.resize(4); }));
  CHECK(refused([](Mesh& m) { m.faceColors.resize(2); }));
  CHECK(refused([](Mesh& m) { m.sourcePolygons.resize(2); }));
  CHECK(refused([](Mesh& m) { m.vertexProperties.resize(1); }));
  CHECK(refused([](Mesh& m) {
    m.faceProperties = {{"l", ScalarType::int8, true, ScalarType::uint8, std::vector<std::byte>(3), {0, 2}}};
  }));
}

TEST_CASE("PLY writer: nothing appears when the work is cancelled or the folder is missing") {
  const plytest::Folder folder;
  Mesh mesh = triangle();
  mesh.positions.resize(200000);
  int calls = 0;
  Progress progress([&](const ProgressState&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return ++calls < 2;
  });
  CHECK(errorOf([&] { writePly(folder.path("a.ply"), mesh, {}, progress); })->kind == ErrorKind::cancelled);
  CHECK(calls == 2);
  CHECK(folder.files() == 0);
  Progress silent;
  CHECK(errorOf([&] { writePly(folder.path("none/a.ply"), mesh, {}, silent); })->kind == ErrorKind::work);
}
