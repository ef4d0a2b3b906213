// A bake as a layer keeps it, seen from within the bridge. For bridge_*.cpp only.
#pragma once

#include <cstdint>
#include <vector>

#include "meshlab_plugin/bake_record.h"
#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/placement.h"

namespace shbake::meshlab {

/// readLayer() with a placement of the caller's choice, and without colours of vertices.
LayerMesh readPlaced(MeshModel& layer, const Placement& placement);

/// The record of a layer's bake, or null.
BakeRecord* findRecord(MeshModel& layer);

/// The layer's own colours, not those that shbake showed in their place; empty where it has none.
std::vector<Rgb> ownColors(MeshModel& layer, const std::vector<std::uint32_t>& vertexPlaces);

/// Keeps the transfer of a file with a layer that has just been filled with its geometry and colours.
void keepBaked(MeshModel& layer, const BakedPly& baked);

}  // namespace shbake::meshlab
