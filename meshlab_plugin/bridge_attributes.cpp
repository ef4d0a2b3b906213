// Bakes kept with layers: coefficients as one custom float attribute a column, named as in a baked file, so that they
// follow their vertices when MeshLab deletes, reorders or compacts these.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/layer_geometry.h"
#include "meshlab_plugin/stored_bake.h"

namespace shbake::meshlab {
namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;
template <class T>
using Handle = CMeshO::PerVertexAttributeHandle<T>;

constexpr const char* kError = "sh_error";
constexpr const char* kVisibility = "sh_visibility";
constexpr const char* kNormal = "sh_normal";
constexpr const char* kSource = "sh_source_vertex";
constexpr const char* kOwnColor = "sh_own_color";
constexpr const char* kRecord = "sh_record";

/// Agreement of faces and normals below which it tells nothing of the pose: meshes without consistent winding.
constexpr double kTellingFacing = 0.1;
/// The share of its agreement that a layer keeps when it is edited a little; turning it by 26 degrees loses a tenth.
constexpr double kKeptFacing = 0.9;

std::string columnName(int channels, int channel, int index) {
  return (channels == 1 ? std::string("sh_") : std::string("sh_") + "rgb"[channel] + "_") + std::to_string(index);
}

[[noreturn]] void fail(const MeshModel& layer, std::string cause, std::string remedy = "bake it again") {
  throw Error({.file = nameOf(layer), .cause = std::move(cause), .remedy = std::move(remedy)});
}

template <class T>
Handle<T> requireAttribute(MeshModel& layer, const std::string& name) {
  const auto handle = Allocator::FindPerVertexAttribute<T>(layer.cm, name);
  if (!Allocator::IsValidHandle<T>(layer.cm, handle)) fail(layer, "its attribute " + name + " has been removed");
  return handle;
}

/// An attribute with one value for each of `places`: value(i) for places[i].
template <class T, class Value>
void addAttribute(CMeshO& m, const std::string& name, const std::vector<std::uint32_t>& places, Value&& value) {
  auto handle = Allocator::AddPerVertexAttribute<T>(m, name);
  for (std::size_t i = 0; i < m.vert.size(); ++i) handle[i] = T();
  for (std::size_t i = 0; i < places.size(); ++i) handle[places[i]] = value(i);
}

template <class T, class Take>
void readAttribute(MeshModel& layer, const std::string& name, const std::vector<std::uint32_t>& places, Take&& take) {
  auto handle = requireAttribute<T>(layer, name);
  for (std::size_t i = 0; i < places.size(); ++i) take(i, handle[places[i]]);
}

void removeAttribute(CMeshO& m, const std::string& name) {
  if (vcg::tri::HasPerVertexAttribute(m, name)) Allocator::DeletePerVertexAttribute(m, name);
}

/// Removes the attributes of an earlier bake.
void removeTransfer(CMeshO& m) {
  std::vector<std::string> names;
  for (const auto& attribute : m.vert_attr) {
    if (attribute._name.starts_with("sh_") && attribute._name != kOwnColor) names.push_back(attribute._name);
  }
  for (const std::string& name : names) Allocator::DeletePerVertexAttribute(m, name);
}

BakeRecord& makeRecord(MeshModel& layer) {
  if (BakeRecord* record = findRecord(layer)) return *record;
  return Allocator::AddPerMeshAttribute<BakeRecord>(layer.cm, kRecord)();
}

BakeRecord& requireRecord(MeshModel& layer) {
  BakeRecord* record = findRecord(layer);
  if (record == nullptr || record->order == 0) {
    fail(layer, "holds no baked light transfer", "run SH Bake Light Transfer on it first, or open a .shply file");
  }
  return *record;
}

/// How far the faces look the way of the stored normals once these are turned: the mean over the surface of the cosine
/// between them, -1..1.
double facingOf(MeshModel& layer, const Placement& placement, const sh::Matrix3d& turn) {
  const CMeshO& m = layer.cm;
  auto normals = requireAttribute<Vec3f>(layer, kNormal);
  double along = 0, area = 0;
  for (const CFaceO& face : m.face) {
    if (face.IsD()) continue;
    const Vec3d a = placement.point(positionOf(*face.cV(0)));
    const Vec3d n = cross(placement.point(positionOf(*face.cV(1))) - a, placement.point(positionOf(*face.cV(2))) - a);
    Vec3d mean;
    for (const std::uint32_t c : cornersOf(m, face)) {
      mean += Vec3d(normals[c]);
    }
    along += dot(n, turn * mean) / 3;
    area += length(n);
  }
  return area > 0 ? along / area : 0;
}

/// How a layer stands now, compared with the bake.
struct Pose {
  sh::Matrix3d turn;   ///< from the axes of the bake to those in which the layer stands
  Placement bakeAxes;  ///< from the layer's own axes to those of the bake
};

/// The transform alone does not tell: freezing it moves the vertices and resets it. The faces tell which is meant.
Pose poseOf(MeshModel& layer, const BakeRecord& record) {
  const Placement now = placementOf(layer);
  const bool telling = std::abs(record.facing) >= kTellingFacing;
  const double kept = telling ? facingOf(layer, now, {}) / record.facing : 1;
  if (transformOf(layer) == record.transform) {
    if (kept < kKeptFacing) fail(layer, "has been turned or reshaped since it was baked");
    return {{}, now};
  }
  const Placement then(record.transform, nameOf(layer));
  sh::Matrix3d turn;
  try {
    turn = now.turnFrom(then);
  } catch (const Error&) {
    fail(layer, "has been stretched, sheared or mirrored since it was baked");
  }
  if (turn == sh::Matrix3d{}) return {{}, now};
  if (!telling || facingOf(layer, now, turn) / record.facing > kept) return {turn, then};
  return {{}, now};
}

/// Vertices that MeshLab added later have no normal; what is left of the layer's faces must not use them.
void requireBakedVertices(MeshModel& layer) {
  const CMeshO& m = layer.cm;
  auto normals = requireAttribute<Vec3f>(layer, kNormal);
  for (const CFaceO& face : m.face) {
    if (face.IsD()) continue;
    for (const std::uint32_t c : cornersOf(m, face)) {
      if (normals[c] == Vec3f()) fail(layer, "has got vertices since it was baked");
    }
  }
}

void keepTransfer(MeshModel& layer, const std::vector<std::uint32_t>& places, const TransferSet& t,
                  const std::vector<Vec3f>& normals, const std::vector<std::uint32_t>& sourceVertex,
                  const TransferFacts& facts) {
  CMeshO& m = layer.cm;
  removeTransfer(m);
  for (int c = 0; c < t.channels; ++c) {
    for (int i = 0; i < t.coefficientsPerChannel(); ++i) {
      addAttribute<float>(m, columnName(t.channels, c, i), places, [&](std::size_t p) { return t.at(p, c)[i]; });
    }
  }
  addAttribute<Vec3f>(m, kNormal, places, [&](std::size_t p) { return normals[p]; });
  BakeRecord& record = makeRecord(layer);
  record.order = t.order;
  record.channels = t.channels;
  record.hasError = !t.error.empty();
  record.hasVisibility = !t.visibility.empty();
  record.hasSource = !sourceVertex.empty();
  static std::uint64_t bakes = 0;
  record.number = ++bakes;
  record.facts = facts;
  record.transform = transformOf(layer);
  if (record.hasError) addAttribute<float>(m, kError, places, [&](std::size_t p) { return t.error[p]; });
  if (record.hasVisibility) addAttribute<float>(m, kVisibility, places, [&](std::size_t p) { return t.visibility[p]; });
  if (record.hasSource) {
    addAttribute<int>(m, kSource, places, [&](std::size_t p) { return static_cast<int>(sourceVertex[p]); });
  }
  record.facing = facingOf(layer, placementOf(layer), {});
}

/// Adds the vertices that were split off, each with all that its source has, and points the faces at them.
void splitLayer(MeshModel& layer, const LayerMesh& read, const BakedMesh& baked, std::vector<std::uint32_t>& places) {
  CMeshO& m = layer.cm;
  const std::size_t before = places.size(), after = baked.mesh.positions.size();
  if (after == before) return;
  const std::size_t first = m.vert.size();
  Allocator::AddVertices(m, after - before);
  for (std::size_t i = before; i < after; ++i) {
    const std::size_t place = first + i - before, source = places[baked.sourceVertex[i]];
    m.vert[place].ImportData(m.vert[source]);
    for (const auto& attribute : m.vert_attr) attribute._handle->CopyValue(place, source, attribute._handle);
    places.push_back(static_cast<std::uint32_t>(place));
  }
  for (std::size_t f = 0; f < baked.mesh.triangles.size(); ++f) {
    Triangle corners = baked.mesh.triangles[f];
    if (read.mirrored) std::swap(corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) m.face[read.facePlaces[f]].V(k) = &m.vert[places[corners[k]]];
  }
  // Who is whose neighbour has changed; filters that need to know ask for it anew.
  layer.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
}

/// The visible share of the sky as grey: what a white surface looks like under a white sky.
std::vector<ByteColor> greyOf(const TransferSet& transfer) {
  std::vector<ByteColor> colors;
  for (const float v : transfer.visibility) {
    const std::uint8_t grey = encodedByte(v);
    colors.push_back({grey, grey, grey});
  }
  return colors;
}

void showQuality(MeshModel& layer, const std::vector<std::uint32_t>& places, const TransferSet& transfer) {
  if (transfer.visibility.empty()) return;
  layer.updateDataMask(MeshModel::MM_VERTQUALITY);
  for (std::size_t i = 0; i < places.size(); ++i) layer.cm.vert[places[i]].Q() = transfer.visibility[i];
}

}  // namespace

std::uint64_t hashColors(const CMeshO& m) {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  for (const CVertexO& v : m.vert) {
    if (v.IsD()) continue;
    for (int k = 0; k < 3; ++k) hash = (hash ^ v.cC()[k]) * 0x100000001b3ull;
  }
  return hash;
}

BakeRecord* findRecord(MeshModel& layer) {
  auto handle = Allocator::FindPerMeshAttribute<BakeRecord>(layer.cm, kRecord);
  return Allocator::IsValidHandle<BakeRecord>(layer.cm, handle) ? &handle() : nullptr;
}

std::vector<Rgb> ownColors(MeshModel& layer, const std::vector<std::uint32_t>& places) {
  std::vector<Rgb> colors;
  if (!layer.hasDataMask(MeshModel::MM_VERTCOLOR)) return colors;
  const BakeRecord* record = findRecord(layer);
  if (record == nullptr || !record->shown.contains(hashColors(layer.cm))) {
    for (const std::uint32_t place : places) colors.push_back(colorOf(bytesOf(layer.cm.vert[place].cC())));
  } else if (record->hasOwnColors) {
    readAttribute<ByteColor>(layer, kOwnColor, places,
                             [&](std::size_t, const ByteColor& c) { colors.push_back(colorOf(c)); });
  }
  return colors;
}

void storeBake(MeshModel& layer, const LayerMesh& read, const BakedMesh& baked, bool preview) {
  const Placement placement = placementOf(layer);
  std::vector<std::uint32_t> places = read.vertexPlaces;
  // Refinement adds faces wherever it does anything; splits add none.
  if (baked.mesh.triangles.size() > read.mesh.triangles.size()) {
    growLayer(layer, read, baked.mesh, baked.sourceVertex, placement);
    places.resize(baked.mesh.positions.size());
    std::iota(places.begin(), places.end(), 0u);
  } else {
    splitLayer(layer, read, baked, places);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3f n = placement.normalBack(baked.mesh.vertexNormals[i]);
    layer.cm.vert[places[i]].N() = Point3m(n.x, n.y, n.z);
  }
  keepTransfer(layer, places, baked.transfer, baked.mesh.vertexNormals, baked.sourceVertex, baked.facts);
  showQuality(layer, places, baked.transfer);
  if (preview) showColors(layer, places, greyOf(baked.transfer));
}

void keepBaked(MeshModel& layer, const BakedPly& baked) {
  const std::vector<std::uint32_t> places = liveVertices(layer.cm);
  std::vector<Vec3f> normals = baked.mesh.vertexNormals;
  if (normals.empty()) {
    vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFaceNormalized(layer.cm);
    for (const CVertexO& v : layer.cm.vert) normals.push_back(normalOf(v));
  }
  keepTransfer(layer, places, baked.transfer, normals, baked.sourceVertex, baked.facts);
  requireRecord(layer).comments = baked.mesh.comments;
  showQuality(layer, places, baked.transfer);
  if (baked.mesh.vertexColors.empty() && !baked.transfer.visibility.empty()) {
    showColors(layer, places, greyOf(baked.transfer));
  }
}

void dropBake(MeshModel& layer) {
  BakeRecord* const record = findRecord(layer);
  if (record == nullptr) return;
  removeTransfer(layer.cm);
  removeAttribute(layer.cm, kOwnColor);
  BakeRecord empty;
  empty.comments = std::move(record->comments);
  *record = std::move(empty);
}

bool holdsTransfer(MeshModel& layer) {
  const BakeRecord* record = findRecord(layer);
  return record != nullptr && record->order > 0;
}

StoredTransfer readTransfer(MeshModel& layer) {
  const BakeRecord& record = requireRecord(layer);
  requireBakedVertices(layer);
  StoredTransfer out;
  out.vertexPlaces = liveVertices(layer.cm);
  out.turn = poseOf(layer, record).turn;
  TransferSet& t = out.transfer;
  t.order = record.order;
  t.channels = record.channels;
  t.coefficients.resize(out.vertexPlaces.size() * t.stride());
  for (int c = 0; c < t.channels; ++c) {
    for (int i = 0; i < t.coefficientsPerChannel(); ++i) {
      float* const to = t.coefficients.data() + c * t.coefficientsPerChannel() + i;
      readAttribute<float>(layer, columnName(t.channels, c, i), out.vertexPlaces,
                           [&](std::size_t p, float value) { to[p * t.stride()] = value; });
    }
  }
  const auto readFloats = [&](const char* name, bool there, std::vector<float>& values) {
    if (!there) return;
    readAttribute<float>(layer, name, out.vertexPlaces, [&](std::size_t, float v) { values.push_back(v); });
  };
  readFloats(kError, record.hasError, t.error);
  readFloats(kVisibility, record.hasVisibility, t.visibility);
  return out;
}

BakedPly readBakedLayer(MeshModel& layer, SavedColors colors) {
  const BakeRecord& record = requireRecord(layer);
  StoredTransfer stored = readTransfer(layer);
  BakedPly baked;
  baked.mesh = readPlaced(layer, poseOf(layer, record).bakeAxes).mesh;
  baked.mesh.vertexNormals.clear();
  readAttribute<Vec3f>(layer, kNormal, stored.vertexPlaces,
                       [&](std::size_t, const Vec3f& n) { baked.mesh.vertexNormals.push_back(n); });
  if (colors == SavedColors::own) baked.mesh.vertexColors = ownColors(layer, stored.vertexPlaces);
  if (colors == SavedColors::shown && layer.hasDataMask(MeshModel::MM_VERTCOLOR)) {
    for (const std::uint32_t place : stored.vertexPlaces) {
      baked.mesh.vertexColors.push_back(colorOf(bytesOf(layer.cm.vert[place].cC())));
    }
  }
  if (record.hasSource) {
    readAttribute<int>(layer, kSource, stored.vertexPlaces,
                       [&](std::size_t, int v) { baked.sourceVertex.push_back(static_cast<std::uint32_t>(v)); });
  }
  baked.transfer = std::move(stored.transfer);
  baked.facts = record.facts;
  baked.stated = true;
  return baked;
}

void showColors(MeshModel& layer, const std::vector<std::uint32_t>& places, const std::vector<ByteColor>& colors) {
  CMeshO& m = layer.cm;
  BakeRecord& record = makeRecord(layer);
  if (!record.shown.contains(hashColors(m))) {  // else its own colours are hidden already
    removeAttribute(m, kOwnColor);
    record.hasOwnColors = layer.hasDataMask(MeshModel::MM_VERTCOLOR);
    if (record.hasOwnColors) {
      addAttribute<ByteColor>(m, kOwnColor, places, [&](std::size_t i) { return bytesOf(m.vert[places[i]].cC()); });
    }
  }
  layer.updateDataMask(MeshModel::MM_VERTCOLOR);
  for (std::size_t i = 0; i < places.size(); ++i) {
    m.vert[places[i]].C() = vcg::Color4b(colors[i][0], colors[i][1], colors[i][2], 255);
  }
  record.shown.insert(hashColors(m));
}

}  // namespace shbake::meshlab
