// 3D Systems, "StereoLithography interface specification", 1988. Binary: 80 bytes of any content, the number of
// triangles, then for each one the normal and three corners as floats and two bytes of attribute, all little endian.
#include "mesh/stl_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "mesh/column.h"
#include "mesh/file_bytes.h"
#include "mesh/polygon_collector.h"
#include "mesh/position_precision.h"
#include "mesh/position_welder.h"
#include "mesh/text_scanner.h"

namespace shbake {
namespace {

constexpr std::size_t kHeaderBytes = 80, kCountBytes = 4, kTriangleBytes = 50;
constexpr std::size_t kReportTriangles = 1 << 14;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

template <class T>
T load(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

bool equalWords(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(),
                    [](char x, char y) { return std::tolower(static_cast<unsigned char>(x)) == y; });
}

/// The triangles that a binary file has room for, checked against those that it promises.
std::uint32_t countTriangles(const std::string& path, std::string_view bytes, std::vector<std::string>& warnings) {
  if (bytes.size() < kHeaderBytes + kCountBytes) {
    throw Error({.file = path,
                 .place = "header",
                 .cause = "the file has " + std::to_string(bytes.size()) + " bytes, but a binary STL at least 84",
                 .remedy = "check that it is complete"});
  }
  const auto promised = load<std::uint32_t>(bytes.data() + kHeaderBytes);
  const std::uint64_t room = (bytes.size() - kHeaderBytes - kCountBytes) / kTriangleBytes;
  if (promised > room) {
    throw Error({.file = path,
                 .place = "header",
                 .cause = "promises " + std::to_string(promised) + " triangles, but the file ends after " +
                          std::to_string(room),
                 .remedy = "check that it is complete and an STL file"});
  }
  const std::uint64_t used = kHeaderBytes + kCountBytes + std::uint64_t{promised} * kTriangleBytes;
  if (used < bytes.size()) {
    warnings.push_back(std::to_string(bytes.size() - used) + " bytes after the last triangle were left out");
  }
  return promised;
}

Mesh readBinary(const std::string& path, std::string_view bytes, Progress& progress) {
  Mesh mesh;
  mesh.source = path;
  const std::uint32_t count = countTriangles(path, bytes, mesh.warnings);
  progress.begin("parsing", count, "triangles");
  PositionWelder welder(count / 2 + 2);  // a closed surface has about half as many vertices as triangles
  mesh.triangles.resize(count);
  std::vector<std::uint16_t> attributes(count);
  bool anyAttribute = false;
  const char* at = bytes.data() + kHeaderBytes + kCountBytes;
  for (std::uint32_t i = 0; i < count; ++i, at += kTriangleBytes) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto p = load<std::array<float, 3>>(at + 12 * (corner + 1));
      const Vec3f position(p[0], p[1], p[2]);
      if (!isFinite(position)) {
        throw Error({.file = path,
                     .place = "triangle " + std::to_string(i),
                     .cause = "a coordinate is not finite",
                     .remedy = "remove the triangle or correct it in the program that wrote the file"});
      }
      mesh.triangles[i][corner] = welder.add(Vec3d(position));
    }
    attributes[i] = load<std::uint16_t>(at + 48);
    anyAttribute = anyAttribute || attributes[i] != 0;
    if ((i + 1) % kReportTriangles == 0) progress.advance(kReportTriangles);
  }
  mesh.positions = welder.takePositions();
  if (anyAttribute) mesh.faceProperties.push_back(scalarColumn("stl_attribute", attributes));
  progress.end();
  return mesh;
}

/// A loop of corners as it stands in the file, before positions have been welded.
class AsciiStlReader {
 public:
  AsciiStlReader(const std::string& path, std::string_view text, Progress& progress)
      : in_(path, text, TextScanner::Continuation::none, progress) {}

  void read() {
    if (!readKeyword("solid")) in_.fail("the file does not begin with solid", "check that it is an STL file");
    while (in_.nextLine()) readStatement();
    if (inFacet_) in_.fail("the file ends inside a facet", "check that it is complete");
  }

  bool ended() const { return ended_; }
  std::vector<Vec3d> takePositions() { return welder_.takePositions(); }
  const std::vector<std::uint32_t>& corners() const { return corners_; }
  const std::vector<std::size_t>& loopStarts() const { return loopStarts_; }

 private:
  bool readKeyword(std::string_view keyword);
  void readStatement();
  void endLoop();

  TextScanner in_;
  PositionWelder welder_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> loopStarts_{0};
  bool inFacet_ = false, ended_ = false;
};

bool AsciiStlReader::readKeyword(std::string_view keyword) {
  std::string_view word;
  return in_.nextWordAnywhere(word) && equalWords(word, keyword);
}

void AsciiStlReader::readStatement() {
  std::string_view word;
  if (!in_.nextWord(word)) return;
  if (equalWords(word, "vertex")) {
    if (!inFacet_) in_.fail("a vertex outside a facet", "export the mesh again");
    corners_.push_back(welder_.add(in_.numbers3("a coordinate")));
  } else if (equalWords(word, "facet")) {
    if (inFacet_) in_.fail("a facet inside a facet", "export the mesh again");
    inFacet_ = true;
  } else if (equalWords(word, "endfacet")) {
    endLoop();
  } else if (equalWords(word, "solid") || equalWords(word, "endsolid")) {
    if (inFacet_) in_.fail("a solid begins or ends inside a facet", "check that the file is complete");
    ended_ = equalWords(word, "endsolid");
  } else if (!equalWords(word, "outer") && !equalWords(word, "endloop")) {
    in_.fail(quotedWord(word) + " is no keyword of STL", "export the mesh again, or convert it to PLY");
  }
}

void AsciiStlReader::endLoop() {
  if (!inFacet_) in_.fail("endfacet without a facet", "export the mesh again");
  if (corners_.size() - loopStarts_.back() < 3) in_.fail("a facet with fewer than three vertices", "export it again");
  loopStarts_.push_back(corners_.size());
  inFacet_ = false;
}

Mesh readAscii(const std::string& path, std::string_view text, Progress& progress) {
  progress.begin("parsing", static_cast<double>(text.size()), "bytes");
  AsciiStlReader reader(path, text, progress);
  reader.read();
  progress.end();
  Mesh mesh;
  mesh.source = path;
  mesh.positions = reader.takePositions();
  const std::vector<std::size_t>& starts = reader.loopStarts();
  mesh.triangles.reserve(starts.size() - 1);
  PolygonCollector polygons(mesh);
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    polygons.add({reader.corners().data() + starts[i], reader.corners().data() + starts[i + 1]});
  }
  if (!reader.ended()) mesh.warnings.emplace_back("the file ends without endsolid and may be cut short");
  mesh.doublePositions = positionsNeedDouble(mesh.positions);
  return mesh;
}

}  // namespace

bool isBinaryStl(std::string_view start, std::uint64_t size) {
  if (start.size() < kHeaderBytes + kCountBytes) return false;
  const auto count = load<std::uint32_t>(start.data() + kHeaderBytes);
  return size == kHeaderBytes + kCountBytes + std::uint64_t{count} * kTriangleBytes;
}

bool isAsciiStl(std::string_view start) {
  const auto firstWord = [](std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text.substr(0, text.find_first_of(" \t\r\n"));
  };
  if (!equalWords(firstWord(start), "solid")) return false;
  start.remove_prefix(std::min(start.find_first_of("\r\n"), start.size()));
  const std::string_view next = firstWord(start);
  return equalWords(next, "facet") || equalWords(next, "endsolid");
}

Mesh readStl(const std::string& path, Progress& progress) {
  const FileBytes file(path, progress);
  const std::string_view bytes = file.view();
  Mesh mesh = !isBinaryStl(bytes, bytes.size()) && isAsciiStl(bytes) ? readAscii(path, bytes, progress)
                                                                     : readBinary(path, bytes, progress);
  if (mesh.triangles.empty()) {
    throw Error({.file = path, .cause = "holds no triangles", .remedy = "check the program that wrote it"});
  }
  return mesh;
}

}  // namespace shbake
