// Lighting points: the (position, normal) pairs that carry light, and how faces and the file's vertices refer to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "base/vec3.h"
#include "mesh/mesh.h"
#include "mesh/packed_lists.h"
#include "mesh/work_frame.h"

namespace shbake {

/// Where a lighting point's normal comes from.
enum class NormalSource {
  automatic,  ///< the file's normals where it has them, else `smooth`
  smooth,     ///< angle-weighted over the faces that meet within the crease angle (the file's are ignored)
  flat,       ///< the face's own: every corner of every face gets its face's normal
};

struct LightingPointOptions {
  NormalSource normals = NormalSource::automatic;
  /// Faces whose normals differ by more than this share none, in degrees 0..180 (docs/lighting-points.md: why 50).
  double creaseDegrees = 50;
};

/// Albedo of each corner in linear RGB, 0..1. One entry: the whole mesh; F: a face each; V: a vertex each.
struct Albedo {
  enum class Per { mesh, vertex, face };
  Per per = Per::mesh;
  std::vector<Rgb> values{Rgb(1, 1, 1)};

  const Rgb& ofCorner(std::size_t face, std::uint32_t vertex) const {
    return per == Per::mesh ? values[0] : per == Per::vertex ? values[vertex] : values[face];
  }
};

/// The lighting points of a mesh, and the record of how they came about. Points are numbered along a Morton curve, so
/// that neighbours in number are neighbours in space. P positions, N points, F faces, V vertices of the mesh.
struct LightingPoints {
  WorkFrame frame;
  std::vector<Vec3f> positions;  ///< P distinct positions in work units; traced in place where there is room for more
  std::vector<Triangle> faces;   ///< F triples of position ids, wound so that the front is the side of the normals
  std::vector<Triangle> facePoints;  ///< F triples of lighting points, corner by corner as in `faces`
  std::vector<std::uint8_t> turned;  ///< F flags: corners 1 and 2 are exchanged against the mesh's triangle
  PackedLists positionFaces;         ///< P lists of the faces that touch a position, on whatever side of a crease

  std::vector<std::uint32_t> pointPosition;  ///< N position ids
  std::vector<Vec3f> pointNormal;            ///< N unit normals
  std::vector<Rgb> pointAlbedo;              ///< N albedos, linear

  /// Vertices to write: the mesh's own V in their order, then one for every further point that a vertex was split into.
  std::vector<std::uint32_t> outputPoint;   ///< a lighting point for each output vertex; kNone for an isolated vertex
  std::vector<std::uint32_t> outputSource;  ///< the mesh's vertex behind each output vertex
  std::vector<Triangle> outputFaces;        ///< F triples of output vertices in the mesh's own winding

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  /// Corners are numbered in 32 bits.
  static constexpr std::size_t kMaxFaces = 0xFFFFFFFEu / 3;

  std::size_t size() const { return pointPosition.size(); }
  /// The place of a point in file units.
  Vec3d filePosition(std::size_t point) const { return frame.toFile(Vec3d(positions[pointPosition[point]])); }
};

/// Welds vertices into lighting points. Two corners share a point when their position (in work units, bit for bit),
/// their normal (within 1e-6 per component) and their albedo (exactly) agree.
/// A corner without a usable normal in the file (finite, not zero) gets the smooth one (smooth_normals.h); a corner
/// that has none, as in a degenerate face, the mean of its position's others, or +z where there are none or they
/// cancel. Points, positions and their numbers depend on the geometry, normals and albedo, not on the order of vertices
/// and faces. Throws a usage error when the crease angle is outside 0..180 or the albedo's values do not fit the mesh,
/// and a work error when the mesh has no faces, more than kMaxFaces, an index outside its vertices, or a position that
/// is not finite. Progress counts faces.
LightingPoints makeLightingPoints(const Mesh& mesh, const LightingPointOptions& options, const Albedo& albedo,
                                  Progress& progress);

}  // namespace shbake
