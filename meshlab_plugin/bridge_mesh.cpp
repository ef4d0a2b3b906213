// Layers read as meshes, and baked meshes put into layers: positions, faces, normals and colours.
#include <bit>
#include <cmath>
#include <utility>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/layer_geometry.h"
#include "meshlab_plugin/stored_bake.h"

namespace shbake::meshlab {
namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

void readVertices(const MeshModel& layer, const Placement& placement, LayerMesh& out) {
  const CMeshO& m = layer.cm;
  Mesh& mesh = out.mesh;
  for (const std::uint32_t place : out.vertexPlaces) {
    const CVertexO& v = m.vert[place];
    const Vec3d p = placement.point(positionOf(v));
    if (!isFinite(p)) {
      throw Error({.file = nameOf(layer),
                   .place = "vertex " + std::to_string(place),
                   .cause = "its position is not finite",
                   .remedy = "correct the vertex or remove it"});
    }
    mesh.positions.push_back(p);
    mesh.vertexNormals.push_back(placement.normal(normalOf(v)));
  }
  // What a transform makes of floats is not a float any more.
  mesh.doublePositions = !placement.isIdentity() || sizeof(Scalarm) > sizeof(float);
}

void readFaces(const MeshModel& layer, LayerMesh& out) {
  const CMeshO& m = layer.cm;
  std::vector<std::uint32_t> number(m.vert.size());
  for (std::size_t i = 0; i < out.vertexPlaces.size(); ++i) number[out.vertexPlaces[i]] = static_cast<std::uint32_t>(i);
  const bool colored = layer.hasDataMask(MeshModel::MM_FACECOLOR);
  for (std::size_t f = 0; f < m.face.size(); ++f) {
    const CFaceO& face = m.face[f];
    if (face.IsD()) continue;
    Triangle corners = cornersOf(m, face);
    for (std::uint32_t& c : corners) c = number[c];
    if (out.mirrored) std::swap(corners[1], corners[2]);
    out.mesh.triangles.push_back(corners);
    out.facePlaces.push_back(static_cast<std::uint32_t>(f));
    if (colored) out.mesh.faceColors.push_back(colorOf(bytesOf(face.cC())));
  }
  out.mesh.faceColorEncoding = ColorEncoding::srgb;
}

void addGeometry(CMeshO& m, const Mesh& mesh) {
  if (!mesh.positions.empty()) Allocator::AddVertices(m, mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d& p = mesh.positions[v];
    m.vert[v].P() = Point3m(static_cast<Scalarm>(p.x), static_cast<Scalarm>(p.y), static_cast<Scalarm>(p.z));
    if (mesh.vertexNormals.empty()) continue;
    const Vec3f& n = mesh.vertexNormals[v];
    m.vert[v].N() = Point3m(n.x, n.y, n.z);
  }
  if (mesh.triangles.empty()) return;
  Allocator::AddFaces(m, mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) m.face[f].V(k) = &m.vert[mesh.triangles[f][k]];
  }
}

vcg::Color4b byteColor(const Rgb& color, ColorEncoding encoding) {
  const Rgb light = encoding == ColorEncoding::srgb ? color
                                                    : Rgb(static_cast<float>(encodedByte(color.x)) / 255,
                                                          static_cast<float>(encodedByte(color.y)) / 255,
                                                          static_cast<float>(encodedByte(color.z)) / 255);
  const auto byte = [](float v) { return static_cast<unsigned char>(std::lround(v * 255)); };
  return {byte(light.x), byte(light.y), byte(light.z), 255};
}

}  // namespace

LayerMesh readPlaced(MeshModel& layer, const Placement& placement) {
  LayerMesh out;
  out.mirrored = placement.mirrors();
  out.vertexPlaces = liveVertices(layer.cm);
  if (out.vertexPlaces.empty()) {
    throw Error({.file = nameOf(layer), .cause = "the layer has no vertices", .remedy = "choose a layer with a mesh"});
  }
  const std::string file = layer.fullName().toStdString();
  out.mesh.source = file.empty() ? nameOf(layer) : file;
  out.mesh.vertexColorEncoding = ColorEncoding::srgb;
  readVertices(layer, placement, out);
  readFaces(layer, out);
  if (const BakeRecord* record = findRecord(layer)) out.mesh.comments = record->comments;
  return out;
}

LayerMesh readLayer(MeshModel& layer, Axes axes) {
  LayerMesh read = readPlaced(layer, axes == Axes::world ? placementOf(layer) : Placement());
  read.mesh.vertexColors = ownColors(layer, read.vertexPlaces);
  return read;
}

LayerSurface readSurface(MeshModel& layer) {
  const CMeshO& m = layer.cm;
  const std::vector<std::uint32_t> places = liveVertices(m);
  LayerSurface surface;
  std::vector<std::uint32_t> number(m.vert.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    number[places[i]] = static_cast<std::uint32_t>(i);
    surface.positions.emplace_back(positionOf(m.vert[places[i]]));
  }
  for (const CFaceO& face : m.face) {
    if (face.IsD()) continue;
    Triangle corners = cornersOf(m, face);
    for (std::uint32_t& c : corners) c = number[c];
    surface.triangles.push_back(corners);
  }
  return surface;
}

LayerState stateOf(MeshModel& layer) {
  constexpr std::size_t kLooks = 65536;
  const CMeshO& m = layer.cm;
  std::uint64_t hash = 0xcbf29ce484222325ull;
  const auto add = [&hash](std::uint64_t bits) {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 32;
  };
  add(m.vert.size());
  add(m.face.size());
  add(static_cast<std::uint64_t>(m.vn));
  add(static_cast<std::uint64_t>(m.fn));
  for (const double v : transformOf(layer)) add(std::bit_cast<std::uint64_t>(v));
  if (const BakeRecord* record = findRecord(layer)) add(record->number);
  for (std::size_t i = 0; i < m.vert.size(); i += 1 + m.vert.size() / kLooks) {
    const Vec3d p = positionOf(m.vert[i]);
    for (const double v : {p.x, p.y, p.z}) add(std::bit_cast<std::uint64_t>(v));
  }
  for (std::size_t f = 0; f < m.face.size(); f += 1 + m.face.size() / kLooks) {
    if (m.face[f].IsD()) continue;
    for (const std::uint32_t c : cornersOf(m, m.face[f])) add(c);
  }
  return {hash};
}

std::array<float, 16> columnMajorTransform(const MeshModel& layer) {
  const std::array<double, 16> rows = transformOf(layer);
  std::array<float, 16> columns{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) columns[4 * j + i] = static_cast<float>(rows[4 * i + j]);
  }
  return columns;
}

int fillLayer(MeshModel& layer, const BakedPly& baked) {
  using vcg::tri::io::Mask;
  const Mesh& mesh = baked.mesh;
  CMeshO& m = layer.cm;
  addGeometry(m, mesh);
  int mask = Mask::IOM_VERTCOORD | Mask::IOM_FACEINDEX;
  if (!mesh.vertexNormals.empty()) mask |= Mask::IOM_VERTNORMAL;
  if (!mesh.vertexColors.empty()) {
    mask |= Mask::IOM_VERTCOLOR;
    layer.updateDataMask(MeshModel::MM_VERTCOLOR);
    for (std::size_t v = 0; v < mesh.vertexColors.size(); ++v) {
      m.vert[v].C() = byteColor(mesh.vertexColors[v], mesh.vertexColorEncoding);
    }
  }
  if (!baked.transfer.visibility.empty()) mask |= Mask::IOM_VERTQUALITY | Mask::IOM_VERTCOLOR;
  if (!mesh.faceColors.empty()) {
    mask |= Mask::IOM_FACECOLOR;
    layer.updateDataMask(MeshModel::MM_FACECOLOR);
    for (std::size_t f = 0; f < mesh.faceColors.size(); ++f) {
      m.face[f].C() = byteColor(mesh.faceColors[f], mesh.faceColorEncoding);
    }
  }
  keepBaked(layer, baked);
  return mask;
}

}  // namespace shbake::meshlab
