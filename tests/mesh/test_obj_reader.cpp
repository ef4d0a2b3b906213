// OBJ: each statement in all its forms, and each mistake at its line.
#include <catch2/catch.hpp>

#include "mesh/obj_reader.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;
using plytest::Folder;

namespace {

Mesh readText(const std::string& text) {
  const Folder folder;
  Progress progress;
  return readObj(folder.write("mesh.obj", text), progress);
}

Error::Parts errorOfText(const std::string& text) {
  const auto error = errorOf([&] { readText(text); });
  INFO(text);
  REQUIRE(error);
  return *error;
}

std::vector<float> floatsOf(const Property& p) {
  std::vector<float> values(p.values.size() / sizeof(float));
  std::memcpy(values.data(), p.values.data(), p.values.size());
  return values;
}

bool hasWarning(const Mesh& mesh, const std::string& part) {
  for (const std::string& w : mesh.warnings) {
    if (w.find(part) != std::string::npos) return true;
  }
  return false;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: triangles keep their order, winding and indices") {
  const Mesh m = readText("# made by hand\n" + kSquare + "f 1 2 3\nf 3 4 1\n");
  CHECK(m.positions == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});
  CHECK(m.sourcePolygons.empty());
  CHECK(m.cornerNormals.empty());
  CHECK(m.vertexColors.empty());
  CHECK(m.faceColors.empty());
  CHECK(m.warnings.empty());
  CHECK_FALSE(m.doublePositions);
}

TEST_CASE("OBJ: polygons are cut and recorded from the first face on") {
  const Mesh m = readText(kSquare + "f 1 2 3\nf 1 2 3 4\nf 4 3 2\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {3, 2, 1}});
  CHECK(m.sourcePolygons == std::vector<std::uint32_t>{0, 1, 1, 2});
}

TEST_CASE("OBJ: a concave polygon is not fanned over its notch") {
  const Mesh m = readText("v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 2 3 4 1\n");
  REQUIRE(m.triangles.size() == 2);
  for (const Triangle& t : m.triangles) {
    const Vec3d n = cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]);
    CHECK(n.z > 0);
  }
}

TEST_CASE("OBJ: negative indices count back from the face's line, positive ones reach ahead") {
  const Mesh m =
      readText("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 5 6 7\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -1 -2 -3\n");
  CHECK(m.triangles == std::vector<Triangle>{{1, 2, 3}, {4, 5, 6}, {6, 5, 4}});
}

TEST_CASE("OBJ: corners have texture coordinates and normals in every form") {
  const Mesh m = readText(kSquare +
                          "vt 0.5\nvt 0.25 0.75 0\nvn 0 0 1\nvn 0 1 0\n"
                          "f 1 2 3\nf 1/1 2/2 3/2\nf 1//1 2//2 3//-1\nf 1/1/1 2/2/2 3\nf 1/ 2/-1/-2 4//\n");
  REQUIRE(m.triangles.size() == 5);
  const Vec3f z(0, 0, 1), y(0, 1, 0), none;
  CHECK(m.cornerNormals == std::vector<Vec3f>{none, none, none, none, none, none, z, y, y, z, y, none, none, z, none});
  REQUIRE(m.faceProperties.size() == 1);
  CHECK(m.faceProperties[0].name == "texcoord");
  CHECK(m.faceProperties[0].isList);
  CHECK(m.faceProperties[0].listStarts == std::vector<std::uint64_t>{0, 6, 12, 18, 24, 30});
  const std::vector<float> expected = {0, 0, 0, 0,   0, 0,    0.5,  0, 0.25, 0.75, 0.25, 0.75, 0,    0, 0,
                                       0, 0, 0, 0.5, 0, 0.25, 0.75, 0, 0,    0,    0,    0.25, 0.75, 0, 0};
  CHECK(floatsOf(m.faceProperties[0]) == expected);
}

TEST_CASE("OBJ: corner attributes follow the corners of cut polygons") {
  const Mesh m = readText(kSquare + "vn 1 0 0\nvn 0 2 0\nvn 0 0 3\nvn 0 4 0\nf 1//1 2//2 3//3 4//4\n");
  const Vec3f a(1, 0, 0), b(0, 2, 0), c(0, 0, 3), d(0, 4, 0);
  CHECK(m.cornerNormals == std::vector<Vec3f>{a, b, c, a, c, d});
}

TEST_CASE("OBJ: numbers in all spellings, long lines, CRLF, continuations and comments") {
  const std::string blanks(100000, ' ');
  const Mesh m =
      readText("v +1.0 -0 1e-1" + blanks + "# first\r\nv 1 \\\r\n 2 3\r\nv 4 5 6 1.0\r\nf 1 2 \\\r\n3 # face\r\n");
  CHECK(m.positions == std::vector<Vec3d>{{1, 0, 0.1}, {1, 2, 3}, {4, 5, 6}});
  CHECK(std::signbit(m.positions[0].y));
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(m.warnings.empty());
}

TEST_CASE("OBJ: vertex colours are linear floats or bytes, by their numbers") {
  const Mesh floats = readText("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0 0.25 1 1 0.5\nf 1 2 3\n");
  CHECK(floats.vertexColorEncoding == ColorEncoding::linear);
  CHECK(floats.vertexColors == std::vector<Rgb>{{1, 0.5, 0}, {0, 0, 0}, {0.25, 1, 1}});
  const Mesh bytes = readText("v 0 0 0 255 51 0\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n");
  CHECK(bytes.vertexColorEncoding == ColorEncoding::srgb);
  CHECK(bytes.vertexColors[0] == Rgb(1, 0.2f, 0));
  CHECK(bytes.vertexColors[2].x == 1 / 255.f);
}

TEST_CASE("OBJ: vertices without a colour among coloured ones are white, in either encoding") {
  const Mesh m = readText("v 0 0 0\nv 1 0 0 0 0 102\nv 0 1 0\nf 1 2 3\n");
  CHECK(m.vertexColors == std::vector<Rgb>{{1, 1, 1}, {0, 0, 0.4f}, {1, 1, 1}});
  CHECK(hasWarning(m, "2 of 3 vertex colours are missing"));
}

TEST_CASE("OBJ: materials give face colours and textures") {
  const Folder folder;
  folder.write("my materials.mtl",
               "newmtl red\nKd 1 0.25 0\nmap_Kd -s 1 1 1 -clamp on red wall.png\nnewmtl grey\nKd 0.5\n"
               "newmtl blue one\nKd 0 0 1\nmap_Kd blue.png\n");
  const std::string path =
      folder.write("mesh.obj", "mtllib my materials.mtl\n" + kSquare +
                                   "f 1 2 3\nusemtl red\nf 1 2 3 4\nusemtl blue one\nf 1 2 3\nusemtl gone\nf 1 2 3\n");
  Progress progress;
  const Mesh m = readObj(path, progress);
  const Rgb white(1, 1, 1), red(1, 0.25, 0), blue(0, 0, 1);
  CHECK(m.faceColors == std::vector<Rgb>{white, red, red, blue, white});
  CHECK(m.faceColorEncoding == ColorEncoding::linear);
  CHECK(m.comments == std::vector<std::string>{"TextureFile red wall.png", "TextureFile blue.png"});
  REQUIRE(m.faceProperties.size() == 1);
  CHECK(m.faceProperties[0].name == "texnumber");
  std::vector<std::int32_t> numbers(5);
  REQUIRE(m.faceProperties[0].values.size() == 20);
  std::memcpy(numbers.data(), m.faceProperties[0].values.data(), 20);
  CHECK(numbers == std::vector<std::int32_t>{-1, 0, 0, 1, -1});
  CHECK(hasWarning(m, "\"gone\""));
  CHECK(hasWarning(m, "2 of 5 face colours are missing"));
}

TEST_CASE("OBJ: several material files may stand on a line") {
  const Folder folder;
  folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
  folder.write("b.mtl", "newmtl b\nKd 0 1 0\n");
  Progress progress;
  const Mesh m = readObj(
      folder.write("m.obj", "mtllib a.mtl b.mtl\n" + kSquare + "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"), progress);
  CHECK(m.faceColors == std::vector<Rgb>{{0, 1, 0}, {1, 0, 0}});
}

TEST_CASE("OBJ: a missing material file is a warning that names it") {
  const Mesh m = readText("mtllib none.mtl\nusemtl a\n" + kSquare + "f 1 2 3\n");
  CHECK(m.triangles.size() == 1);
  CHECK(m.faceColors.empty());
  CHECK(hasWarning(m, "none.mtl"));
}

TEST_CASE("OBJ: what holds no polygons is passed over, and said") {
  const Mesh m = readText("o thing\ng a b\ns off\n" + kSquare + "s 1\nl 1 2\np 1\nf 1 2 3\nf 1 2\nf\nvn 0 0 1\n");
  CHECK(m.triangles.size() == 1);
  CHECK(m.sourcePolygons == std::vector<std::uint32_t>{0});
  CHECK(hasWarning(m, "2 statements that hold no polygons were passed over (the first is \"l\" on line 9)"));
  CHECK(hasWarning(m, "2 faces with fewer than three corners"));
  CHECK(hasWarning(m, "1 normals are referred to by no face"));
}

TEST_CASE("OBJ: normals that are not finite count as missing") {
  const Mesh m = readText(kSquare + "vn nan nan nan\nvn 0 0 1\nf 1//1 2//2 3//2\n");
  CHECK(m.cornerNormals == std::vector<Vec3f>{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}});
  CHECK(hasWarning(m, "1 normals are not finite"));
}

TEST_CASE("OBJ: coordinates far from the origin are known to need double precision") {
  const Mesh m =
      readText("v 4500000.123 5400000.5 300\nv 4500001.123 5400000.5 300\nv 4500000.123 5400001.5 300\nf 1 2 3\n");
  CHECK(m.doublePositions);
  CHECK(m.positions[0].x == 4500000.123);
}

TEST_CASE("OBJ: mistakes are told at their line") {
  CHECK(errorOfText("v 1 2\n").place == "line 1");
  CHECK(errorOfText("v 0 0 0\nv 1 x 0\n").place == "line 2");
  CHECK(errorOfText("v 0 0 nan\n").cause == "\"nan\" is not finite where a coordinate should stand");
  CHECK(errorOfText("v 0 0 1e999\n").place == "line 1");
  CHECK(errorOfText("v 0 0 0 1 1\n").cause == "5 numbers for a vertex");
  CHECK(errorOfText("v 0 0 0 1 1 1 1 1\n").place == "line 1");
  CHECK(errorOfText(kSquare + "f 1 2 5\n").cause == "index 5 of a vertex, but there are 4 in the file");
  CHECK(errorOfText(kSquare + "f 1 2 0\n").cause == "index 0 of a vertex");
  CHECK(errorOfText(kSquare + "f -5 2 1\n").cause == "index -5 of a vertex, but there are 4 above this line");
  CHECK(errorOfText(kSquare + "f 1 2 99999999999999999999\n").place == "line 5");
  CHECK(errorOfText(kSquare + "f 1/1 2 3\n").cause == "index 1 of a texture coordinate, but there are 0 in the file");
  CHECK(errorOfText(kSquare + "f 1//1 2 3\n").cause == "index 1 of a normal, but there are 0 in the file");
  for (const char* corner : {"1/2/3/4", "a", "/1", "1.5", "1//x", "-", "1/1/"}) {
    CHECK(errorOfText("vt 0 0\n" + kSquare + "f 1 2 " + corner + "z\n").place == "line 6");
  }
  CHECK(errorOfText(kSquare + "vn 0 0\n").place == "line 5");
  CHECK(errorOfText(kSquare + "vt x\n").place == "line 5");
  CHECK(errorOfText("# nothing\n").cause == "holds no vertices");
}
