// Hits on faces that touch the ray's own position: they do not count, and are told by welded position ids instead of an
// offset (Green, "Spherical Harmonic Lighting: The Gritty Details", 2003, leaves out the faces that share the vertex).
#pragma once

#include <cstdint>

#include "mesh/lighting_points.h"

namespace shbake {

/// Tells faces that a ray's position shares, and those that it lies on without sharing them (contact.h), from others.
class OwnFaces {
 public:
  /// `contact` is contactDistance() of `points`, which must outlive the object, `longestEdge` that of a face in work
  /// units.
  OwnFaces(const LightingPoints& points, double contact, float longestEdge);

  /// Whether `face`, hit at `distance` along a ray from a position, touches that position. `normal` is the face's, of
  /// twice its area, as Embree gives it. Both kinds are met near their plane, which most hits are not: these pass
  /// without a look at the face, by float arithmetic whose error is nothing beside the bounds.
  bool touches(std::uint32_t face, std::uint32_t position, const Vec3f& normal, const Vec3f& direction,
               float distance) const;

 private:
  bool isInContact(std::uint32_t face, std::uint32_t position) const;

  const LightingPoints& points_;
  double contact_;  // distance to a plane, in work units
  float suspect2_;  // square of the greater one within which a hit is looked at
  float product_;   // error of such a distance times twice a face's area
};

}  // namespace shbake
