// The statements are those of Wavefront's Advanced Visualizer manual, appendix B1. The text is scanned twice, first for
// vertices, then for faces, so that faces may refer to vertices further down.
#include "mesh/obj_reader.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "mesh/column.h"
#include "mesh/file_bytes.h"
#include "mesh/obj_material_use.h"
#include "mesh/polygon_collector.h"
#include "mesh/position_precision.h"
#include "mesh/text_colors.h"
#include "mesh/text_scanner.h"

namespace shbake {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Statements that say how to group, shade or display polygons and hold none themselves.
constexpr std::string_view kSilent[] = {"g",        "o",   "s",      "mg",     "bevel",      "c_interp",
                                        "d_interp", "lod", "maplib", "usemap", "shadow_obj", "trace_obj"};

struct TexturePoint {
  float u, v;
};

/// How many statements of a kind were met.
struct Counts {
  std::size_t vertices = 0, textures = 0, normals = 0;
};

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view text, Progress& progress)
      : text_(text), progress_(progress), polygons_(mesh_) {
    mesh_.source = path;
  }

  Mesh read() {
    progress_.begin("parsing", 2.0 * static_cast<double>(text_.size()), "bytes");
    readVertices();
    readFaces();
    progress_.end();
    settleVertexColors();
    if (anyTexture_) mesh_.faceProperties.push_back(listColumn("texcoord", texcoords_, 6));
    materials_.settle(mesh_, progress_);
    addWarnings();
    mesh_.doublePositions = positionsNeedDouble(mesh_.positions);
    return std::move(mesh_);
  }

 private:
  void readVertices();
  void readVertex(TextScanner& in);
  void readTexture(TextScanner& in);
  void readNormal(TextScanner& in);
  void readFaces();
  void readFace(TextScanner& in);
  void readCorner(TextScanner& in, std::string_view word);
  void keepCorners(std::span<const Triangle> cut);
  void settleVertexColors();
  void addWarnings();

  std::string_view text_;
  Progress& progress_;
  Mesh mesh_;
  PolygonCollector polygons_;

  std::vector<Vec3f> normals_;
  std::vector<TexturePoint> textures_;
  std::size_t faceLines_ = 0;

  // The face being read: indices of its corners, kNone where a corner has none.
  std::vector<std::uint32_t> cornerVertices_, cornerTextures_, cornerNormals_;
  Counts soFar_;
  bool anyTexture_ = false, anyNormal_ = false;
  std::vector<float> texcoords_;  // 6 a triangle, or empty

  ObjMaterialUse materials_;

  std::size_t weighted_ = 0, badNormals_ = 0;
  std::size_t passedOver_ = 0;
  std::string firstPassedOver_;
};

void ObjReader::readVertices() {
  TextScanner in(mesh_.source, text_, TextScanner::Continuation::backslash, progress_);
  while (in.nextLine()) {
    std::string_view keyword;
    if (!in.nextWord(keyword)) continue;
    if (keyword == "v") {
      readVertex(in);
    } else if (keyword == "vn") {
      readNormal(in);
    } else if (keyword == "vt") {
      readTexture(in);
    } else if (keyword == "f" || keyword == "fo") {
      ++faceLines_;
    } else if (keyword == "mtllib") {
      materials_.addLibrary(in.restOfLine());
    } else if (keyword != "usemtl" && std::find(std::begin(kSilent), std::end(kSilent), keyword) == std::end(kSilent)) {
      if (passedOver_++ == 0) firstPassedOver_ = quotedWord(keyword) + " on line " + std::to_string(in.lineNumber());
    }
  }
  if (mesh_.positions.empty()) {
    throw Error({.file = mesh_.source, .cause = "holds no vertices", .remedy = "check that it is an intact OBJ file"});
  }
}

void ObjReader::readVertex(TextScanner& in) {
  mesh_.positions.push_back(in.numbers3("a coordinate"));
  if (mesh_.positions.size() == kNone)
    in.fail("the file holds more than 4294967294 vertices", "split the mesh into parts");
  double extra[4] = {};
  int count = 0;
  for (std::string_view word; in.nextWord(word); ++count) {
    if (count == 4) in.fail("more than 7 numbers for a vertex", "write x y z, then at most r g b a");
    extra[count] = in.toNumber(word, count == 0 ? "a weight or colour" : "a colour");
  }
  if (count == 2) in.fail("5 numbers for a vertex", "write x y z, or x y z r g b for a colour");
  weighted_ += count == 1 && extra[0] != 1.0;
  if (count >= 3) {
    mesh_.vertexColors.resize(mesh_.positions.size() - 1, kNoColor);
    mesh_.vertexColors.push_back(Rgb(Vec3d(extra[0], extra[1], extra[2])));
  }
}

void ObjReader::readTexture(TextScanner& in) {
  const double u = in.number("a texture coordinate");
  std::string_view word;
  const double v = in.nextWord(word) ? in.toNumber(word, "a texture coordinate") : 0.0;
  textures_.push_back({static_cast<float>(u), static_cast<float>(v)});
}

void ObjReader::readNormal(TextScanner& in) {
  double n[3] = {};
  for (double& c : n) {
    std::string_view word;
    // "nan" is common in files of scanners: such a normal is as good as missing. What is no number at all is a mistake.
    if (!in.nextWord(word) || !parseNumber(word, c)) in.fail("a normal needs three numbers", "export the mesh again");
  }
  Vec3f normal{Vec3d(n[0], n[1], n[2])};
  if (!isFinite(normal)) {
    ++badNormals_;
    normal = {};
  }
  normals_.push_back(normal);
}

void ObjReader::readFaces() {
  mesh_.triangles.reserve(faceLines_);
  TextScanner in(mesh_.source, text_, TextScanner::Continuation::backslash, progress_);
  while (in.nextLine()) {
    std::string_view keyword;
    if (!in.nextWord(keyword)) continue;
    if (keyword == "f" || keyword == "fo") {
      readFace(in);
    } else if (keyword == "v") {
      ++soFar_.vertices;
    } else if (keyword == "vt") {
      ++soFar_.textures;
    } else if (keyword == "vn") {
      ++soFar_.normals;
    } else if (keyword == "usemtl") {
      materials_.use(in.restOfLine());
    }
  }
}

void ObjReader::readFace(TextScanner& in) {
  cornerVertices_.clear();
  cornerTextures_.clear();
  cornerNormals_.clear();
  for (std::string_view word; in.nextWord(word);) readCorner(in, word);
  keepCorners(polygons_.add(cornerVertices_));
}

/// The index of a corner in OBJ's counting as one of `total` items from 0; `soFar` of them stand above the current
/// line.
std::uint32_t resolveIndex(const TextScanner& in, std::int64_t index, std::size_t soFar, std::size_t total,
                           const char* what) {
  if (index == 0) in.fail(std::string("index 0 of a ") + what, "OBJ counts from 1; export the mesh again");
  const std::int64_t i = index > 0 ? index - 1 : static_cast<std::int64_t>(soFar) + index;
  const std::int64_t limit = static_cast<std::int64_t>(index > 0 ? total : soFar);
  if (i < 0 || i >= limit) {
    in.fail("index " + std::to_string(index) + " of a " + what + ", but there are " + std::to_string(limit) +
                (index > 0 ? " in the file" : " above this line"),
            "check that the file is complete");
  }
  return static_cast<std::uint32_t>(i);
}

void ObjReader::readCorner(TextScanner& in, std::string_view word) {
  std::int64_t indices[3] = {};
  bool given[3] = {};
  const char *at = word.data(), *end = at + word.size();
  for (int part = 0; part < 3; ++part) {
    if (at != end && *at != '/') {
      const auto [next, error] = std::from_chars(at + (*at == '+'), end, indices[part]);
      if (error != std::errc()) break;
      given[part] = true;
      at = next;
    }
    if (at == end || *at != '/' || part == 2) break;
    ++at;
  }
  if (at != end || !given[0])
    in.fail(quotedWord(word) + " is not a corner of a face", "write v, v/vt, v//vn or v/vt/vn");
  cornerVertices_.push_back(resolveIndex(in, indices[0], soFar_.vertices, mesh_.positions.size(), "vertex"));
  cornerTextures_.push_back(
      given[1] ? resolveIndex(in, indices[1], soFar_.textures, textures_.size(), "texture coordinate") : kNone);
  cornerNormals_.push_back(given[2] ? resolveIndex(in, indices[2], soFar_.normals, normals_.size(), "normal") : kNone);
  anyTexture_ = anyTexture_ || given[1];
  anyNormal_ = anyNormal_ || given[2];
}

void ObjReader::keepCorners(std::span<const Triangle> cut) {
  const std::size_t before = mesh_.triangles.size() - cut.size();
  if (anyNormal_) {
    mesh_.cornerNormals.resize(3 * before);
    for (const Triangle& t : cut) {
      for (const std::uint32_t c : t) {
        mesh_.cornerNormals.push_back(cornerNormals_[c] == kNone ? Vec3f() : normals_[cornerNormals_[c]]);
      }
    }
  }
  if (anyTexture_) {
    texcoords_.resize(6 * before);
    for (const Triangle& t : cut) {
      for (const std::uint32_t c : t) {
        const TexturePoint p = cornerTextures_[c] == kNone ? TexturePoint{0, 0} : textures_[cornerTextures_[c]];
        texcoords_.insert(texcoords_.end(), {p.u, p.v});
      }
    }
  }
  materials_.addTriangles(cut.size());
}

void ObjReader::settleVertexColors() {
  if (mesh_.vertexColors.empty()) return;
  mesh_.vertexColors.resize(mesh_.positions.size(), kNoColor);
  mesh_.vertexColorEncoding = settleTextColors(mesh_.vertexColors, "vertex colours", mesh_.warnings);
}

void ObjReader::addWarnings() {
  const auto warn = [&](std::size_t count, const std::string& what) {
    if (count > 0) mesh_.warnings.push_back(std::to_string(count) + what);
  };
  warn(polygons_.withoutArea(), " faces with fewer than three corners were left out");
  warn(weighted_, " vertices have a weight (fourth coordinate) other than 1, which was left out");
  warn(badNormals_, " normals are not finite and were taken as missing");
  warn(anyNormal_ ? 0 : normals_.size(), " normals are referred to by no face and were left out");
  warn(passedOver_, " statements that hold no polygons were passed over (the first is " + firstPassedOver_ + ")");
}

}  // namespace

Mesh readObj(const std::string& path, Progress& progress) {
  const FileBytes file(path, progress);
  return ObjReader(path, file.view(), progress).read();
}

}  // namespace shbake
