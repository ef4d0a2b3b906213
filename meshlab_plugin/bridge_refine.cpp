// Layers that get more vertices: what has to be known in between goes out as columns of the mesh and comes back so.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/layer_geometry.h"
#include "meshlab_plugin/stored_bake.h"

namespace shbake::meshlab {
namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

constexpr const char* kColors[] = {"red", "green", "blue"};
constexpr const char* kQuality = "quality";
constexpr const char* kTexture[] = {"texture_u", "texture_v"};
/// Six numbers a face: u and v of each corner, as in files of MeshLab.
constexpr const char* kCornerTexture = "texcoord";
constexpr const char* kTextureNumber = "texnumber";

template <class T>
constexpr ScalarType kTypeOf = ScalarType::float32;
template <>
constexpr ScalarType kTypeOf<std::uint8_t> = ScalarType::uint8;
template <>
constexpr ScalarType kTypeOf<std::int32_t> = ScalarType::int32;

/// A column with value(i) for each i below `count`.
template <class T, class Value>
Property columnOf(const char* name, std::size_t count, Value&& value) {
  Property column;
  column.name = name;
  column.type = kTypeOf<T>;
  column.values.resize(count * sizeof(T));
  for (std::size_t i = 0; i < count; ++i) {
    const T item = value(i);
    std::memcpy(column.values.data() + i * sizeof(T), &item, sizeof(T));
  }
  return column;
}

/// Calls take(i, value) for each scalar of the column of that name, where there is one.
template <class T, class Take>
void readColumn(const std::vector<Property>& columns, const char* name, Take&& take) {
  const auto column = std::find_if(columns.begin(), columns.end(), [&](const Property& p) { return p.name == name; });
  if (column == columns.end()) return;
  for (std::size_t i = 0; i < column->values.size() / sizeof(T); ++i) {
    T item;
    std::memcpy(&item, column->values.data() + i * sizeof(T), sizeof(T));
    take(i, item);
  }
}

/// Bytes of colours that came from bytes.
void carryColors(const std::vector<Rgb>& colors, std::vector<Property>& columns) {
  if (colors.empty()) return;
  float Rgb::*const channels[] = {&Rgb::x, &Rgb::y, &Rgb::z};
  for (int c = 0; c < 3; ++c) {
    columns.push_back(columnOf<std::uint8_t>(kColors[c], colors.size(), [&](std::size_t i) {
      return static_cast<std::uint8_t>(std::lround(255 * colors[i].*channels[c]));
    }));
  }
}

/// The corner of a layer's face that is corner `corner` of the face as it was read, and the other way round.
int cornerOf(const LayerMesh& read, int corner) {
  return read.mirrored && corner > 0 ? 3 - corner : corner;
}

void carryCornerTexture(const MeshModel& layer, LayerMesh& read) {
  const CMeshO& m = layer.cm;
  const std::size_t faces = read.facePlaces.size();
  Property texture = columnOf<float>(kCornerTexture, 6 * faces, [&](std::size_t i) {
    const auto& corner = m.face[read.facePlaces[i / 6]].cWT(cornerOf(read, static_cast<int>(i % 6 / 2)));
    return i % 2 == 0 ? corner.U() : corner.V();
  });
  texture.isList = true;
  for (std::size_t f = 0; f <= faces; ++f) texture.listStarts.push_back(6 * f);
  read.mesh.faceProperties.push_back(std::move(texture));
  read.mesh.faceProperties.push_back(columnOf<std::int32_t>(
      kTextureNumber, faces, [&](std::size_t f) { return m.face[read.facePlaces[f]].cWT(0).N(); }));
}

/// Drops what nothing is known of at new vertices and faces: curvatures, radii, the quality and custom attributes of
/// faces, what is selected of them, and who is whose neighbour.
void dropUncarried(MeshModel& layer) {
  CMeshO& m = layer.cm;
  layer.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO | MeshModel::MM_FACEQUALITY |
                      MeshModel::MM_FACECURVDIR | MeshModel::MM_VERTCURVDIR | MeshModel::MM_VERTRADIUS |
                      MeshModel::MM_POLYGONAL);
  std::vector<std::string> names;
  for (const auto& attribute : m.face_attr) names.push_back(attribute._name);
  for (const std::string& name : names) Allocator::DeletePerFaceAttribute(m, name);
}

/// Adds the vertices that `grown` has beyond those of the layer, each as a copy of its source where it has one.
void addVertices(CMeshO& m, const Mesh& grown, std::span<const std::uint32_t> sourceVertex,
                 const Placement& placement) {
  const std::size_t before = m.vert.size(), after = grown.positions.size();
  if (after > before) Allocator::AddVertices(m, after - before);
  for (std::size_t v = before; v < after; ++v) {
    const std::uint32_t source = sourceVertex.empty() ? kNewVertex : sourceVertex[v];
    if (source == kNewVertex) {
      const Vec3d p = placement.pointBack(grown.positions[v]);
      m.vert[v].P() = Point3m(static_cast<Scalarm>(p.x), static_cast<Scalarm>(p.y), static_cast<Scalarm>(p.z));
      continue;
    }
    m.vert[v].ImportData(m.vert[source]);
    for (const auto& attribute : m.vert_attr) attribute._handle->CopyValue(v, source, attribute._handle);
  }
}

void fillVertices(MeshModel& layer, const Mesh& grown) {
  CMeshO& m = layer.cm;
  if (grown.vertexColors.empty()) {
    // What is shown is at most what shbake painted over a layer without colours.
    layer.clearDataMask(MeshModel::MM_VERTCOLOR);
    for (CVertexO& v : m.vert) v.C() = vcg::Color4b(vcg::Color4b::White);
  }
  const std::vector<Property>& columns = grown.vertexProperties;
  for (int c = 0; c < 3; ++c) {
    readColumn<std::uint8_t>(columns, kColors[c], [&](std::size_t v, std::uint8_t b) { m.vert[v].C()[c] = b; });
    if (c < 2) readColumn<float>(columns, kTexture[c], [&](std::size_t v, float t) { m.vert[v].T().P()[c] = t; });
  }
  readColumn<float>(columns, kQuality, [&](std::size_t v, float q) { m.vert[v].Q() = q; });
}

void fillFaces(CMeshO& m, const LayerMesh& read, const Mesh& grown) {
  const std::size_t before = m.face.size(), after = grown.triangles.size();
  if (after > before) Allocator::AddFaces(m, after - before);
  for (std::size_t f = 0; f < after; ++f) {
    for (int k = 0; k < 3; ++k) m.face[f].V(cornerOf(read, k)) = &m.vert[grown.triangles[f][k]];
    m.face[f].ClearS();
    m.face[f].ClearAllF();
  }
  vcg::tri::UpdateNormal<CMeshO>::PerFaceNormalized(m);
  const std::vector<Property>& columns = grown.faceProperties;
  for (int c = 0; c < 3; ++c) {
    readColumn<std::uint8_t>(columns, kColors[c], [&](std::size_t f, std::uint8_t b) { m.face[f].C()[c] = b; });
  }
  readColumn<float>(columns, kCornerTexture, [&](std::size_t i, float t) {
    m.face[i / 6].WT(cornerOf(read, static_cast<int>(i % 6 / 2))).P()[i % 2] = t;
  });
  readColumn<std::int32_t>(columns, kTextureNumber, [&](std::size_t f, std::int32_t n) {
    for (int k = 0; k < 3; ++k) m.face[f].WT(k).N() = static_cast<short>(n);
  });
}

}  // namespace

void carryAttributes(MeshModel& layer, LayerMesh& read) {
  const CMeshO& m = layer.cm;
  const auto vertexAt = [&](std::size_t i) -> const CVertexO& { return m.vert[read.vertexPlaces[i]]; };
  std::vector<Property>& columns = read.mesh.vertexProperties;
  const std::size_t vertices = read.vertexPlaces.size();
  carryColors(read.mesh.vertexColors, columns);
  carryColors(read.mesh.faceColors, read.mesh.faceProperties);
  if (layer.hasDataMask(MeshModel::MM_VERTQUALITY) && !holdsTransfer(layer)) {
    columns.push_back(columnOf<float>(kQuality, vertices, [&](std::size_t i) { return vertexAt(i).cQ(); }));
  }
  if (layer.hasDataMask(MeshModel::MM_VERTTEXCOORD)) {
    for (int c = 0; c < 2; ++c) {
      columns.push_back(columnOf<float>(kTexture[c], vertices, [&](std::size_t i) { return vertexAt(i).cT().P()[c]; }));
    }
  }
  if (layer.hasDataMask(MeshModel::MM_WEDGTEXCOORD)) carryCornerTexture(layer, read);
}

void growLayer(MeshModel& layer, const LayerMesh& read, const Mesh& grown, std::span<const std::uint32_t> sourceVertex,
               const Placement& placement) {
  CMeshO& m = layer.cm;
  dropBake(layer);
  dropUncarried(layer);
  // The vertices and faces that are left come to stand as they were read.
  Allocator::CompactEveryVector(m);
  addVertices(m, grown, sourceVertex, placement);
  fillVertices(layer, grown);
  fillFaces(m, read, grown);
  vcg::tri::UpdateBounding<CMeshO>::Box(m);
}

void storeRefined(MeshModel& layer, const LayerMesh& read, const Mesh& refined) {
  const std::size_t before = read.mesh.positions.size();
  growLayer(layer, read, refined, {}, Placement());
  CMeshO& m = layer.cm;
  if (refined.vertexNormals.empty()) {
    vcg::tri::UpdateNormal<CMeshO>::PerVertexAngleWeighted(m);
    vcg::tri::UpdateNormal<CMeshO>::NormalizePerVertex(m);
  }
  for (std::size_t v = before; v < refined.vertexNormals.size(); ++v) {
    const Vec3f& n = refined.vertexNormals[v];
    m.vert[v].N() = Point3m(n.x, n.y, n.z);
  }
}

}  // namespace shbake::meshlab
