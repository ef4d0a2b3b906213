// Visibility from a lighting point in double precision, which knows where float arithmetic may decide either way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "mesh/lighting_points.h"

namespace shbake::testing {

/// What a point sees in a direction. `either`: the direction passes so close to an edge, or to a plane of a face, that
/// the rounding of a float test explains both answers.
enum class Sees { sky, face, either };

/// Judges directions by trying every face. Margins are bounds of rounding, not rates:
/// - Faces beyond the fan, by Moeller and Trumbore's determinants U, V, W ("Fast, minimum storage ray/triangle
///   intersection", 1997). In float, differences of coordinates carry one rounding, a cross product three, a scalar
///   product three, and the direction itself four (PointTracer's sum of three products of rounded axes): eleven half
///   ulps of |c||e|, and sums of absolute values reach sqrt(3) times the product of lengths. kMargin = 20 half ulps.
/// - Faces of the fan, by the signs of d against unit normals that are rounded once: one rounding, the scalar product's
///   three and the direction's four, times sqrt(3): 14 half ulps, and the same kMargin is used.
/// Faces whose plane is as near as one ulp of the coordinate scale are in contact with the point: rounding of its
/// coordinates and of theirs decides on which side it lies. Those whose extent it lies on are judged as if they passed
/// through it exactly, from an origin moved towards the start of the fan's arcs; the others do not count.
class VisibilityJudge {
 public:
  /// `far` in work units: faces farther away do not count.
  explicit VisibilityJudge(const LightingPoints& points, double far = std::numeric_limits<double>::infinity());

  /// Takes up a point, of which the rest is asked.
  void setPoint(std::uint32_t point);

  /// Faces that do not touch the position.
  Sees beyondFan(const Vec3d& direction) const;
  /// Faces that touch it: the one-sided rule of fan_test.h, each arc intersected for itself. Nothing blocks where no
  /// arc rises above the tangent plane.
  Sees throughFan(const Vec3d& direction) const;
  /// Faces that it lies on without being their corner. What covers the start is one wall with it and does not count.
  Sees throughContacts(const Vec3d& direction) const;
  /// Both kinds of faces that are at distance zero.
  Sees atPosition(const Vec3d& direction) const;
  Sees look(const Vec3d& direction) const;

  /// The greatest n.d over the arcs of the fan, at least 0.
  double fanHeight() const { return height_; }
  bool hasContacts() const { return !contacts_.empty(); }
  /// Whether one own face is wider than all others: elsewhere the one-sided rule has a choice.
  bool startIsUnique() const { return startIsUnique_; }

  static constexpr double kMargin = 20 * 0x1p-24;

 private:
  struct Arc {
    Vec3d a, b;   // unit
    Vec3d plane;  // unit normal of the face; zero where it has no extent
  };
  /// A face that the position lies on: its plane, and the borders that pass through the position, none, one or two, by
  /// their normals in the plane towards the face.
  struct Touched {
    std::set<std::uint32_t> part;  // position ids of the edge or corner; the face's number where there is no border
    std::size_t face;
    Vec3d plane;
    std::vector<Vec3d> inwards;

    bool holds(const Vec3d& direction) const;
  };
  std::optional<Touched> touch(std::size_t face) const;
  bool covers(const Touched& touched, std::size_t own, const Vec3d& direction) const;
  bool isFlatOn(const Triangle& face, const Triangle& other) const;
  Sees hits(const Triangle& face, const Vec3d& direction) const;
  void collectFan(std::uint32_t point);
  double highestPoint(const Vec3d& normal) const;

  const LightingPoints& points_;
  double contact_ = 0, far_;
  Vec3d origin_;
  std::vector<std::uint32_t> beyond_;  // faces that do not touch the position
  std::vector<Touched> contacts_;
  std::vector<Arc> arcs_;
  bool hasStart_ = false, startIsUnique_ = false;
  Vec3d start_;
  std::size_t startFace_ = 0;
  double height_ = 0;
};

}  // namespace shbake::testing
