// STL in both encodings: told apart by size, welded exactly, checked against the promised count.
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "base/memory.h"
#include "mesh/stl_reader.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;
using plytest::Folder;

namespace {

using Facet = std::array<Vec3f, 3>;

Mesh readBytes(const std::string& bytes) {
  const Folder folder;
  Progress progress;
  return readStl(folder.write("mesh.stl", bytes), progress);
}

Error::Parts errorOfBytes(const std::string& bytes) {
  const auto error = errorOf([&] { readBytes(bytes); });
  REQUIRE(error);
  return *error;
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::string binary(const std::vector<Facet>& facets, const std::string& header = {}, std::uint16_t attribute = 0) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    for (int i = 0; i < 3; ++i) append(bytes, std::numeric_limits<float>::quiet_NaN());  // the normal is left out
    for (const Vec3f& p : facet) {
      for (const float v : {p.x, p.y, p.z}) append(bytes, v);
    }
    append(bytes, attribute);
  }
  return bytes;
}

const std::vector<Facet> kTwo = {{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)},
                                 {Vec3f(1, 0, 0), Vec3f(1, 1, 0), Vec3f(-0.f, 1, 0)}};

void checkTwo(const Mesh& m) {
  CHECK(m.positions == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(m.vertexNormals.empty());
  CHECK(m.cornerNormals.empty());
  CHECK_FALSE(m.doublePositions);
}

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

}  // namespace

TEST_CASE("STL: binary corners at equal positions become one vertex") {
  const Mesh m = readBytes(binary(kTwo));
  checkTwo(m);
  CHECK(m.faceProperties.empty());
  CHECK(m.warnings.empty());
}

TEST_CASE("STL: a binary file whose header says solid is told by its size") {
  checkTwo(readBytes(binary(kTwo, "solid cube\nfacet normal 0 0 1")));
}

TEST_CASE("STL: attributes are carried through where any is set") {
  const Mesh m = readBytes(binary(kTwo, "COLOR=", 0x8123));
  REQUIRE(m.faceProperties.size() == 1);
  CHECK(m.faceProperties[0].name == "stl_attribute");
  CHECK(m.faceProperties[0].type == ScalarType::uint16);
  CHECK(m.faceProperties[0].values.size() == 4);
  CHECK(m.faceProperties[0].values[1] == std::byte(0x81));
}

TEST_CASE("STL: ASCII in any case, with names, exponents, CRLF and several solids") {
  checkTwo(readBytes(
      "solid first part\n" + kFacet +
      "endsolid first part\nsolid\r\nFACET NORMAL nan nan nan\r\n"
      "  OUTER LOOP\r\n VERTEX 1.0e0 0 0\r\nVertex +1 1 0\r\nvertex -0 1 0\r\nENDLOOP\r\nENDFACET\r\nendsolid"));
}

TEST_CASE("STL: an ASCII loop of more than three vertices is cut") {
  const Mesh m = readBytes(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(m.sourcePolygons == std::vector<std::uint32_t>{0, 0});
}

TEST_CASE("STL: bytes after the last binary triangle and a missing endsolid are said") {
  const Mesh longer = readBytes(binary(kTwo) + "xyz");
  checkTwo(longer);
  CHECK(longer.warnings == std::vector<std::string>{"3 bytes after the last triangle were left out"});
  CHECK(readBytes("solid\n" + kFacet).warnings ==
        std::vector<std::string>{"the file ends without endsolid and may be cut short"});
}

TEST_CASE("STL: a promised count beyond the file makes no room for it") {
  std::string bytes = binary(kTwo);
  bytes.replace(80, 4, "\xFF\xFF\xFF\xFF");
  const std::size_t before = peakMemory();
  const auto error = errorOfBytes(bytes);
  CHECK(error.place == "header");
  CHECK(error.cause == "promises 4294967295 triangles, but the file ends after 2");
  CHECK(peakMemory() - before < (64u << 20));
}

TEST_CASE("STL: mistakes are told at their place") {
  CHECK(errorOfBytes("short").place == "header");
  CHECK(errorOfBytes(binary({})).cause == "holds no triangles");
  CHECK(errorOfBytes(binary(kTwo).substr(0, 180)).cause == "promises 2 triangles, but the file ends after 1");
  auto bad = kTwo;
  bad[1][2].y = std::numeric_limits<float>::infinity();
  CHECK(errorOfBytes(binary(bad)).place == "triangle 1");
  CHECK(errorOfBytes("solid\n" + kFacet + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\n").cause ==
        "the file ends inside a facet");
  CHECK(errorOfBytes("solid\nfacet\nouter loop\nvertex 0 x 0\n").place == "line 4");
  CHECK(errorOfBytes("solid\nfacet\nouter loop\nvertex 0 nan 0\n").place == "line 4");
  CHECK(errorOfBytes("solid\nfacet\nendfacet\n").cause == "a facet with fewer than three vertices");
  CHECK(errorOfBytes("solid\nfacet\nfacet\n").cause == "a facet inside a facet");
  CHECK(errorOfBytes("solid\n" + kFacet + "vertex 0 0 0\n").cause == "a vertex outside a facet");
  CHECK(errorOfBytes("solid\n" + kFacet + "endfacet\n").cause == "endfacet without a facet");
  CHECK(errorOfBytes("solid\nfacet\nendsolid\n").cause == "a solid begins or ends inside a facet");
  CHECK(errorOfBytes("solid\n" + kFacet + "junk\n").cause == "\"junk\" is no keyword of STL");
  CHECK(errorOfBytes("solid\nendsolid\n").cause == "holds no triangles");
}
