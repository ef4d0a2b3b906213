// What PLY files mean: positions, normals, colours, polygons, strips; and what is refused.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/memory.h"
#include "mesh/ply_columns.h"
#include "mesh/ply_reader.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

Mesh read(const std::string& bytes) {
  const plytest::Folder folder;
  Progress progress;
  return readPly(folder.write("a.ply", bytes), progress);
}

const std::string kStart = "ply\nformat ascii 1.0\n";
const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string kFloats = "property float x\nproperty float y\nproperty float z\n";
const std::string kIndices = "property list uchar int vertex_indices\n";

/// A file with the four corners of the unit square and the given faces.
std::string squareFile(const std::string& count, const std::string& faces, const std::string& indices = kIndices) {
  return kStart + "element vertex 4\n" + kFloats + "element face " + count + "\n" + indices + "end_header\n" + kSquare +
         faces;
}

}  // namespace

TEST_CASE("PLY reader: positions in every scalar type, double where a float cannot hold them") {
  struct Case {
    const char* type;
    bool isDouble;
  };
  for (const Case c : {Case{"char", false},
                       {"uchar", false},
                       {"short", false},
                       {"ushort", false},
                       {"int", true},
                       {"uint", true},
                       {"float", false},
                       {"double", true}}) {
    INFO(c.type);
    const std::string type(c.type);
    const Mesh mesh = read(kStart + "element vertex 2\nproperty float z\nproperty " + type +
                           " x\nproperty float y\nend_header\n0.5 7 1\n2.5 9 3\n");
    CHECK(mesh.positions == std::vector<Vec3d>{{7, 1, 0.5}, {9, 3, 2.5}});
    CHECK(mesh.doublePositions == c.isDouble);
    CHECK(mesh.vertexProperties.empty());
    CHECK(mesh.triangles.empty());
  }
  CHECK(read(kStart +
             "element vertex 1\nproperty double x\nproperty double y\nproperty double z\nend_header\n0.1 1e300 -0\n")
            .positions[0] == Vec3d(0.1, 1e300, 0));
}

TEST_CASE("PLY reader: a file as MeshLab writes it") {
  const Mesh mesh = read(
      "ply\nformat ascii 1.0\ncomment VCGLIB generated\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nproperty double nx\nproperty double ny\nproperty double nz\nproperty int flags\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty double quality\n"
      "property double texture_u\nelement face 1\nproperty list uchar int vertex_indices\nproperty int flags\n"
      "property list uchar double texcoord\nend_header\n"
      "0 0 0.1 0 0 2 0 255 128 0 255 0.5 0.1\n1 0 0 0 0 1 1 0 0 0 255 0.25 0.2\n0 1 0 0 0 1 2 51 102 204 9 1 0.3\n"
      "3 0 1 2 4 6 0 0 1 0 0 1\n");
  CHECK(mesh.doublePositions);
  CHECK(mesh.positions[0] == Vec3d(0, 0, 0.1));
  CHECK(mesh.vertexNormals == std::vector<Vec3f>{{0, 0, 2}, {0, 0, 1}, {0, 0, 1}});
  CHECK(mesh.vertexColorEncoding == ColorEncoding::srgb);
  CHECK(mesh.vertexColors == std::vector<Rgb>{{1, 128 / 255.0f, 0}, {0, 0, 0}, {0.2f, 0.4f, 0.8f}});
  std::vector<std::string> names;
  for (const Property& p : mesh.vertexProperties) names.push_back(p.name);
  CHECK(names == std::vector<std::string>{"flags", "red", "green", "blue", "alpha", "quality", "texture_u"});
  CHECK(mesh.vertexProperties[1].type == ScalarType::uint8);
  CHECK(scalarAt(mesh.vertexProperties[1], 2) == 51);
  CHECK(scalarAt(mesh.vertexProperties[5], 1) == 0.25);
  REQUIRE(mesh.faceProperties.size() == 2);
  CHECK(mesh.faceProperties[1].listStarts == std::vector<std::uint64_t>{0, 6});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.sourcePolygons.empty());
  CHECK(mesh.comments == std::vector<std::string>{"VCGLIB generated"});
}

TEST_CASE("PLY reader: colours") {
  const auto colored = [](const std::string& type, const std::string& names, const std::string& values) {
    std::string header = kStart + "element vertex 3\n" + kFloats;
    std::string faceHeader = "element face 1\n" + kIndices;
    std::istringstream words(names);
    for (std::string name; words >> name;) {
      header += "property " + type + " " + name + "\n";
      faceHeader += "property " + type + " " + name + "\n";
    }
    std::string rows;
    for (const char* p : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) rows += p + values + "\n";
    return read(header + faceHeader + "end_header\n" + rows + "3 0 1 2 " + values + "\n");
  };
  const Mesh bytes = colored("uchar", "blue green red", "255 0 51");
  CHECK(bytes.vertexColors == std::vector<Rgb>(3, Rgb(0.2f, 0, 1)));
  CHECK(bytes.faceColors == std::vector<Rgb>{Rgb(0.2f, 0, 1)});
  CHECK(bytes.vertexColorEncoding == ColorEncoding::srgb);
  CHECK(bytes.faceColorEncoding == ColorEncoding::srgb);
  for (const char* type : {"float", "double"}) {
    const Mesh floats = colored(type, "red green blue", "0.5 2 0.25");
    CHECK(floats.vertexColors == std::vector<Rgb>(3, Rgb(0.5f, 2, 0.25f)));
    CHECK(floats.vertexColorEncoding == ColorEncoding::linear);
    CHECK(floats.faceColorEncoding == ColorEncoding::linear);
    CHECK(floats.vertexProperties.size() == 3);
    CHECK(floats.faceProperties.size() == 3);
  }
  CHECK(colored("ushort", "red green blue", "1 2 3").vertexColors.empty());
  CHECK(colored("uchar", "red green", "1 2").vertexColors.empty());
}

TEST_CASE("PLY reader: indices of any integer type, under both names, and other face properties") {
  for (const char* count : {"char", "uchar", "short", "ushort", "int", "uint"}) {
    for (const char* type : {"char", "uchar", "short", "ushort", "int", "uint"}) {
      for (const char* name : {"vertex_indices", "vertex_index"}) {
        const std::string indices =
            std::string("property uchar a\nproperty list ") + count + " " + type + " " + name + "\nproperty int b\n";
        const Mesh mesh = read(squareFile("2", "9 3 0 1 2 -1\n8 3 2 3 0 -2\n", indices));
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});
        REQUIRE(mesh.faceProperties.size() == 2);
        CHECK(scalarAt(mesh.faceProperties[0], 1) == 8);
        CHECK(scalarAt(mesh.faceProperties[1], 1) == -2);
      }
    }
  }
}

TEST_CASE("PLY reader: polygons become triangles, and their properties are repeated") {
  const std::string start = kStart + "element vertex 6\n" + kFloats + "element face 4\n" + kIndices +
                            "property uchar q\nproperty list uchar uchar l\n";
  // An L whose plain fan from corner 0 would leave it; the triangulation is the same from whatever corner it starts.
  const std::string vertices = "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n";
  const std::string faces = "3 0 1 2 10 1 1\n6 1 2 3 4 5 0 20 2 2 2\n4 0 1 2 3 30 0\n3 3 4 5 40 1 4\n";
  const Mesh mesh = read(start + "end_header\n" + vertices + faces);
  CHECK(mesh.triangles.size() == 8);
  CHECK(mesh.sourcePolygons == std::vector<std::uint32_t>{0, 1, 1, 1, 1, 2, 2, 3});
  double area = 0;
  for (std::size_t t = 1; t < 5; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double z = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z / 2;
    CHECK(z > 0);
    area += z;
  }
  CHECK(area == Approx(3));
  const Property& q = mesh.faceProperties[0];
  const double expected[] = {10, 20, 20, 20, 20, 30, 30, 40};
  for (std::size_t t = 0; t < 8; ++t) CHECK(scalarAt(q, t) == expected[t]);
  CHECK(mesh.faceProperties[1].listStarts == std::vector<std::uint64_t>{0, 1, 3, 5, 7, 9, 9, 9, 10});
  CHECK(scalarAt(mesh.faceProperties[1], 9) == 4);

  SECTION("faces may stand before the vertices") {
    const std::string header = kStart + "element face 4\n" + kIndices +
                               "property uchar q\nproperty list uchar uchar l\n" + "element vertex 6\n" + kFloats +
                               "end_header\n";
    CHECK(plytest::difference(read(header + faces + vertices), mesh) == "");
  }
}

TEST_CASE("PLY reader: a mesh that begins with a quad") {
  const Mesh mesh = read(squareFile("2", "4 0 1 2 3\n3 0 1 2\n"));
  CHECK(mesh.sourcePolygons == std::vector<std::uint32_t>{0, 0, 1});
  CHECK(mesh.triangles.size() == 3);
  CHECK(mesh.triangles[2] == Triangle{0, 1, 2});
}

TEST_CASE("PLY reader: triangle strips") {
  const std::string header =
      kStart + "element vertex 4\n" + kFloats +
      "element tristrips 2\nproperty list int int vertex_indices\nproperty uchar q\nend_header\n";
  const Mesh mesh = read(header + kSquare + "9 0 1 2 3 -1 3 2 -1 1 7\n5 0 1 1 2 3 8\n");
  // Odd triangles are turned; a segment of two has none; repeated vertices only lead on.
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {1, 2, 3}});
  REQUIRE(mesh.faceProperties.size() == 1);
  const double expected[] = {7, 7, 8};
  for (std::size_t t = 0; t < 3; ++t) CHECK(scalarAt(mesh.faceProperties[0], t) == expected[t]);
  CHECK(mesh.sourcePolygons.empty());
  CHECK(errorOf([&] { read(header + kSquare + "3 0 1 4 7\n3 0 1 2 8\n"); })->place == "tristrips 0");
  CHECK(errorOf([&] { read(header + kSquare + "3 0 1 2 7\n3 0 1 -2 8\n"); })->place == "tristrips 1");
}

TEST_CASE("PLY reader: other elements and comments are kept") {
  const Mesh mesh = read(
      kStart + "comment a\nobj_info b\nelement camera 1\nproperty float focal\nelement vertex 1\n" + kFloats +
      "element edge 2\nproperty int vertex1\nproperty list uchar float w\nend_header\n35\n1 2 3\n4 2 0.5 1\n5 0\n");
  REQUIRE(mesh.elements.size() == 2);
  CHECK(mesh.elements[0].name == "camera");
  CHECK(scalarAt(mesh.elements[0].properties[0], 0) == 35);
  CHECK(mesh.elements[1].count == 2);
  CHECK(mesh.elements[1].properties[1].listStarts == std::vector<std::uint64_t>{0, 2, 2});
  CHECK(mesh.comments == std::vector<std::string>{"a", "obj_info b"});
  CHECK(mesh.positions == std::vector<Vec3d>{{1, 2, 3}});
}

TEST_CASE("PLY reader: what writePly adds is understood, and only that") {
  const std::string columns = kIndices + "property uint source_polygon\nproperty list uchar float corner_normals\n";
  const Mesh mesh = read(squareFile("2", "3 0 1 2 5 9 1 2 3 4 5 6 7 8 9\n3 0 2 3 5 9 1 1 1 1 1 1 1 1 1\n", columns));
  CHECK(mesh.sourcePolygons == std::vector<std::uint32_t>{5, 5});
  REQUIRE(mesh.cornerNormals.size() == 6);
  CHECK(mesh.cornerNormals[1] == Vec3f(4, 5, 6));
  CHECK(mesh.faceProperties.empty());
  const Mesh other = read(squareFile("2", "3 0 1 2 5 6 1 2 3 4 5 6\n3 0 2 3 5 0\n", columns));
  CHECK(other.cornerNormals.empty());
  CHECK(other.faceProperties.size() == 1);
  const std::string signedColumn = kIndices + "property int source_polygon\n";
  const Mesh foreign = read(squareFile("1", "3 0 1 2 -5\n", signedColumn));
  CHECK(foreign.sourcePolygons.empty());
  CHECK(foreign.faceProperties.size() == 1);
}

TEST_CASE("PLY reader: faults name their place") {
  struct Fault {
    std::string text, place, cause;
  };
  const std::string v4 = "element vertex 4\n";
  const std::vector<Fault> faults = {
      {kStart + "end_header\n", "header", "no element vertex"},
      {kStart + v4 + "property float x\nproperty float z\nend_header\n", "header", "no property y"},
      {kStart + v4 + "property list uchar float x\nproperty float y\nproperty float z\nend_header\n", "header",
       "property x is a list"},
      {kStart + "element vertex 4294967295\n" + kFloats + "end_header\n", "header", "more than 32-bit indices"},
      {kStart + "element vertex 4\n" + kFloats + "element face 4294967295\n" + kIndices + "end_header\n", "header",
       "more than 32-bit indices"},
      {squareFile("1", "0 1 2\n", "property int a\nproperty int b\nproperty int c\n"), "header",
       "no list of integers called vertex_indices"},
      {squareFile("1", "3 0 1 2\n", "property list uchar float vertex_indices\n"), "header", "no list of integers"},
      {squareFile("1", "3\n", "property uchar vertex_indices\n"), "header", "no list of integers"},
      {squareFile("2", "3 0 1 2\n2 0 1\n"), "face 1", "fewer than 3 vertices (2)"},
      {squareFile("1", "0\n"), "face 0", "fewer than 3 vertices (0)"},
      {squareFile("2", "3 0 1 2\n3 0 4 1\n"), "face 1", "refers to vertex 4, but there are 4"},
      {squareFile("1", "4 0 1 2 -1\n"), "face 0", "refers to vertex -1"},
      {squareFile("1", "3 0 1 4294967295\n", "property list uchar uint vertex_indices\n"), "face 0",
       "refers to vertex 4294967295"},
      {kStart + "element vertex 2\n" + kFloats + "end_header\n0 0 0\n0 nan 0\n", "vertex 1",
       "its y is not a finite number"},
      {kStart + "element vertex 2\n" + kFloats + "end_header\n0 0 inf\n0 0 0\n", "vertex 0",
       "its z is not a finite number"},
      {kStart + "element vertex 2\n" + kFloats + "end_header\n1e39 0 0\n0 0 0\n", "vertex 0",
       "its x is not a finite number"},
      {kStart + "element vertex 1\n" + kFloats + "element face 1\n" + kIndices + "element tristrips 1\n" + kIndices +
           "end_header\n0 0 0\n",
       "header", "both faces and tristrips"},
  };
  for (const Fault& fault : faults) {
    INFO(fault.text);
    const auto error = errorOf([&] { read(fault.text); });
    REQUIRE(error);
    CHECK(error->kind == ErrorKind::work);
    CHECK(error->place == fault.place);
    CHECK_THAT(error->cause, Catch::Contains(fault.cause));
    CHECK_FALSE(error->remedy.empty());
  }
}

TEST_CASE("PLY reader: empty meshes are meshes") {
  CHECK(
      read(kStart + "element vertex 0\n" + kFloats + "element face 0\n" + kIndices + "end_header\n").positions.empty());
  CHECK(read(kStart + "element vertex 0\n" + kFloats + "element face 0\nend_header\n").triangles.empty());
  CHECK(read("ply\nformat binary_big_endian 1.0\nelement vertex 0\n" + kFloats + "end_header\n").positions.empty());
}

TEST_CASE("PLY reader: line ends of all systems, also before binary data") {
  const std::string binary = squareFile("1", "3 0 1 2\n");
  const Mesh expected = read(binary);
  for (const std::string end : {"\r\n", "\r"}) {
    std::string turned;
    for (const char c : binary) turned += c == '\n' ? end : std::string(1, c);
    CHECK(plytest::difference(read(turned), expected) == "");
    const std::string header = "ply" + end + "format binary_little_endian 1.0" + end + "element vertex 1" + end +
                               "property uchar x" + end + "property uchar y" + end + "property uchar z" + end +
                               "end_header" + end;
    CHECK(read(header + "\n\r\1").positions == std::vector<Vec3d>{{10, 13, 1}});
  }
}

TEST_CASE("PLY reader: progress counts the bytes of the body") {
  const plytest::Folder folder;
  std::vector<ProgressState> told;
  Progress progress([&](const ProgressState& state) {
    told.push_back(state);
    return true;
  });
  readPly(folder.write("a.ply", squareFile("1", "3 0 1 2\n")), progress);
  REQUIRE(told.size() >= 2);
  CHECK(told.back().unit == "bytes");
  CHECK(told.back().total == static_cast<double>(kSquare.size() + 8));
  CHECK(told.back().done == told.back().total);
}
