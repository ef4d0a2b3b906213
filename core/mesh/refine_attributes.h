// What a mesh holds beside its geometry, on vertices and faces that come in between.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/edge_groups.h"
#include "mesh/mesh.h"

namespace shbake {

/// A point of a face or edge: a + weightB * (b - a) + weightC * (c - a), of positions and all that is interpolated.
struct Blend {
  std::uint32_t a = 0, b = 0, c = 0;
  double weightB = 0, weightC = 0;

  /// The value here of what is `va`, `vb`, `vc` at a, b, c: exactly so at each of them, and where all are the same.
  double apply(double va, double vb, double vc) const {
    if (weightB == 0 && weightC == 0) return va;
    if (weightB == 1 && weightC == 0) return vb;
    if (weightB == 0 && weightC == 1) return vc;
    return va + weightB * (vb - va) + weightC * (vc - va);
  }
  /// The one of a, b, c that weighs most; the first of equals.
  std::uint32_t heaviest() const;
};

/// The weights of `place` in the triangle of `corners`, of its corners as a, b, c. Corner 0 where that has no area.
Blend blendAt(const std::array<Vec3d, 3>& corners, const Vec3d& place);

/// Tells where the attributes of a mesh go on from face to face. The mesh must outlive the object.
class AttributeContinuity {
 public:
  explicit AttributeContinuity(const Mesh& mesh);

  /// Whether all that the mesh holds beside its geometry goes on from one face to another as one affine function, to
  /// the precision in which it is stored, and they share the vertices of their common edge. `s` and `t` are their sides
  /// on it, wound alike, of faces with an area. Face colours and properties must be equal, bit for bit; sourcePolygons
  /// and comments do not count.
  bool goesOn(FaceSide s, FaceSide t) const;

 private:
  const Mesh& mesh_;
  std::vector<const Property*> ofFaces_, ofCorners_;
};

/// Adds a vertex for each of `blends`, which name vertices of the mesh, at `positions`. Normals are interpolated by
/// direction and length, colours and scalars by value, those of whole numbers rounded; lists are the heaviest vertex's.
void appendVertices(Mesh& mesh, std::span<const Blend> blends, std::span<const Vec3d> positions);

/// Sets the faces of `out`, which holds the vertices of `in` and more, to `triangles`, each with what the face
/// `sourceFace` of `in` has. Corner normals and texture coordinates (the property `texcoord`, six numbers a face) are
/// interpolated at corners that the source face does not have.
void setFaces(Mesh& out, const Mesh& in, std::vector<Triangle> triangles, std::span<const std::uint32_t> sourceFace);

}  // namespace shbake
