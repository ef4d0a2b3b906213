// Smooth normals (Thuermer, Wuethrich 1998) on OpenMesh's half-edge structure (Botsch, Steinberg, Bischoff, Kobbelt,
// "OpenMesh: a generic and efficient polygon mesh data structure", OpenSG Symposium 2002).
#include "mesh/smooth_normals.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/face_fans.h"

namespace shbake {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::TriConnectivity;
using OpenMesh::VertexHandle;

// Work coordinates below 1 are rounded by up to 2^-25, a corner by up to sqrt(3) times that. Over a height of four
// units in the last place (2^-22) this turns a face's normal by up to 2 * sqrt(3) / 8 rad = 25 degrees; below, by
// anything.
constexpr double kLeastHeight = 0x1p-22;
// Sums of unit normals carry rounding errors of a few 2^-53 times the sum of the weights.
constexpr double kCancelled = 0x1p-48;

VertexHandle vertexHandle(std::uint32_t i) {
  return VertexHandle(static_cast<int>(i));
}

// The half-edge structure of all faces that are not degenerate, with one vertex a fan.
//
// It is filled through the kernel, edge by edge, because every pair of half-edges is known: add_face() would look each
// edge up again by walking round its vertex, which takes quadratic time at the apex of a large fan.
class HalfEdges {
 public:
  static constexpr int kPasses = 7;

  HalfEdges(const std::vector<Triangle>& faces, std::vector<std::uint32_t> opposite, const FaceFans& fans,
            Passes& passes) {
    std::size_t paired = 0, used = 0;
    passes.forEach(opposite.size(), [&](std::size_t c) {
      paired += opposite[c] != kNoCorner;
      used += fans.ofCorner[c] != kNoCorner;
    });
    mesh_.reserve(fans.position.size(), used - paired / 2, faces.size());
    passes.forEach(fans.position.size(), [&](std::size_t) { mesh_.new_vertex(); });
    passes.forEach(faces.size(), [&](std::size_t) { mesh_.new_face(); });
    const std::vector<std::uint32_t> handles = makeEdges(std::move(opposite), fans, passes);
    linkFaces(handles, fans, passes);
    linkBoundaries(passes);
  }

  const TriConnectivity& mesh() const { return mesh_; }

 private:
  // Turns the table of opposite half-edges into one of handles, in place.
  std::vector<std::uint32_t> makeEdges(std::vector<std::uint32_t> opposite, const FaceFans& fans, Passes& passes) {
    std::vector<bool> made(opposite.size());
    passes.forEach<std::uint32_t>(opposite.size(), [&](std::uint32_t h) {
      if (made[h] || fans.ofCorner[h] == kNoCorner) return;
      const HalfedgeHandle handle =
          mesh_.new_edge(vertexHandle(fans.ofCorner[h]), vertexHandle(fans.ofCorner[nextCorner(h)]));
      const std::uint32_t other = std::exchange(opposite[h], static_cast<std::uint32_t>(handle.idx()));
      if (other == kNoCorner) return;
      opposite[other] = static_cast<std::uint32_t>(mesh_.opposite_halfedge_handle(handle).idx());
      made[other] = true;
    });
    return opposite;
  }

  void linkFaces(const std::vector<std::uint32_t>& handles, const FaceFans& fans, Passes& passes) {
    passes.forEach<std::uint32_t>(handles.size(), [&](std::uint32_t h) {
      if (fans.ofCorner[h] == kNoCorner) return;
      const HalfedgeHandle handle(static_cast<int>(handles[h]));
      const FaceHandle face(static_cast<int>(h / 3));
      mesh_.set_face_handle(handle, face);
      mesh_.set_halfedge_handle(face, handle);
      mesh_.set_halfedge_handle(vertexHandle(fans.ofCorner[h]), handle);
      mesh_.set_next_halfedge_handle(handle, HalfedgeHandle(static_cast<int>(handles[nextCorner(h)])));
    });
  }

  // An open fan has one boundary half-edge that leaves its vertex (from which OpenMesh begins to circulate) and one
  // that arrives there.
  void linkBoundaries(Passes& passes) {
    passes.forEach<int>(mesh_.n_halfedges(), [&](int i) {
      const HalfedgeHandle h(i);
      if (mesh_.is_boundary(h)) mesh_.set_halfedge_handle(mesh_.from_vertex_handle(h), h);
    });
    passes.forEach<int>(mesh_.n_halfedges(), [&](int i) {
      const HalfedgeHandle h(i);
      if (mesh_.is_boundary(h)) mesh_.set_next_halfedge_handle(h, mesh_.halfedge_handle(mesh_.to_vertex_handle(h)));
    });
  }

  TriConnectivity mesh_;
};

// What a corner contributes to the normals at its position.
struct RingCorner {
  std::uint32_t corner = 0;
  std::uint32_t nextPosition = 0;
  Vec3d cross;   // of the two edges, as long as twice the area
  Vec3d normal;  // unit, or zero where rounding decides it
  double angle = 0;
  bool startsSector = false;
};

RingCorner ringCorner(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces, std::uint32_t corner) {
  RingCorner result;
  result.corner = corner;
  result.nextPosition = positionAt(faces, nextCorner(corner));
  const Vec3d at(positions[positionAt(faces, corner)]);
  const Vec3d u = Vec3d(positions[result.nextPosition]) - at;
  const Vec3d v = Vec3d(positions[positionAt(faces, previousCorner(corner))]) - at;
  result.cross = cross(u, v);
  const double area = length(result.cross);
  if (area > kLeastHeight * std::max({length(u), length(v), length(u - v)})) {
    result.normal = result.cross * (1 / area);
    result.angle = std::atan2(area, dot(u, v));
  }
  return result;
}

// Marks where sectors start and turns a closed ring so that it begins with one. A face without a normal of its own lies
// on the side of the face before it.
void cutRing(std::vector<RingCorner>& ring, bool closed, double creaseRadians) {
  Vec3d before;
  if (closed) {
    for (const RingCorner& c : ring) {
      if (c.normal != Vec3d()) before = c.normal;
    }
  }
  std::size_t creases = 0, firstCrease = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    RingCorner& c = ring[i];
    if (c.normal == Vec3d()) continue;
    if (before != Vec3d() && std::atan2(length(cross(before, c.normal)), dot(before, c.normal)) > creaseRadians) {
      c.startsSector = true;
      if (creases++ == 0) firstCrease = i;
    }
    before = c.normal;
  }
  if (closed && creases == 1) ring[firstCrease].startsSector = false;
  if (closed && creases > 1)
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(firstCrease), ring.end());
}

// The normal of the sector `begin`..`end`; zero when none of its faces has any extent.
Vec3d sectorNormal(const RingCorner* begin, const RingCorner* end) {
  Vec3d sum, crosses, first;
  double weight = 0;
  for (const RingCorner* c = begin; c != end; ++c) {
    sum += c->normal * c->angle;
    weight += c->angle;
    crosses += c->cross;
    if (first == Vec3d()) first = c->normal;
  }
  if (weight == 0) return normalized(crosses);
  return length(sum) > kCancelled * weight ? normalized(sum) : first;
}

void addSectors(const std::vector<RingCorner>& ring, SmoothNormals& result) {
  for (std::size_t begin = 0, end = 0; begin < ring.size(); begin = end) {
    do ++end;
    while (end < ring.size() && !ring[end].startsSector);
    const Vec3d normal = sectorNormal(ring.data() + begin, ring.data() + end);
    if (normal == Vec3d()) continue;
    for (std::size_t i = begin; i < end; ++i) {
      result.ofCorner[ring[i].corner] = static_cast<std::uint32_t>(result.normals.size());
    }
    result.normals.push_back(Vec3f(normal) + Vec3f());
  }
}

}  // namespace

SmoothNormals smoothNormals(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces,
                            double creaseRadians, Progress& progress) {
  // Corners 4, opposite half-edges, fans, and the ring of each fan 1.
  Passes passes(progress, "normals", faces.size(), "faces", 7 + HalfEdges::kPasses);
  std::vector<std::uint32_t> opposite =
      oppositeHalfEdges(positions, faces, cornersAtPositions(faces, positions.size(), passes), passes);
  FaceFans fans = faceFans(faces, opposite, passes);
  const HalfEdges halfEdges(faces, std::move(opposite), fans, passes);
  const TriConnectivity& mesh = halfEdges.mesh();

  // The table of fans becomes that of sectors: a corner is looked up by position from here on.
  SmoothNormals result;
  result.ofCorner = std::move(fans.ofCorner);
  const auto expected = result.ofCorner.size() -
                        static_cast<std::size_t>(std::count(result.ofCorner.begin(), result.ofCorner.end(), kNoCorner));
  std::fill(result.ofCorner.begin(), result.ofCorner.end(), SmoothNormals::kNone);
  result.normals.reserve(fans.position.size());
  std::size_t visited = 0;
  std::vector<RingCorner> ring;
  passes.forEach<std::uint32_t>(mesh.n_vertices(), [&](std::uint32_t v) {
    const VertexHandle vertex = vertexHandle(v);
    const std::uint32_t position = fans.position[static_cast<std::size_t>(vertex.idx())];
    ring.clear();
    for (const FaceHandle face : mesh.vf_ccw_range(vertex)) {
      const auto f = static_cast<std::uint32_t>(face.idx());
      const auto k = std::find(faces[f].begin(), faces[f].end(), position) - faces[f].begin();
      ring.push_back(ringCorner(positions, faces, 3 * f + static_cast<std::uint32_t>(k)));
    }
    visited += ring.size();
    const bool closed = !mesh.is_boundary(vertex);
    // Begin where the geometry says, not the file's order, so that sums round alike.
    if (closed) {
      const auto lowest = std::min_element(ring.begin(), ring.end(), [](const RingCorner& a, const RingCorner& b) {
        return a.nextPosition < b.nextPosition;
      });
      std::rotate(ring.begin(), lowest, ring.end());
    }
    cutRing(ring, closed, creaseRadians);
    addSectors(ring, result);
  });
  if (visited != expected) {
    throw Error({.cause = "the half-edge structure holds " + std::to_string(visited) + " of " +
                          std::to_string(expected) + " face corners",
                 .remedy = "please report this mesh as a fault of shbake"});
  }
  passes.end();
  return result;
}

}  // namespace shbake
