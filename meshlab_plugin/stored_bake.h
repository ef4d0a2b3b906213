// A bake as a layer keeps it, seen from within the bridge. For bridge_*.cpp only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshlab_plugin/bake_record.h"
#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/placement.h"

namespace shbake::meshlab {

/// readLayer() with a placement of the caller's choice, and without colours of vertices.
LayerMesh readPlaced(MeshModel& layer, const Placement& placement);

/// Makes a layer the mesh that readLayer()'s `read` has grown to: the same vertices with new ones behind them, and new
/// faces. New vertices are placed by the way back of `placement`, unless `sourceVertex`, of all vertices of `grown` or
/// empty, names one of the layer's to copy. Colours, texture coordinates and quality are those of `grown`; normals of
/// vertices stay or are zero. The layer is compacted. A bake that it holds is dropped.
void growLayer(MeshModel& layer, const LayerMesh& read, const Mesh& grown, std::span<const std::uint32_t> sourceVertex,
               const Placement& placement);

/// Removes the transfer that a layer holds and the colours hidden below those that shbake showed. Shown colours stay.
void dropBake(MeshModel& layer);

/// The record of a layer's bake, or null.
BakeRecord* findRecord(MeshModel& layer);

/// The layer's own colours, not those that shbake showed in their place; empty where it has none.
std::vector<Rgb> ownColors(MeshModel& layer, const std::vector<std::uint32_t>& vertexPlaces);

/// Keeps the transfer of a file with a layer that has just been filled with its geometry and colours.
void keepBaked(MeshModel& layer, const BakedPly& baked);

}  // namespace shbake::meshlab
