// What the two halves of the bridge share: layers as vcg holds them. For bridge_*.cpp only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/placement.h"

namespace shbake::meshlab {

inline std::string nameOf(const MeshModel& layer) {
  const std::string label = layer.label().toStdString();
  return label.empty() ? "the layer" : label;
}

/// The vertices that are not deleted.
inline std::vector<std::uint32_t> liveVertices(const CMeshO& m) {
  std::vector<std::uint32_t> places;
  places.reserve(static_cast<std::size_t>(m.vn));
  for (std::size_t i = 0; i < m.vert.size(); ++i) {
    if (!m.vert[i].IsD()) places.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

/// The sixteen numbers of the layer's transform, row by row.
inline std::array<double, 16> transformOf(const MeshModel& layer) {
  std::array<double, 16> rows{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) rows[4 * i + j] = static_cast<double>(layer.cm.Tr.ElementAt(i, j));
  }
  return rows;
}

inline Placement placementOf(const MeshModel& layer) {
  return Placement(transformOf(layer), nameOf(layer));
}

inline Vec3d positionOf(const CVertexO& v) {
  return {static_cast<double>(v.cP()[0]), static_cast<double>(v.cP()[1]), static_cast<double>(v.cP()[2])};
}

inline Vec3f normalOf(const CVertexO& v) {
  return {static_cast<float>(v.cN()[0]), static_cast<float>(v.cN()[1]), static_cast<float>(v.cN()[2])};
}

inline ByteColor bytesOf(const vcg::Color4b& c) {
  return {c[0], c[1], c[2]};
}

inline Rgb colorOf(const ByteColor& c) {
  return {static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255, static_cast<float>(c[2]) / 255};
}

/// The places of a face's corners in the layer's vertices.
inline Triangle cornersOf(const CMeshO& m, const CFaceO& f) {
  Triangle corners;
  for (int k = 0; k < 3; ++k) corners[k] = static_cast<std::uint32_t>(f.cV(k) - m.vert.data());
  return corners;
}

/// A hash of the colours of all vertices that are not deleted; never 0.
std::uint64_t hashColors(const CMeshO& m);

}  // namespace shbake::meshlab
