// The bridge between MeshLab's layers and shbake's meshes: the only place where vcg types meet those of shbake.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "shbake.h"

class MeshModel;

namespace shbake::meshlab {

/// 8-bit sRGB, as MeshLab shows colours.
using ByteColor = std::array<std::uint8_t, 3>;

/// A layer as a mesh, and how to find its vertices and faces again. Deleted vertices and faces are left out.
struct LayerMesh {
  Mesh mesh;  ///< in world axes: the layer's transform is applied to positions and normals
  std::vector<std::uint32_t> vertexPlaces;  ///< where the layer keeps each vertex of `mesh`
  std::vector<std::uint32_t> facePlaces;    ///< where the layer keeps each face of `mesh`
  bool mirrored = false;                    ///< the transform mirrors: corners 1 and 2 of each triangle are exchanged
};

/// The axes in which a layer is read.
enum class Axes {
  world,  ///< with the layer's transform
  own,    ///< without it
};

/// Reads a layer. Its colours are the ones it had before shbake showed it baked or relit, unless it was painted since.
/// Throws an Error naming the layer when it has no vertices, a coordinate that is not finite or a transform that cannot
/// be inverted.
LayerMesh readLayer(MeshModel& layer, Axes axes = Axes::world);

/// Adds what a refinement has to carry on to new vertices and faces to readLayer()'s `read`, in the columns that files
/// of the layer would have: colours as bytes, texture coordinates, and a quality that is not the visible sky of a bake.
void carryAttributes(MeshModel& layer, LayerMesh& read);

/// Makes a layer what refining `read` gave, with readLayer() in the layer's own axes and carryAttributes(). Vertices
/// keep their order and their place, new ones come behind. Normals of new vertices are those of `refined`; where it has
/// none, all are made anew. A bake that the layer holds is dropped: nothing is known of the light at new vertices.
void storeRefined(MeshModel& layer, const LayerMesh& read, const Mesh& refined);

/// Keeps what was baked from readLayer()'s `read` with the layer, in custom vertex attributes named like the columns of
/// a baked file: it gets the vertices that were split off, the normals of the lighting points, and the visible share of
/// the sky as quality. With `preview` its vertex colours become that share as grey; its own are kept beside them. Where
/// the bake refined the mesh, for which `read` needs carryAttributes(), the layer gets its vertices and faces as well.
void storeBake(MeshModel& layer, const LayerMesh& read, const BakedMesh& baked, bool preview);

/// What storeBake() kept, for the vertices that the layer has now.
struct StoredTransfer {
  TransferSet transfer;                     ///< a transfer vector for each vertex that is not deleted
  std::vector<std::uint32_t> vertexPlaces;  ///< where the layer keeps each of them
  sh::Matrix3d turn;                        ///< from the axes of the bake to those in which the layer stands now
};

/// True when the layer holds a transfer. Its shape may still contradict itself.
bool holdsTransfer(MeshModel& layer);

/// Reads the transfer of a layer. Throws an Error naming the layer when it was not baked, when it got vertices since,
/// or when its transform was changed by more than a rotation, a shift and a scale.
StoredTransfer readTransfer(MeshModel& layer);

/// The colours that a baked layer is saved with.
enum class SavedColors {
  own,    ///< those from before the bake, if it had any
  shown,  ///< those that it shows now
  none,
};

/// Reads a baked layer as a file holds it, in the world axes of the bake. Throws what readLayer() and readTransfer()
/// throw.
BakedPly readBakedLayer(MeshModel& layer, SavedColors colors);

/// Fills an empty layer with a baked file and shows its colours, or the visible share of the sky as grey where it has
/// none. Returns the bits of vcg::tri::io::Mask that tell MeshLab what it holds.
int fillLayer(MeshModel& layer, const BakedPly& baked);

/// Shows colours at the vertices of readTransfer(), one each, without losing the layer's own.
void showColors(MeshModel& layer, const std::vector<std::uint32_t>& vertexPlaces, const std::vector<ByteColor>& colors);

/// The triangles of a layer over the vertices of readTransfer(), and where these are in the layer's own axes.
struct LayerSurface {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};
LayerSurface readSurface(MeshModel& layer);

/// What a layer's shape, pose and bake were at some moment. Of large layers only some vertices and faces are looked at,
/// at least one in each 1/65536 of them.
struct LayerState {
  std::uint64_t hash = 0;

  friend bool operator==(const LayerState&, const LayerState&) = default;
};
LayerState stateOf(MeshModel& layer);

/// The layer's transform as OpenGL wants it: column by column.
std::array<float, 16> columnMajorTransform(const MeshModel& layer);

}  // namespace shbake::meshlab
