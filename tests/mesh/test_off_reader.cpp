// OFF: each letter of the header, colours of both kinds, and each mistake at its line.
#include <catch2/catch.hpp>

#include "base/memory.h"
#include "mesh/off_reader.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;
using plytest::Folder;

namespace {

Mesh readText(const std::string& text) {
  const Folder folder;
  Progress progress;
  return readOff(folder.write("mesh.off", text), progress);
}

Error::Parts errorOfText(const std::string& text) {
  const auto error = errorOf([&] { readText(text); });
  INFO(text);
  REQUIRE(error);
  return *error;
}

float floatAt(const Property& p, std::size_t i) {
  float value = 0;
  REQUIRE(p.values.size() >= (i + 1) * sizeof(float));
  std::memcpy(&value, p.values.data() + i * sizeof(float), sizeof(float));
  return value;
}

const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("OFF: triangles and polygons, with comments, blank lines and edges counted or not") {
  const std::string faces = "3 0 1 2\n4 0 1 2 3\n";
  const std::vector<Triangle> expected = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
  for (const char* head :
       {"OFF\n4 2 0\n", "OFF 4 2 5\n", "OFF\n4 2\n", "# c\n\nOFF # c\n# c\n4 2 0 # c\n\n", "4 2 0\n"}) {
    INFO(head);
    const Mesh m = readText(std::string(head) + kSquare + "\n# faces\n" + faces);
    CHECK(m.positions == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(m.triangles == expected);
    CHECK(m.sourcePolygons == std::vector<std::uint32_t>{0, 1, 1});
    CHECK(m.faceColors.empty());
    CHECK(m.warnings.empty());
  }
}

TEST_CASE("OFF: vertices may share lines, since only colours end with one") {
  const Mesh m = readText("OFF 3 1 0 \r\n0 0 0 1 0 0\r\n0 1\r\n0\r\n3 0 1\r\n2\r\n");
  CHECK(m.positions == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("OFF: vertex normals, colours and texture coordinates by the header's letters") {
  const Mesh n = readText("NOFF\n1 0 0\n1 2 3 0 0 2\n");
  CHECK(n.vertexNormals == std::vector<Vec3f>{{0, 0, 2}});
  const Mesh c = readText("COFF\n2 0 0\n1 2 3 255 51 0 255\n4 5 6 0 0 0 255\n");
  CHECK(c.vertexColors == std::vector<Rgb>{{1, 0.2f, 0}, {0, 0, 0}});
  CHECK(c.vertexColorEncoding == ColorEncoding::srgb);
  const Mesh f = readText("COFF\n2 0 0\n1 2 3 1.0 0.5 0.0\n4 5 6 0 0 1 1\n");
  CHECK(f.vertexColors == std::vector<Rgb>{{1, 0.5f, 0}, {0, 0, 1}});
  CHECK(f.vertexColorEncoding == ColorEncoding::linear);
  for (const char* letters : {"STCN", "STNC"}) {
    const Mesh all = readText(std::string(letters) + "OFF\n1 0 0\n1 2 3 0 0 1 0.5 0.25 0 1 0.125 0.75\n");
    CHECK(all.vertexNormals == std::vector<Vec3f>{{0, 0, 1}});
    CHECK(all.vertexColors == std::vector<Rgb>{{0.5f, 0.25f, 0}});
    REQUIRE(all.vertexProperties.size() == 2);
    CHECK(all.vertexProperties[0].name == "texture_u");
    CHECK(floatAt(all.vertexProperties[0], 0) == 0.125f);
    CHECK(floatAt(all.vertexProperties[1], 0) == 0.75f);
  }
  const Mesh st = readText("STOFF 2 0 0\n1 2 3 0.5 1\n4 5 6 0.25 0\n");
  CHECK(st.positions == std::vector<Vec3d>{{1, 2, 3}, {4, 5, 6}});
  CHECK(floatAt(st.vertexProperties.at(0), 1) == 0.25f);
}

TEST_CASE("OFF: vertices without a colour under COFF") {
  const Mesh m = readText("COFF 2 0 0\n1 2 3\n4 5 6 0 0 102\n");
  CHECK(m.vertexColors == std::vector<Rgb>{{1, 1, 1}, {0, 0, 0.4f}});
  CHECK(readText("COFF 1 0 0\n1 2 3\n").vertexColors.empty());
}

TEST_CASE("OFF: face colours as bytes, floats, colour maps or nothing") {
  const Mesh bytes = readText("OFF 4 3 0\n" + kSquare + "3 0 1 2\n4 0 1 2 3 255 0 51\n3 0 1 2 0 255 0 128\n");
  CHECK(bytes.faceColorEncoding == ColorEncoding::srgb);
  CHECK(bytes.faceColors == std::vector<Rgb>{{1, 1, 1}, {1, 0, 0.2f}, {1, 0, 0.2f}, {0, 1, 0}});
  const Mesh floats = readText("OFF 4 1 0\n" + kSquare + "3 0 1 2 1 0.5 0\n");
  CHECK(floats.faceColorEncoding == ColorEncoding::linear);
  CHECK(floats.faceColors == std::vector<Rgb>{{1, 0.5f, 0}});
  const Mesh mapped = readText("OFF 4 1 0\n" + kSquare + "3 0 1 2 7\n");
  CHECK(mapped.faceColors.empty());
  REQUIRE(mapped.warnings.size() == 1);
  CHECK(mapped.warnings[0] == "1 faces have an index of a colour map, which was left out");
}

TEST_CASE("OFF: faces without area and text after the last face are said") {
  const Mesh m = readText("OFF 4 3 0\n" + kSquare + "2 0 1\n3 0 1 2\n0\nmore\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(m.sourcePolygons == std::vector<std::uint32_t>{1});
  REQUIRE(m.warnings.size() == 2);
  CHECK(m.warnings[0] == "what follows the last face, from line 9 on, was left out");
}

TEST_CASE("OFF: counts that the file cannot hold make no room for them") {
  const std::size_t before = peakMemory();
  const auto vertices = errorOfText("OFF\n4294967294 4294967294 0\n0 0 0\n");
  CHECK(vertices.cause == "the file ends in vertex 1, but the header promises 4294967294");
  CHECK(errorOfText("OFF\n1 1 0\n0 0 0\n4294967294 0 0 0\n").cause ==
        "the file ends in face 0, but the header promises 1");
  CHECK(peakMemory() - before < (64u << 20));
  CHECK(errorOfText("OFF\n4294967295 1 0\n").place == "line 2");
}

TEST_CASE("OFF: mistakes are told at their line") {
  CHECK(errorOfText("OFF\n3 1 0\n0 0 0\n1 x 0\n").place == "line 4");
  CHECK(errorOfText("OFF\n3 1 0\n0 0 0\n1 inf 0\n").place == "line 4");
  CHECK(errorOfText("OFF 4 1 0\n" + kSquare + "3 0 1 4\n").cause ==
        "vertex index 4 in face 0, but there are 4 vertices, counted from 0");
  CHECK(errorOfText("OFF 4 1 0\n" + kSquare + "3 0 1 -1\n").place == "line 6");
  CHECK(errorOfText("OFF 4 1 0\n" + kSquare + "3 0 1\n").cause == "the file ends in face 0, but the header promises 1");
  CHECK(errorOfText("OFF 4 1 0\n" + kSquare + "3 0 1 2 1 1\n").place == "line 6");
  CHECK(errorOfText("OFF 4 1 0\n" + kSquare + "3 0 1 2 1 1 1 1 1\n").place == "line 6");
  CHECK(errorOfText("COFF 1 0 0\n1 2 3 4 5\n").place == "line 2");
  CHECK(errorOfText("OFF\n1 0 0 0\n").place == "line 2");
  CHECK(errorOfText("OFF\n0 0 0\n").place == "line 2");
  CHECK(errorOfText("OFF\n").cause == "the file ends after the header");
  CHECK(errorOfText("# only\n").cause == "the file holds no OFF header");
  CHECK(errorOfText("OFF BINARY\n1 1 1\n").cause.find("binary OFF") == 0);
  CHECK(errorOfText("4OFF\n1 1 1\n").cause.find("three-dimensional") != std::string::npos);
  CHECK(errorOfText("nOFF\n4\n1 1 1\n").cause.find("three-dimensional") != std::string::npos);
  CHECK(errorOfText("CCOFF\n1 1 1\n").place == "line 1");
}
