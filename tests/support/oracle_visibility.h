// The slow, obviously right twin of the traced visibility: every face tried for every direction, in extended precision.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "mesh/lighting_points.h"

namespace shbake::oracle {

/// Whether light from `direction` (of any length but zero, either side of the tangent plane) reaches lighting point
/// `point`: no face that does not touch the point's position is met at a distance beyond `nearest` (work units), and
/// the faces that touch it do not block at distance zero (blockedByFan). Faces seen exactly edge-on do not block.
/// `nearest` = 0 is the exact answer for the float positions; where surfaces touch without sharing vertices, rounding
/// puts them in front of or behind each other at random, and a bound on the rounding is needed instead.
bool visible(const LightingPoints& points, std::uint32_t point, const Vec3d& direction, double nearest = 0);

/// Whether the faces that touch the point's position block `direction` at distance zero. Each cuts the sphere of
/// directions with one great-circle arc; a direction is blocked where the shorter arc to it, from a start just above
/// the point's own face with the widest angle, crosses them an odd number of times. Coincident faces count once. False
/// for a point without a face of its own that has an extent.
bool blockedByFan(const LightingPoints& points, std::uint32_t point, const Vec3d& direction);

/// A direction of unit length and the solid angle that it stands for.
struct WeightedDirection {
  Vec3d direction;
  double solidAngle;
};

/// The order^2 coefficients of a point's shadowed transfer for albedo 1, as the plain sum over the given directions of
/// solidAngle / pi * visible * max(n . d, 0) * y_i(d).
std::vector<double> shadowedTransfer(const LightingPoints& points, std::uint32_t point,
                                     std::span<const WeightedDirection> directions, int order, double nearest = 0);

}  // namespace shbake::oracle
