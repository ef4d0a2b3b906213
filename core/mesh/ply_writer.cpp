#include "mesh/ply_writer.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/ply_columns.h"

namespace shbake {
namespace {

// Rows are gathered into blocks of about this size before they are handed on and progress is told.
constexpr std::size_t kBlockBytes = 1 << 17;
// The longest shortest form of a double takes 24 characters.
constexpr std::size_t kLongestNumber = 32;

/// Encodes rows into a block of bytes.
class RowEncoder {
 public:
  RowEncoder(const std::string& path, PlyEncoding encoding)
      : path_(path),
        ascii_(encoding == PlyEncoding::ascii),
        swap_((encoding == PlyEncoding::binaryBigEndian) != (std::endian::native == std::endian::big)) {}

  void appendRow(const PlyElementView& element, std::size_t item) {
    for (const PlyColumnView& c : element.columns) {
      std::size_t count = c.listLength;
      const std::byte* from = c.data + item * c.stride;
      if (c.listStarts) {
        count = c.listStarts[item + 1] - c.listStarts[item];
        from = c.data + c.listStarts[item] * scalarSize(c.property.type);
      }
      if (c.property.isList) appendLength(element, item, c.property, count);
      for (std::size_t i = 0; i < count; ++i) appendScalar(c, from, i);
    }
    if (!ascii_) return;
    if (!block_.empty() && block_.back() == ' ') block_.back() = '\n';
  }

  std::string& block() { return block_; }

 private:
  void appendLength(const PlyElementView& element, std::size_t item, const PlyProperty& p, std::size_t count) {
    withScalarType(p.countType, [&]<class T>(std::type_identity<T>) {
      if (static_cast<double>(count) > static_cast<double>(std::numeric_limits<T>::max())) {
        throw Error({.file = path_,
                     .place = element.name + " " + std::to_string(item),
                     .cause = "list " + p.name + " has " + std::to_string(count) +
                              " entries, more than its length of type " + scalarName(p.countType) + " can tell",
                     .remedy = "declare the length as uint"});
      }
      append(static_cast<T>(count));
    });
  }

  void appendScalar(const PlyColumnView& c, const std::byte* from, std::size_t i) {
    if (c.narrowed) {
      double value;
      std::memcpy(&value, from + i * sizeof(double), sizeof(double));
      append(static_cast<float>(value));
      return;
    }
    const std::size_t size = scalarSize(c.property.type);
    if (!ascii_) {
      appendBytes(from + i * size, size);
      return;
    }
    withScalarType(c.property.type, [&]<class T>(std::type_identity<T>) {
      T value;
      std::memcpy(&value, from + i * sizeof(T), sizeof(T));
      append(value);
    });
  }

  template <class T>
  void append(T value) {
    if (!ascii_) {
      appendBytes(reinterpret_cast<const std::byte*>(&value), sizeof(T));
      return;
    }
    char text[kLongestNumber];
    char* const end = std::to_chars(text, text + kLongestNumber - 1, value).ptr;
    *end = ' ';
    block_.append(text, end + 1);
  }

  void appendBytes(const std::byte* bytes, std::size_t size) {
    const std::size_t at = block_.size();
    block_.append(reinterpret_cast<const char*>(bytes), size);
    if (swap_) std::reverse(block_.begin() + static_cast<std::ptrdiff_t>(at), block_.end());
  }

  const std::string& path_;
  bool ascii_, swap_;
  std::string block_;
};

PlyHeader headerOf(PlyEncoding encoding, const std::vector<std::string>& comments,
                   std::span<const PlyElementView> elements) {
  PlyHeader header{.encoding = encoding, .elements = {}, .comments = comments};
  for (const PlyElementView& view : elements) {
    PlyElement element{view.name, view.count, {}};
    for (const PlyColumnView& c : view.columns) element.properties.push_back(c.property);
    header.elements.push_back(std::move(element));
  }
  return header;
}

void requireSize(std::size_t size, std::size_t expected, const char* what) {
  if (size != expected) {
    throw usageError(std::string("the mesh has ") + std::to_string(size) + " " + what + " where " +
                     std::to_string(expected) + " belong");
  }
}

/// One column from each of red, green and blue: bytes for display values, else floats.
void makeColorColumns(const std::vector<Rgb>& colors, ColorEncoding encoding, std::vector<Property>& columns) {
  const bool bytes = encoding == ColorEncoding::srgb;
  const std::pair<const char*, float Rgb::*> channels[] = {{"red", &Rgb::x}, {"green", &Rgb::y}, {"blue", &Rgb::z}};
  for (const auto& [name, member] : channels) {
    Property column{name, bytes ? ScalarType::uint8 : ScalarType::float32, false, ScalarType::uint8, {}, {}};
    column.values.resize(colors.size() * scalarSize(column.type));
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const float value = colors[i].*member;
      if (bytes) {
        column.values[i] = static_cast<std::byte>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
      } else {
        std::memcpy(column.values.data() + i * sizeof(float), &value, sizeof(float));
      }
    }
    columns.push_back(std::move(column));
  }
}

/// Appends views of the carried properties, but of none whose name is taken.
void viewCarried(const std::vector<Property>& properties, PlyElementView& element) {
  const std::size_t own = element.columns.size();
  for (const Property& p : properties) {
    const auto end = element.columns.begin() + static_cast<std::ptrdiff_t>(own);
    const bool taken =
        std::any_of(element.columns.begin(), end, [&](const PlyColumnView& c) { return c.property.name == p.name; });
    if (!taken) element.columns.push_back(viewProperty(p, element.count));
  }
}

PlyElementView viewVertices(const Mesh& mesh, const std::vector<Property>& colors) {
  PlyElementView element{"vertex", mesh.positions.size(), {}};
  const ScalarType type = mesh.doublePositions ? ScalarType::float64 : ScalarType::float32;
  const Vec3d* p = mesh.positions.data();
  const double Vec3d::*const coordinates[] = {&Vec3d::x, &Vec3d::y, &Vec3d::z};
  const char* const names[] = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < 3; ++i) {
    const void* first = p ? &(p->*coordinates[i]) : nullptr;
    element.columns.push_back(viewScalars(names[i], type, first, sizeof(Vec3d)));
    element.columns.back().narrowed = !mesh.doublePositions;
  }
  if (!mesh.vertexNormals.empty()) {
    requireSize(mesh.vertexNormals.size(), element.count, "vertex normals");
    const float Vec3f::*const components[] = {&Vec3f::x, &Vec3f::y, &Vec3f::z};
    for (std::size_t i = 0; i < 3; ++i) {
      const void* first = &(mesh.vertexNormals[0].*components[i]);
      element.columns.push_back(viewScalars(names[3 + i], ScalarType::float32, first, sizeof(Vec3f)));
    }
  }
  for (const Property& color : colors) element.columns.push_back(viewProperty(color, element.count));
  viewCarried(mesh.vertexProperties, element);
  return element;
}

/// A column of lists that all have `length` scalars, packed.
PlyColumnView viewLists(std::string name, ScalarType type, const void* first, std::size_t length) {
  PlyColumnView view = viewScalars(std::move(name), type, first, length * scalarSize(type));
  view.property.isList = true;
  view.listLength = length;
  return view;
}

PlyElementView viewFaces(const Mesh& mesh, const std::vector<Property>& colors) {
  PlyElementView element{"face", mesh.triangles.size(), {}};
  const bool fitsInt = mesh.positions.size() <= std::size_t(1) << 31;
  element.columns.push_back(
      viewLists("vertex_indices", fitsInt ? ScalarType::int32 : ScalarType::uint32, mesh.triangles.data(), 3));
  if (!mesh.sourcePolygons.empty()) {
    requireSize(mesh.sourcePolygons.size(), element.count, "source polygons");
    element.columns.push_back(
        viewScalars("source_polygon", ScalarType::uint32, mesh.sourcePolygons.data(), sizeof(std::uint32_t)));
  }
  if (!mesh.cornerNormals.empty()) {
    requireSize(mesh.cornerNormals.size(), 3 * element.count, "corner normals");
    element.columns.push_back(viewLists("corner_normals", ScalarType::float32, mesh.cornerNormals.data(), 9));
  }
  for (const Property& color : colors) element.columns.push_back(viewProperty(color, element.count));
  viewCarried(mesh.faceProperties, element);
  return element;
}

}  // namespace

PlyColumnView viewScalars(std::string name, ScalarType type, const void* first, std::size_t stride) {
  return {{std::move(name), type, false, ScalarType::uint8},
          static_cast<const std::byte*>(first),
          stride,
          1,
          nullptr,
          false};
}

PlyColumnView viewProperty(const Property& property, std::size_t count) {
  const std::size_t size = scalarSize(property.type);
  const std::size_t scalars = property.values.size() / size;
  const bool fits = property.isList ? property.listStarts.size() == count + 1 && property.listStarts.back() == scalars
                                    : scalars == count;
  if (!fits) {
    throw usageError("property " + property.name + " does not hold " + std::to_string(count) + " items");
  }
  PlyColumnView view = viewScalars(property.name, property.type, property.values.data(), size);
  if (property.isList) {
    view.property.isList = true;
    view.property.countType = property.countType;
    view.listStarts = property.listStarts.data();
  }
  return view;
}

PlyMeshView viewMesh(const Mesh& mesh) {
  PlyMeshView view;
  std::vector<Property> vertexColors, faceColors;
  if (!mesh.vertexColors.empty() && !hasColors(mesh.vertexProperties)) {
    requireSize(mesh.vertexColors.size(), mesh.positions.size(), "vertex colours");
    makeColorColumns(mesh.vertexColors, mesh.vertexColorEncoding, vertexColors);
  }
  if (!mesh.faceColors.empty() && !hasColors(mesh.faceProperties)) {
    requireSize(mesh.faceColors.size(), mesh.triangles.size(), "face colours");
    makeColorColumns(mesh.faceColors, mesh.faceColorEncoding, faceColors);
  }
  view.elements.push_back(viewVertices(mesh, vertexColors));
  view.elements.push_back(viewFaces(mesh, faceColors));
  for (const PropertyElement& e : mesh.elements) {
    PlyElementView element{e.name, e.count, {}};
    for (const Property& p : e.properties) element.columns.push_back(viewProperty(p, e.count));
    view.elements.push_back(std::move(element));
  }
  // Moving a column moves no values: the views stay good.
  std::ranges::move(vertexColors, std::back_inserter(view.colors));
  std::ranges::move(faceColors, std::back_inserter(view.colors));
  return view;
}

void writePlyElements(const std::string& path, PlyEncoding encoding, const std::vector<std::string>& comments,
                      std::span<const PlyElementView> elements, Progress& progress) {
  const std::string header = plyHeaderText(headerOf(encoding, comments, elements));
  double rows = 0;
  for (const PlyElementView& e : elements) rows += e.columns.empty() ? 0 : static_cast<double>(e.count);
  progress.begin("writing " + path, rows, "rows");
  AtomicFile file(path);
  file.write(header);
  RowEncoder encoder(path, encoding);
  std::string& block = encoder.block();
  for (const PlyElementView& element : elements) {
    if (element.columns.empty()) continue;
    for (std::size_t item = 0, told = 0; item < element.count; ++item) {
      encoder.appendRow(element, item);
      if (block.size() < kBlockBytes && item + 1 < element.count) continue;
      file.write(block);
      block.clear();
      progress.advance(static_cast<double>(item + 1 - told));
      told = item + 1;
    }
  }
  file.commit();
  progress.end();
}

void writePly(const std::string& path, const Mesh& mesh, const PlyWriteOptions& options, Progress& progress) {
  const PlyMeshView view = viewMesh(mesh);
  writePlyElements(path, options.encoding, mesh.comments, view.elements, progress);
}

}  // namespace shbake
