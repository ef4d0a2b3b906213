// Occlusion by the faces that touch a lighting point's own position, decided exactly from their edge directions.
//
// Those faces cannot be traced: they begin at the ray's origin. Leaving them out altogether lets light through at
// concave vertices (Green, "Spherical Harmonic Lighting: The Gritty Details", 2003, leaves them out; a closed room's
// corner then sees 57 % of the sky). Seen from the position, each such face is one great-circle arc from one of its
// edge directions to the other, and together the arcs bound the solid angle that is blocked. A direction d is blocked
// where the arc from a start s, known to be free, to d crosses them an odd number of times. Faces that the position
// lies on without sharing it (contact.h) are seen from it as half or whole great circles, and block by the same rule,
// each part of a surface for itself: what stands on the ground does not see through it, whatever its own faces do.
// A point whose position is no corner (surface_error.h) lies on a face: that face and those that meet it there are its
// fan.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/contact_search.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// The fan of one lighting point at a time; reused from point to point so that nothing is allocated.
class FanTest {
 public:
  FanTest(const LightingPoints& points, const Contacts& contacts) : points_(points), contacts_(contacts) {}

  /// Takes up point `p`. Cost: a few operations a touching face, a few dozen where one rises above the tangent plane.
  void setPoint(std::uint32_t p);

  /// No direction above the tangent plane that rises less than this can be blocked where it is 0; otherwise directions
  /// that rise at least this far (n.d) need no test and answer blocksZenith().
  float height() const { return height_; }
  /// Whether the directions above height() are blocked: true only where the normal points into the solid.
  bool blocksZenith() const { return zenithBlocked_; }

  /// Tests 16 directions (world axes, any length). Returns a bit for each blocked one; for those, faces[i] becomes the
  /// face that blocks, unless `faces` is null.
  std::uint32_t blocked(const float* x, const float* y, const float* z, std::uint32_t* faces) const;

  /// Whether the point lies on the front of a face that blocks: then the face reflects towards it.
  bool facesFront(std::uint32_t face) const;

 private:
  struct Edge {
    std::uint32_t position;  // the neighbour that the edge leads to; kNone of a closed fan and along a face in contact
    Vec3d direction;         // unit
    double height;           // of the direction above the tangent plane
    Vec3f plane;             // normal of the plane through s and the edge, any length
    int uses;                // arcs that end here
  };
  struct Arc {
    std::uint32_t face;
    std::uint32_t back;  // a coincident face wound the other way, or kNone
    int from, to;        // edges, ordered so that s lies on the positive side of from x to
    double cosine;       // of the angle between them, in the fan
    Vec3f plane;         // normal of the face's plane on the side of s, any length
    bool own;            // the point is a corner of the face, or of the one at its back, or lies on it
    bool front;          // s is on the front of the face
    bool rises;          // above the tangent plane
  };

  bool risesAboveTangentPlane(std::uint32_t p) const;
  static constexpr std::uint32_t kNone = LightingPoints::kNone;

  const Vec3d& directionOf(int edge) const { return edges_[static_cast<std::size_t>(edge)].direction; }
  int edgeTo(std::uint32_t position, const Vec3f& origin);
  int edgeAlong(const Vec3d& direction, std::size_t firstEdge);
  bool isOwn(std::uint32_t face, std::uint32_t p) const;
  const Contact* findOwnContact(std::uint32_t p) const;
  void addArc(std::uint32_t face, int from, int to, std::uint32_t p, std::size_t firstArc);
  bool addClosedFan(std::uint32_t p);
  void addFan(std::uint32_t p);
  void addOwnSectors(std::uint32_t p);
  void addSectors(const Contact& contact, std::uint32_t p, std::size_t firstEdge, std::size_t firstArc);
  void addContacts(std::uint32_t p, std::uint32_t startFace, const Vec3d& start);
  bool isCovered(std::uint32_t face, const Vec3d& direction, const Contact& by) const;
  double findOwn(std::uint32_t p);
  const Arc* chooseStart(std::uint32_t p, const Vec3d& normal, Vec3d& start);
  void orient(const Vec3d& start);
  float findHighest(const Vec3d& start, const Vec3d& normal);
  void keepRisingArcs();
  bool isCrossed(const Arc& arc, const Vec3f& direction) const;
  bool isBlocked(const Vec3f& direction) const;
  std::uint32_t crossedOddly(std::size_t firstArc, std::size_t endArc, const float* x, const float* y, const float* z,
                             std::uint32_t* faces) const;

  const LightingPoints& points_;
  const Contacts& contacts_;
  const Contact* ownContact_ = nullptr;  // where the point lies on its own face; null where it is a corner of it
  std::vector<Edge> edges_;
  std::vector<Arc> arcs_;
  std::vector<std::size_t> surfaceEnds_;  // one past the last arc of each surface: the fan, then those in contact
  float height_ = 0;
  bool zenithBlocked_ = false;
};

}  // namespace shbake
