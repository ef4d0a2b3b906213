// Damaged PLY files: cut at every length and with single bytes changed, they give a valid mesh or an Error, and no
// allocation is larger than a small multiple of the file.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <new>

#include "mesh/ply_reader.h"
#include "mesh/ply_writer.h"
#include "test_ply_files.h"

namespace {

thread_local std::size_t largestAllocation = 0;

}  // namespace

// The whole program allocates through these; they note the largest request and are otherwise the standard ones.
// Inlined, GCC would see free() on what `new` returned and warn of a mismatch. The forms that do not throw are replaced
// too, because sanitizers have their own, whose memory may not be freed here.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  if (bytes > largestAllocation) largestAllocation = bytes;
  return std::malloc(bytes ? bytes : 1);
}
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (void* memory = operator new(bytes, std::nothrow)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}

using namespace shbake;

namespace {

// A byte of the file becomes at most 24 bytes of positions (x, y and z of one byte each: 8) or 12 of a triangle, and
// growing arrays double; the header's text costs a constant.
constexpr std::size_t kMostPerByte = 32;
constexpr std::size_t kConstant = 1 << 14;

/// Two quads and a triangle with all kinds of properties, in the smallest types, so that damage hits something.
Mesh smallMesh() {
  plytest::Random random(1);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.vertexNormals.assign(4, Vec3f(0, 0, 1));
  mesh.sourcePolygons = {0, 0};
  mesh.vertexProperties.push_back(plytest::randomColumn(random, "red", ScalarType::uint8, false, 4));
  mesh.vertexProperties.push_back(plytest::randomColumn(random, "l", ScalarType::int16, true, 4));
  mesh.faceProperties.push_back(plytest::randomColumn(random, "l", ScalarType::uint8, true, 2));
  mesh.elements.push_back({"edge", 2, {plytest::randomColumn(random, "v", ScalarType::float64, false, 2)}});
  mesh.comments = {"c"};
  return mesh;
}

/// Hand-made files with what the writer does not make: polygons and strips.
std::vector<std::string> samples(const plytest::Folder& folder) {
  std::vector<std::string> files = {
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty char x\nproperty char y\nproperty char z\nelement face 2\n"
      "property list uchar uchar vertex_index\nproperty uchar q\nend_header\n0 0 0\n4 0 0\n4 4 0\n1 1 0\n0 4 0\n"
      "5 0 1 2 3 4 7\n3 0 1 2 8\n",
      std::string("ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty "
                  "uchar z\nelement tristrips 1\nproperty list short short vertex_indices\nend_header\n") +
          std::string("\0\0\0\1\0\0\0\1\0\0\5\0\0\0\1\0\2\377\377\0\1", 21)};
  Progress progress;
  for (const PlyEncoding e : {PlyEncoding::ascii, PlyEncoding::binaryLittleEndian, PlyEncoding::binaryBigEndian}) {
    writePly(folder.path("sample.ply"), smallMesh(), {e}, progress);
    files.push_back(plytest::readBytes(folder.path("sample.ply")));
  }
  return files;
}

/// True for a valid mesh, false for an Error; anything else fails the test.
bool readDamaged(const plytest::Folder& folder, const std::string& bytes) {
  const std::string path = folder.write("damaged.ply", bytes);
  largestAllocation = 0;
  bool valid = true;
  try {
    Progress progress;
    const Mesh mesh = readPly(path, progress);
    const std::size_t largest = largestAllocation;
    CHECK(largest <= kMostPerByte * bytes.size() + kConstant);
    viewMesh(mesh);  // throws unless all arrays have the sizes that mesh.h states
    for (const Vec3d& p : mesh.positions) valid = valid && isFinite(p);
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t) valid = valid && v < mesh.positions.size();
    }
    CHECK(valid);
  } catch (const Error& e) {
    CHECK(largestAllocation <= kMostPerByte * bytes.size() + kConstant);
    CHECK(e.kind() == ErrorKind::work);
    CHECK(e.parts().file == path);
    CHECK_FALSE(e.parts().cause.empty());
    valid = false;
  }
  return valid;
}

}  // namespace

TEST_CASE("PLY damage: files cut at every length") {
  const plytest::Folder folder;
  for (const std::string& file : samples(folder)) {
    REQUIRE(readDamaged(folder, file));
    // Text may lose its last line end and digits of its last number.
    const bool text = file.find("format ascii") != file.npos;
    const std::size_t needed = text ? file.find_last_of(" \n", file.size() - 2) + 2 : file.size();
    for (std::size_t size = 0; size < file.size(); ++size) {
      INFO(size << " bytes of\n" << file);
      const bool valid = readDamaged(folder, file.substr(0, size));
      if (size < needed) CHECK_FALSE(valid);
    }
  }
}

TEST_CASE("PLY damage: single bytes changed") {
  const plytest::Folder folder;
  plytest::Random random(2);
  std::size_t errors = 0, meshes = 0;
  for (const std::string& file : samples(folder)) {
    for (std::size_t at = 0; at < file.size(); ++at) {
      for (const int change : {1, 0x80, 0xFF, static_cast<int>(1 + random.below(255))}) {
        std::string damaged = file;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        INFO("byte " << at << " xor " << change << " of\n" << file);
        ++(readDamaged(folder, damaged) ? meshes : errors);
      }
    }
  }
  CHECK(errors > 1000);
  CHECK(meshes > 1000);
}

TEST_CASE("PLY damage: a header may promise anything") {
  const plytest::Folder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string start = "ply\nformat " + format + " 1.0\nelement vertex ";
    const std::string xyz = "\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
    for (const std::string count : {"4000000000", "4294967294", "18446744073709551615"}) {
      CHECK_FALSE(readDamaged(folder, start + count + xyz + "end_header\n1 2 3\n"));
      const std::string lists = "element face " + count + "\nproperty list uchar uchar vertex_indices\nend_header\n";
      CHECK_FALSE(readDamaged(folder, start + "0" + xyz + lists + "1 2 3\n"));
      const std::string other = "element e " + count + "\nproperty list uint double l\nproperty int i\nend_header\n";
      CHECK_FALSE(readDamaged(folder, start + "0" + xyz + other + "1 2 3\n"));
      CHECK(readDamaged(folder, start + "0" + xyz + "element nothing " + count + "\nend_header\n"));
    }
  }
}
