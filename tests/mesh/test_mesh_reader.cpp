// Telling formats apart, files that cannot be read, damaged files, and real ones.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;
using plytest::Folder;

namespace {

const std::string kObj =
    "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5 0.5\nvn 0 0 1\nusemtl a\n"
    "f 1/1/1 2/1/1 3//1\nf -4 -2 \\\n -1 2\n";
const std::string kOff =
    "COFF\n4 2 0\n0 0 0 255 0 0\n1 0 0 0 255 0 255\n1 1 0 0 0 255\n0 1 0 9 9 9\n3 0 1 2\n4 0 1 2 3 9 9 9\n";
const std::string kAscii =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid a\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A binary STL of one triangle.
std::string binaryStl() {
  std::string bytes(80, ' ');
  const std::uint32_t count = 1;
  const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  bytes.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
  return bytes + std::string(2, '\0');
}

Mesh readBytes(const Folder& folder, const std::string& name, const std::string& bytes) {
  Progress progress;
  return readMesh(folder.write(name, bytes), progress);
}

std::size_t facesOf(const Folder& folder, const std::string& name, const std::string& bytes) {
  return readBytes(folder, name, bytes).triangles.size();
}

Error::Parts failure(const std::string& path) {
  Progress progress;
  const auto error = errorOf([&] { readMesh(path, progress); });
  INFO(path);
  REQUIRE(error);
  return *error;
}

/// All that Mesh promises of its arrays.
void checkValid(const Mesh& m) {
  const std::size_t v = m.positions.size(), f = m.triangles.size();
  const auto sized = [](std::size_t size, std::size_t full) { return size == 0 || size == full; };
  REQUIRE(std::all_of(m.positions.begin(), m.positions.end(), [](const Vec3d& p) { return isFinite(p); }));
  for (const Triangle& t : m.triangles) REQUIRE(*std::max_element(t.begin(), t.end()) < v);
  REQUIRE(sized(m.vertexNormals.size(), v));
  REQUIRE(sized(m.cornerNormals.size(), 3 * f));
  REQUIRE(sized(m.vertexColors.size(), v));
  REQUIRE(sized(m.faceColors.size(), f));
  REQUIRE(sized(m.sourcePolygons.size(), f));
  for (const Property& p : m.faceProperties) {
    if (p.isList) REQUIRE(p.listStarts.size() == f + 1);
    REQUIRE(p.values.size() == (p.isList ? p.listStarts.back() : f) * scalarSize(p.type));
  }
  for (const std::vector<Rgb>* colors : {&m.vertexColors, &m.faceColors}) {
    for (const Rgb& c : *colors) REQUIRE((c.x >= 0 && c.x <= 1 && c.y >= 0 && c.y <= 1 && c.z >= 0 && c.z <= 1));
  }
}

/// Reads damaged bytes: a valid mesh, or an Error that names the file. Anything else fails. True for a mesh.
bool survives(const Folder& folder, const std::string& name, const std::string& bytes) {
  try {
    checkValid(readBytes(folder, name, bytes));
    return true;
  } catch (const Error& error) {
    REQUIRE(error.parts().file == folder.path(name));
    REQUIRE_FALSE(error.parts().cause.empty());
    return false;
  }
}

}  // namespace

TEST_CASE("formats are told apart by content, whatever the name") {
  const Folder folder;
  for (const char* name : {"mesh", "mesh.obj", "mesh.off", "mesh.stl", "mesh.ply", "mesh.txt"}) {
    INFO(name);
    CHECK(facesOf(folder, name, kObj) == 3);
    CHECK(facesOf(folder, name, "# comment\n\n" + kObj) == 3);
    CHECK(facesOf(folder, name, kOff) == 3);
    CHECK(facesOf(folder, name, "# comment\n" + kOff) == 3);
    CHECK(facesOf(folder, name, kAscii) == 1);
    CHECK(facesOf(folder, name, binaryStl()) == 1);
    CHECK(facesOf(folder, name, kPly) == 1);
  }
}

TEST_CASE("the ending decides where the content leaves doubt, in any case of letters") {
  const Folder folder;
  CHECK(facesOf(folder, "a.OBJ", "call other.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") == 1);
  CHECK(facesOf(folder, "a.Off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") == 1);
}

TEST_CASE("the endings that are read") {
  CHECK(readableExtensions() == std::vector<std::string>{"ply", "obj", "off", "stl"});
}

TEST_CASE("files that cannot be read have one clear line each") {
  const Folder folder;
  CHECK(failure(folder.path("none.ply")).cause == "cannot be opened: No such file or directory");
  CHECK(failure(folder.path("")).cause == "is a folder");
  CHECK(failure(folder.write("empty.obj", "")).cause == "is empty");
  CHECK(failure("/dev/null").cause == "is a pipe or a device");
  const auto unknown = failure(folder.write("a.xyz", "hello world"));
  CHECK(unknown.cause == "is no mesh file that shbake knows");
  CHECK(unknown.remedy == "convert it to one of these: .ply .obj .off .stl");
  CHECK(failure(folder.write("a.ply.gz", "\x1F\x8B\x08 and so on")).cause == "is compressed");
  CHECK(failure(folder.write("a.glb", "glTF\x02")).cause == "is a binary glTF file, which shbake does not read");
  if (::geteuid() == 0) {
    WARN("running as root, who may read everything: the test of an unreadable file is skipped");
    return;
  }
  const std::string secret = folder.write("secret.obj", kObj);
  std::filesystem::permissions(secret, std::filesystem::perms::none);
  CHECK(failure(secret).cause == "cannot be opened: Permission denied");
}

TEST_CASE("a file cut short at any byte is a valid mesh or an error that names it") {
  const Folder folder;
  for (const auto& [name, bytes] : {std::pair<const char*, std::string>{"a.obj", kObj},
                                    {"a.off", kOff},
                                    {"a.stl", kAscii},
                                    {"b.stl", binaryStl()},
                                    {"a.ply", kPly}}) {
    INFO(name);
    CHECK(survives(folder, name, bytes));
    std::size_t refused = 0;
    for (std::size_t size = 0; size < bytes.size(); ++size) refused += !survives(folder, name, bytes.substr(0, size));
    CHECK(refused > bytes.size() / 10);
  }
}

TEST_CASE("a file with changed bytes is a valid mesh or an error that names it") {
  const Folder folder;
  plytest::Random random(1);
  for (const auto& [name, bytes] : {std::pair<const char*, std::string>{"a.obj", kObj},
                                    {"a.off", kOff},
                                    {"a.stl", kAscii},
                                    {"b.stl", binaryStl()}}) {
    INFO(name);
    std::size_t refused = 0;
    for (int i = 0; i < 1500; ++i) {
      std::string damaged = bytes;
      for (std::size_t n = random.below(3) + 1; n > 0; --n) {
        // Half of the bytes come from the alphabet of the formats, to reach further than junk does.
        constexpr std::string_view kAlphabet = "0123456789-+.e/\\#\n\r \tvfnt";
        const std::size_t at = random.below(damaged.size());
        damaged[at] =
            random.below(2) == 0 ? static_cast<char>(random.bits()) : kAlphabet[random.below(kAlphabet.size())];
      }
      refused += !survives(folder, name, damaged);
    }
    CHECK(refused > 0);
  }
}

TEST_CASE("reading stops within a tenth of a second of being cancelled") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 400000; ++i) text += "v 0.123456789 1.5 2.25\n";
  const std::string path = folder.write("long.obj", text);
  using Clock = std::chrono::steady_clock;
  Clock::time_point cancelled;
  Progress progress([&](const ProgressState& state) {
    const bool goOn = state.stage != "parsing" || state.done == 0;
    if (!goOn && cancelled == Clock::time_point()) cancelled = Clock::now();
    return goOn;
  });
  const auto error = errorOf([&] { readMesh(path, progress); });
  REQUIRE(error);
  CHECK(error->kind == ErrorKind::cancelled);
  CHECK(Clock::now() - cancelled < std::chrono::milliseconds(100));
}

TEST_CASE("real meshes have the counts that their manifest states") {
  struct Expected {
    const char* name;
    std::size_t vertices, triangles, boundary, nonManifold;
  };
  constexpr Expected kMeshes[] = {
      {"stanford-bunny.obj", 35947, 69451, 223, 0},
      {"spot.obj", 2930, 5856, 0, 0},
      {"fandisk.obj", 6475, 12946, 0, 0},
      {"rocker-arm.obj", 10044, 20088, 0, 0},
      {"suzanne.obj", 507, 968, 42, 1},
      {"teapot.obj", 3644, 6320, 160, 0},
      {"cow.obj", 2903, 5804, 0, 0},
      {"igl_armadillo.obj", 43243, 86482, 0, 0},
      {"igl_decimated-knight.off", 502, 1000, 0, 0},
      {"igl_halftunnel.off", 831, 1568, 96, 0},
      {"igl_cube.obj", 8, 12, 0, 0},
  };
  const std::filesystem::path folder = std::filesystem::path(SHBAKE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no folder " + folder.string());
    return;
  }
  for (const Expected& e : kMeshes) {
    INFO(e.name);
    Progress progress;
    const Mesh mesh = readMesh((folder / e.name).string(), progress);
    checkValid(mesh);
    CHECK(mesh.positions.size() == e.vertices);
    CHECK(mesh.triangles.size() == e.triangles);
    const MeshCheck check = checkMesh(mesh, progress);
    CHECK(check.boundaryEdges.count == e.boundary);
    CHECK(check.nonManifoldEdges.count == e.nonManifold);
  }
}
