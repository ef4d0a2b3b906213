// Faces that a position lies on without being one of their corners: a box that stands on the ground, a vertex in the
// middle of another face's edge (T-junction).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>

#include "mesh/lighting_points.h"

namespace shbake {

/// How near to a face a position lies on it, in work units: one ulp of the coordinate scale. Rounding to float moves
/// the position and the plane by sqrt(3)/4 ulp each, together 0.87 ulp.
double contactDistance(const LightingPoints& points);

/// A face that a position lies on, and the part of the face that it lies on.
struct Contact {
  enum class Part : std::uint8_t { inside, edge, corner };
  Part part;
  /// The ends of the edge in order of their numbers, the corner's position id twice, or the face's number twice.
  std::uint32_t low, high;
  std::uint32_t face;

  /// Faces that meet in the part that the position lies on are neighbours in this order.
  friend auto operator<=>(const Contact&, const Contact&) = default;
  bool isSamePart(const Contact& other) const { return part == other.part && low == other.low && high == other.high; }
};

/// How position `position` lies on face `face`, of which it is no corner; nothing where it is farther than `distance`
/// from it, or the face has no extent. Exact to double.
std::optional<Contact> contactOf(const LightingPoints& points, std::uint32_t face, std::uint32_t position,
                                 double distance);

/// Whether `position` is within `distance` of face `face`, of which it is no corner. True for some positions that are
/// farther, beside sharp corners, and for any near a face without extent; false only for positions that are not.
bool mayBeNear(const LightingPoints& points, std::uint32_t face, std::uint32_t position, double distance);

/// A face that is touched, seen from the position: the directions within it, as a row of sectors narrower than 180
/// degrees from each direction to the next, counter-clockwise about the face's normal.
struct ContactSectors {
  Vec3d normal;                    ///< unit, of the face's front
  std::array<Vec3d, 5> direction;  ///< unit
  std::size_t count = 0;           ///< 5 inside the face (the last is the first), 3 on an edge, 2 at a corner

  std::span<const Vec3d> directions() const { return {direction.data(), count}; }
  /// Whether a direction in the face's plane lies within the sectors.
  bool hold(const Vec3d& inPlane) const;
};
ContactSectors sectorsOf(const LightingPoints& points, const Contact& contact);

/// Whether one face lies in the plane of the other but for the rounding of coordinates, `distance`.
bool areCoplanar(const LightingPoints& points, std::uint32_t a, std::uint32_t b, double distance);

/// The weights of the corners of `face` at the place where `position` lies on it, each 0..1, their sum 1.
Vec3d weightsAt(const LightingPoints& points, std::uint32_t face, std::uint32_t position);

}  // namespace shbake
