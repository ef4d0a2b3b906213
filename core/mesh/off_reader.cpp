// "The Geomview Manual", Geometry Center, University of Minnesota, chapter "OFF: object file format".
#include "mesh/off_reader.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "mesh/column.h"
#include "mesh/file_bytes.h"
#include "mesh/polygon_collector.h"
#include "mesh/position_precision.h"
#include "mesh/text_colors.h"
#include "mesh/text_scanner.h"

namespace shbake {
namespace {

/// What the letters before "OFF" announce.
struct OffKind {
  bool texture = false, color = false, normal = false, fourth = false, anyDimension = false;
};

/// Reads a header word; false when it is none.
bool parseHeader(std::string_view word, OffKind& kind) {
  if (!word.ends_with("OFF")) return false;
  word.remove_suffix(3);
  if (word.starts_with("ST")) {
    kind.texture = true;
    word.remove_prefix(2);
  }
  for (const char letter : word) {
    bool* flag = letter == 'C'   ? &kind.color
                 : letter == 'N' ? &kind.normal
                 : letter == '4' ? &kind.fourth
                 : letter == 'n' ? &kind.anyDimension
                                 : nullptr;
    if (!flag || std::exchange(*flag, true)) return false;
  }
  return true;
}

class OffReader {
 public:
  OffReader(const std::string& path, std::string_view text, Progress& progress)
      : size_(text.size()),
        progress_(progress),
        in_(path, text, TextScanner::Continuation::none, progress),
        polygons_(mesh_) {
    mesh_.source = path;
  }

  Mesh read() {
    progress_.begin("parsing", static_cast<double>(size_), "bytes");
    readHeader();
    for (std::uint32_t i = 0; i < vertices_; ++i) readVertex(i);
    for (std::uint32_t i = 0; i < faces_; ++i) readFace(i);
    progress_.end();
    settle();
    return std::move(mesh_);
  }

 private:
  void readHeader();
  void reserve();
  void readVertex(std::uint32_t index);
  void readFace(std::uint32_t index);
  std::string_view wordOf(const char* kind, std::uint32_t index, std::uint32_t count);
  std::size_t restOfNumbers(std::span<double> numbers, const char* what);
  void settle();

  std::size_t size_;
  Progress& progress_;
  TextScanner in_;
  Mesh mesh_;
  PolygonCollector polygons_;
  OffKind kind_;
  std::uint32_t vertices_ = 0, faces_ = 0;
  std::vector<float> textureU_, textureV_;  // of each vertex, or empty
  std::vector<std::uint32_t> corners_;
  std::size_t mapped_ = 0;
  bool anyFaceColor_ = false, anyVertexColor_ = false;
};

void OffReader::readHeader() {
  std::string_view word;
  if (!in_.nextWordAnywhere(word)) in_.fail("the file holds no OFF header", "check that it is complete");
  if (parseHeader(word, kind_)) {
    if (kind_.fourth || kind_.anyDimension) {
      in_.fail(quotedWord(word) + " holds points that are not three-dimensional", "convert it to OFF");
    }
    if (!in_.nextWordAnywhere(word)) in_.fail("the file ends after the header", "check that it is complete");
    if (word == "BINARY") {
      in_.fail("binary OFF is not read, since programs disagree on its byte order", "convert it to OFF text or to PLY");
    }
  }
  vertices_ = in_.toCount(word, "the number of vertices");
  if (!in_.nextWordAnywhere(word)) in_.fail("the number of faces is missing", "check that the file is complete");
  faces_ = in_.toCount(word, "the number of faces");
  if (in_.nextWord(word)) in_.toCount(word, "the number of edges");
  if (!in_.atLineEnd()) in_.fail("more than three counts on a line", "write vertices, faces and edges");
  if (vertices_ == 0) in_.fail("the file holds no vertices", "check the program that wrote it");
  reserve();
}

/// Makes room for what the counts promise, but no more than the file can hold.
void OffReader::reserve() {
  constexpr std::size_t kShortestVertex = 6, kShortestFace = 8;  // "0 0 0\n", "3 0 0 0\n"
  mesh_.positions.reserve(std::min<std::size_t>(vertices_, size_ / kShortestVertex));
  mesh_.triangles.reserve(std::min<std::size_t>(faces_, size_ / kShortestFace));
}

/// The next word in the description of vertex or face `index`.
std::string_view OffReader::wordOf(const char* kind, std::uint32_t index, std::uint32_t count) {
  std::string_view word;
  if (!in_.nextWordAnywhere(word)) {
    in_.fail(std::string("the file ends in ") + kind + " " + std::to_string(index) + ", but the header promises " +
                 std::to_string(count),
             "check that the file is complete");
  }
  return word;
}

/// The numbers up to the end of the line, at most as many as there is room for; tells how many there were.
std::size_t OffReader::restOfNumbers(std::span<double> numbers, const char* what) {
  std::size_t count = 0;
  for (std::string_view word; in_.nextWord(word); ++count) {
    if (count == numbers.size()) in_.fail(std::string("too many numbers for ") + what, "check the header's letters");
    numbers[count] = in_.toNumber(word, what);
  }
  return count;
}

void OffReader::readVertex(std::uint32_t index) {
  const auto number = [&](const char* what) { return in_.toNumber(wordOf("vertex", index, vertices_), what); };
  const auto numbers3 = [&](const char* what) {
    const double x = number(what), y = number(what), z = number(what);
    return Vec3d(x, y, z);
  };
  mesh_.positions.push_back(numbers3("a coordinate"));
  if (kind_.normal) mesh_.vertexNormals.push_back(Vec3f(numbers3("a normal")));
  const std::size_t texture = kind_.texture ? 2 : 0;
  std::array<double, 6> rest{};
  if (kind_.color) {
    const std::size_t count = restOfNumbers(rest, "a colour");
    if (count != texture && count != texture + 3 && count != texture + 4) {
      in_.fail("a vertex with " + std::to_string(count) + " numbers after its position" +
                   (kind_.normal ? " and normal" : ""),
               "give a colour as r g b or r g b a");
    }
    mesh_.vertexColors.push_back(count == texture ? kNoColor : Rgb(Vec3d(rest[0], rest[1], rest[2])));
    anyVertexColor_ = anyVertexColor_ || count > texture;
    std::rotate(rest.begin(), rest.begin() + (count - texture), rest.end());
  } else if (kind_.texture) {
    rest[0] = number("a texture coordinate");
    rest[1] = number("a texture coordinate");
  }
  if (kind_.texture) {
    textureU_.push_back(static_cast<float>(rest[0]));
    textureV_.push_back(static_cast<float>(rest[1]));
  }
}

void OffReader::readFace(std::uint32_t index) {
  const std::uint32_t n = in_.toCount(wordOf("face", index, faces_), "the number of corners");
  corners_.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t vertex = in_.toCount(wordOf("face", index, faces_), "a vertex index");
    if (vertex >= vertices_) {
      in_.fail("vertex index " + std::to_string(vertex) + " in face " + std::to_string(index) + ", but there are " +
                   std::to_string(vertices_) + " vertices, counted from 0",
               "export the mesh again");
    }
    corners_.push_back(vertex);
  }
  std::array<double, 4> color{};
  const std::size_t count = restOfNumbers(color, "the colour of a face");
  if (count == 2) in_.fail("two numbers after the corners of a face", "give a colour as r g b or r g b a");
  mapped_ += count == 1;
  anyFaceColor_ = anyFaceColor_ || count >= 3;
  const std::size_t triangles = polygons_.add(corners_).size();
  if (anyFaceColor_) {
    mesh_.faceColors.resize(mesh_.triangles.size() - triangles, kNoColor);
    mesh_.faceColors.insert(mesh_.faceColors.end(), triangles,
                            count >= 3 ? Rgb(Vec3d(color[0], color[1], color[2])) : kNoColor);
  }
}

void OffReader::settle() {
  if (std::string_view word; in_.nextWordAnywhere(word)) {
    mesh_.warnings.push_back("what follows the last face, from line " + std::to_string(in_.lineNumber()) +
                             " on, was left out");
  }
  if (anyVertexColor_) {
    mesh_.vertexColorEncoding = settleTextColors(mesh_.vertexColors, "vertex colours", mesh_.warnings);
  } else {
    mesh_.vertexColors.clear();
  }
  if (anyFaceColor_) mesh_.faceColorEncoding = settleTextColors(mesh_.faceColors, "face colours", mesh_.warnings);
  if (kind_.texture) {
    mesh_.vertexProperties.push_back(scalarColumn("texture_u", textureU_));
    mesh_.vertexProperties.push_back(scalarColumn("texture_v", textureV_));
  }
  if (polygons_.withoutArea() > 0) {
    mesh_.warnings.push_back(std::to_string(polygons_.withoutArea()) +
                             " faces with fewer than three corners were left out");
  }
  if (mapped_ > 0) {
    mesh_.warnings.push_back(std::to_string(mapped_) + " faces have an index of a colour map, which was left out");
  }
  mesh_.doublePositions = positionsNeedDouble(mesh_.positions);
}

}  // namespace

bool isOffHeader(std::string_view word) {
  OffKind kind;
  return parseHeader(word, kind);
}

Mesh readOff(const std::string& path, Progress& progress) {
  const FileBytes file(path, progress);
  return OffReader(path, file.view(), progress).read();
}

}  // namespace shbake
