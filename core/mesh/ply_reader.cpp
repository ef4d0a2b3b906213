#include "mesh/ply_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/ply_body.h"
#include "mesh/ply_columns.h"
#include "mesh/polygon_triangulation.h"

namespace shbake {
namespace {

// A face of three 1-byte indices with a 1-byte length: no file holds more faces than a quarter of its bytes.
constexpr std::uint64_t kLeastFaceBytes = 4;
// The last 32-bit number stands for "none" in index arrays.
constexpr std::uint64_t kMostItems = std::numeric_limits<std::uint32_t>::max() - 1;

/// Builds a mesh while the body is read in the order of its elements.
class MeshBuilder {
 public:
  MeshBuilder(PlyInput& input, PlyHeader header, Progress& progress)
      : input_(input), header_(std::move(header)), progress_(progress), body_(input, header_, progress) {
    checkVertices();
    chooseFaces();
  }

  Mesh build() {
    mesh_.source = input_.path();
    mesh_.comments = header_.comments;
    for (const PlyElement& element : header_.elements) {
      if (&element == vertices_) {
        readVertices();
      } else if (&element == faces_) {
        strips_ ? readStrips() : readFaces();
      } else if (element.name != "face") {  // an empty one beside tristrips tells nothing
        mesh_.elements.push_back({element.name, element.count, body_.readElement(element)});
      }
    }
    cutPolygons();
    takeFaceColumns();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::string place, std::string cause, std::string remedy) const {
    throw Error(
        {.file = input_.path(), .place = std::move(place), .cause = std::move(cause), .remedy = std::move(remedy)});
  }

  void checkCount(const PlyElement& element) const {
    if (element.count <= kMostItems) return;
    fail("header",
         "declares " + std::to_string(element.count) + " of element " + element.name +
             ", more than 32-bit indices can count",
         "split the mesh");
  }

  void checkVertices() {
    vertices_ = header_.find("vertex");
    if (!vertices_) fail("header", "declares no element vertex", "choose a PLY file that holds a mesh");
    for (const char* name : {"x", "y", "z"}) {
      const PlyProperty* p = vertices_->find(name);
      if (!p) fail("header", std::string("element vertex has no property ") + name, "export the mesh with positions");
      if (p->isList) fail("header", std::string("property ") + name + " is a list", "store one number a vertex");
      mesh_.doublePositions = mesh_.doublePositions || p->type == ScalarType::float64 || p->type == ScalarType::int32 ||
                              p->type == ScalarType::uint32;
    }
    checkCount(*vertices_);
  }

  /// Decides between the elements face and tristrips, and finds the list of indices.
  void chooseFaces() {
    const PlyElement* faces = header_.find("face");
    const PlyElement* strips = header_.find("tristrips");
    if (strips && strips->count > 0) {
      if (faces && faces->count > 0)
        fail("header", "declares both faces and tristrips", "store triangles one way only");
      strips_ = true;
      faces_ = strips;
    } else {
      faces_ = faces;
    }
    if (!faces_) return;
    checkCount(*faces_);
    const PlyProperty* list = faces_->find("vertex_indices");
    if (!list) list = faces_->find("vertex_index");
    if (!list && faces_->count == 0) return;
    if (!list || !list->isList || isFloatType(list->type)) {
      fail("header", "element " + faces_->name + " has no list of integers called vertex_indices",
           "export the mesh with faces that refer to vertices");
    }
    indexList_ = list->name;
  }

  void readVertices() {
    std::vector<Property> columns = body_.readElement(*vertices_);
    mesh_.positions.resize(vertices_->count);
    readCoordinate(columns, "x", &Vec3d::x);
    readCoordinate(columns, "y", &Vec3d::y);
    readCoordinate(columns, "z", &Vec3d::z);
    if (auto normals = takeFloatVectors(columns, {"nx", "ny", "nz"})) mesh_.vertexNormals = std::move(*normals);
    readColors(columns, mesh_.vertexColors, mesh_.vertexColorEncoding);
    mesh_.vertexProperties = std::move(columns);
  }

  /// Moves one coordinate from its column, which is freed, to the positions.
  void readCoordinate(std::vector<Property>& columns, const char* name, double Vec3d::*member) {
    const Property column = *takeColumn(columns, name);
    forEachCounted(progress_, mesh_.positions.size(), 0, [&](std::size_t v) {
      mesh_.positions[v].*member = scalarAt(column, v);
      if (!std::isfinite(mesh_.positions[v].*member)) {
        fail(plyItemName(*vertices_, v), std::string("its ") + name + " is not a finite number",
             "correct the vertex or remove it");
      }
    });
  }

  std::uint32_t checkedIndex(std::uint64_t item, std::int64_t index) const {
    // A negative index becomes a huge one.
    if (static_cast<std::uint64_t>(index) >= vertices_->count) {
      fail(plyItemName(*faces_, item),
           "refers to vertex " + std::to_string(index) + ", but there are " + std::to_string(vertices_->count) +
               " vertices, counted from 0",
           "correct the index or the number of vertices in the header");
    }
    return static_cast<std::uint32_t>(index);
  }

  void readFaces() {
    reserveTriangles();
    faceColumns_ =
        body_.readElement(*faces_, indexList_, [this](std::uint64_t face, std::span<const std::int64_t> list) {
          if (list.size() < 3) {
            fail(plyItemName(*faces_, face), "has fewer than 3 vertices (" + std::to_string(list.size()) + ")",
                 "remove it, or store points and lines as elements of their own");
          }
          if (list.size() > 3 && !hasPolygons_) recordPolygons();
          // The n corners of a polygon wait in the room of its n - 2 triangles, until all positions are known.
          const std::size_t first = mesh_.triangles.size();
          mesh_.triangles.resize(first + list.size() - 2);
          std::uint32_t* corners = mesh_.triangles[first].data();
          for (std::size_t i = 0; i < list.size(); ++i) corners[i] = checkedIndex(face, list[i]);
          if (hasPolygons_) polygonOf_.resize(mesh_.triangles.size(), static_cast<std::uint32_t>(face));
        });
    if (hasPolygons_) repeatItems(faceColumns_, polygonOf_);
  }

  void reserveTriangles() {
    mesh_.triangles.reserve(static_cast<std::size_t>(std::min(faces_->count, input_.remaining() / kLeastFaceBytes)));
  }

  /// From the first face on that is no triangle, what triangle came from what face has to be kept.
  void recordPolygons() {
    polygonOf_.resize(mesh_.triangles.size());
    std::iota(polygonOf_.begin(), polygonOf_.end(), 0u);
    hasPolygons_ = true;
  }

  void readStrips() {
    std::vector<std::uint32_t> stripOf;
    faceColumns_ = body_.readElement(*faces_, indexList_, [&](std::uint64_t item, std::span<const std::int64_t> list) {
      for (std::size_t begin = 0, at = 0; at <= list.size(); ++at) {
        if (at < list.size() && list[at] != -1) continue;
        addStrip(item, list.subspan(begin, at - begin));
        begin = at + 1;
      }
      if (faces_->properties.size() > 1) stripOf.resize(mesh_.triangles.size(), static_cast<std::uint32_t>(item));
    });
    repeatItems(faceColumns_, stripOf);
  }

  void addStrip(std::uint64_t item, std::span<const std::int64_t> strip) {
    for (std::size_t i = 0; i < strip.size(); ++i) {
      const std::uint32_t c = checkedIndex(item, strip[i]);
      if (i < 2) continue;
      std::uint32_t a = static_cast<std::uint32_t>(strip[i - 2]), b = static_cast<std::uint32_t>(strip[i - 1]);
      if (a == b || b == c || c == a) continue;
      if (i % 2 == 1) std::swap(a, b);
      mesh_.triangles.push_back({a, b, c});
    }
  }

  /// Replaces the corners that wait in the room of each polygon by its triangles.
  void cutPolygons() {
    std::vector<std::uint32_t> corners;
    std::vector<Vec3d> outline;
    std::vector<Triangle> cut;
    for (std::size_t first = 0, end; first < polygonOf_.size(); first = end) {
      progress_.advance(0);
      end = first + 1;
      while (end < polygonOf_.size() && polygonOf_[end] == polygonOf_[first]) ++end;
      if (end == first + 1) continue;
      const std::uint32_t* stored = mesh_.triangles[first].data();
      corners.assign(stored, stored + (end - first) + 2);
      outline.clear();
      for (const std::uint32_t v : corners) outline.push_back(mesh_.positions[v]);
      triangulatePolygon(outline, cut);
      for (std::size_t t = first; t < end; ++t) {
        const Triangle& local = cut[t - first];
        mesh_.triangles[t] = {corners[local[0]], corners[local[1]], corners[local[2]]};
      }
    }
    mesh_.sourcePolygons = std::move(polygonOf_);
  }

  /// Understands what the columns of the faces mean, and keeps the rest.
  void takeFaceColumns() {
    takeSourcePolygons();
    if (!hasPolygons_ && !strips_) takeCornerNormals();
    readColors(faceColumns_, mesh_.faceColors, mesh_.faceColorEncoding);
    mesh_.faceProperties = std::move(faceColumns_);
  }

  void takeSourcePolygons() {
    const Property* p = findColumn(faceColumns_, "source_polygon");
    if (!p || p->isList || p->type != ScalarType::uint32) return;
    const Property column = *takeColumn(faceColumns_, "source_polygon");
    mesh_.sourcePolygons.resize(mesh_.triangles.size());
    if (!column.values.empty()) std::memcpy(mesh_.sourcePolygons.data(), column.values.data(), column.values.size());
  }

  void takeCornerNormals() {
    const Property* p = findColumn(faceColumns_, "corner_normals");
    if (!p || !p->isList || p->type != ScalarType::float32) return;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      if (p->listStarts[f + 1] != 9 * (f + 1)) return;
    }
    const Property column = *takeColumn(faceColumns_, "corner_normals");
    mesh_.cornerNormals.resize(3 * mesh_.triangles.size());
    if (!column.values.empty()) std::memcpy(mesh_.cornerNormals.data(), column.values.data(), column.values.size());
  }

  PlyInput& input_;
  PlyHeader header_;
  Progress& progress_;
  PlyBody body_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;  // faces or tristrips, or null in a cloud of points
  bool strips_ = false;
  std::string indexList_;

  Mesh mesh_;
  std::vector<Property> faceColumns_;
  bool hasPolygons_ = false;
  std::vector<std::uint32_t> polygonOf_;  // the polygon of each triangle, once some face is not a triangle
};

}  // namespace

Mesh readPly(const std::string& path, Progress& progress) {
  PlyInput input(path);
  MeshBuilder builder(input, readPlyHeader(input), progress);
  progress.begin("reading " + path, static_cast<double>(input.remaining()), "bytes");
  Mesh mesh = builder.build();
  progress.end();
  return mesh;
}

}  // namespace shbake
