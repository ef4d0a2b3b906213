// What the tests of PLY files share: files in a folder of their own, random meshes, bitwise comparison.
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "mesh/mesh.h"

namespace shbake::plytest {

/// A folder that is removed with all its files.
class Folder {
 public:
  Folder() {
    // In memory where the system has such a folder: thousands of small files are written through to disk otherwise.
    const std::filesystem::path memory = "/dev/shm";
    const auto parent = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    std::string pattern = (parent / "shbake-ply-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for temporary files");
    folder_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(folder_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

 private:
  std::filesystem::path folder_;
};

inline std::string readBytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The parts of the Error that `work` throws; none when it throws none.
template <class F>
std::optional<Error::Parts> errorOf(F&& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.parts();
  }
  return {};
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The first member in which two meshes differ by a bit, their source apart; empty when there is none.
inline std::string difference(const Mesh& a, const Mesh& b) {
  if (!sameBits(a.positions, b.positions)) return "positions";
  if (!sameBits(a.triangles, b.triangles)) return "triangles";
  if (a.doublePositions != b.doublePositions) return "doublePositions";
  if (!sameBits(a.vertexNormals, b.vertexNormals)) return "vertexNormals";
  if (!sameBits(a.cornerNormals, b.cornerNormals)) return "cornerNormals";
  if (!sameBits(a.vertexColors, b.vertexColors)) return "vertexColors";
  if (a.vertexColorEncoding != b.vertexColorEncoding) return "vertexColorEncoding";
  if (!sameBits(a.faceColors, b.faceColors)) return "faceColors";
  if (a.faceColorEncoding != b.faceColorEncoding) return "faceColorEncoding";
  if (a.sourcePolygons != b.sourcePolygons) return "sourcePolygons";
  if (a.vertexProperties != b.vertexProperties) return "vertexProperties";
  if (a.faceProperties != b.faceProperties) return "faceProperties";
  if (a.elements != b.elements) return "elements";
  return a.comments != b.comments ? "comments" : "";
}

/// A stream of random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t bits() { return hashBits(seed_, next_++); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
  double unit() { return hashUnit(seed_, next_++); }
  /// Any finite float: all exponents and both signs.
  float anyFloat() {
    for (;;) {
      const auto word = static_cast<std::uint32_t>(bits());
      float value;
      std::memcpy(&value, &word, sizeof(value));
      if (value - value == 0) return value;
    }
  }
  double anyDouble() {
    for (;;) {
      const std::uint64_t word = bits();
      double value;
      std::memcpy(&value, &word, sizeof(value));
      if (value - value == 0) return value;
    }
  }

 private:
  std::uint64_t seed_, next_ = 0;
};

/// A column of `items` random scalars or lists of 0..4 of them; floats are finite.
inline Property randomColumn(Random& random, std::string name, ScalarType type, bool isList, std::size_t items) {
  constexpr ScalarType counts[] = {ScalarType::int8,   ScalarType::uint8, ScalarType::int16,
                                   ScalarType::uint16, ScalarType::int32, ScalarType::uint32};
  Property column{std::move(name), type, isList, ScalarType::uint8, {}, {}};
  if (isList) {
    column.countType = counts[random.below(6)];
    column.listStarts = {0};
  }
  for (std::size_t i = 0; i < items; ++i) {
    const std::size_t count = isList ? random.below(5) : 1;
    for (std::size_t k = 0; k < count; ++k) {
      std::uint64_t word = random.bits();
      if (type == ScalarType::float32) {
        const float value = random.anyFloat();
        std::memcpy(&word, &value, sizeof(value));
      } else if (type == ScalarType::float64) {
        const double value = random.anyDouble();
        std::memcpy(&word, &value, sizeof(value));
      }
      const auto* bytes = reinterpret_cast<const std::byte*>(&word);
      column.values.insert(column.values.end(), bytes, bytes + scalarSize(type));
    }
    if (isList) column.listStarts.push_back(column.listStarts.back() + count);
  }
  return column;
}

/// Columns of all types, scalars and lists.
inline std::vector<Property> randomColumns(Random& random, const std::string& prefix, std::size_t items) {
  std::vector<Property> columns;
  for (int type = 0; type < 8; ++type) {
    for (const bool list : {false, true}) {
      const std::string name = prefix + (list ? "_list_" : "_") + std::to_string(type);
      columns.push_back(randomColumn(random, name, static_cast<ScalarType>(type), list, items));
    }
  }
  return columns;
}

/// A mesh of random triangles that uses all that a Mesh can hold; `seed` also decides which optional parts it has.
inline Mesh randomMesh(std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  mesh.doublePositions = random.below(2) == 0;
  const std::size_t vertices = 3 + random.below(20), faces = random.below(25);
  for (std::size_t v = 0; v < vertices; ++v) {
    Vec3d p(random.anyDouble(), random.anyDouble(), random.anyDouble());
    if (!mesh.doublePositions) p = Vec3d(random.anyFloat(), random.anyFloat(), random.anyFloat());
    mesh.positions.push_back(p);
  }
  const auto vertex = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
  const auto vector = [&] { return Vec3f(random.anyFloat(), random.anyFloat(), random.anyFloat()); };
  for (std::size_t f = 0; f < faces; ++f) mesh.triangles.push_back({vertex(), vertex(), vertex()});
  if (random.below(2) == 0) mesh.vertexNormals.assign(vertices, vector());
  if (random.below(2) == 0) {
    for (std::size_t c = 0; c < 3 * faces; ++c) mesh.cornerNormals.push_back(vector());
    for (std::size_t f = 0; f < faces; ++f) mesh.sourcePolygons.push_back(static_cast<std::uint32_t>(f / 2));
  }
  mesh.vertexProperties = randomColumns(random, "v", vertices);
  mesh.faceProperties = randomColumns(random, "f", faces);
  mesh.elements.push_back({"edge", 7, randomColumns(random, "e", 7)});
  mesh.elements.push_back({"material", 0, randomColumns(random, "m", 0)});
  mesh.elements.push_back({"marker", 3, {}});
  mesh.comments = {"made at random", "", " two  blanks ", "obj_info num_cols 512"};
  return mesh;
}

}  // namespace shbake::plytest
