#include "mesh/convexity.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/passes.h"
#include "mesh/convex_hull.h"
#include "mesh/edge_groups.h"

namespace shbake {
namespace {

/// How far a corner may stand out of the plane of the neighbouring face, in units of the last place of coordinates up
/// to 1: each of four points is rounded by half a unit in three coordinates, and the plane tilts with its corners.
/// Sharper tests would refuse bodies that are round but for rounding; larger dents than this are left to the volume.
constexpr double kSlack = 8 * std::numeric_limits<float>::epsilon() / 2;
/// The sine of the angle by which faces may bend inwards, beyond what rounding explains.
constexpr double kBend = 1e-4;
/// The share of the volume that may be missing, beside a layer of the thickness that rounding explains.
constexpr double kMissingVolume = 1e-6;

class ConvexityTest {
 public:
  explicit ConvexityTest(const LightingPoints& points) : points_(points) {}

  /// Whether an edge has two faces that do not bend inwards across it.
  bool bulges(std::span<const FaceSide> sides, const EdgeGroups& edges) const {
    if (sides.size() != 2 || edges.ascends(sides[0]) == edges.ascends(sides[1])) return false;
    return isBelow(sides[0], sides[1]) && isBelow(sides[1], sides[0]);
  }

  /// Whether the edges of a face stay below the planes of the normals at its corners.
  bool staysBelow(std::uint32_t face) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d normal(points_.pointNormal[points_.facePoints[face][k]]);
      for (std::size_t other = k + 1; other < k + 3; ++other) {
        const Vec3d edge = corner(face, other % 3) - corner(face, k);
        if (dot(edge, normal) > kSlack + kBend * length(edge)) return false;
      }
    }
    return true;
  }

  /// The volume that the faces enclose.
  double volume() const {
    double sum = 0;
    for (std::uint32_t f = 0; f < points_.faces.size(); ++f) {
      sum += dot(corner(f, 0), cross(corner(f, 1), corner(f, 2)));
    }
    return sum / 6;
  }

  double area() const {
    double sum = 0;
    for (std::uint32_t f = 0; f < points_.faces.size(); ++f) {
      sum += length(cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)));
    }
    return sum / 2;
  }

 private:
  Vec3d corner(std::uint32_t face, std::size_t k) const { return Vec3d(points_.positions[points_.faces[face][k]]); }

  /// The third corner of `other`'s face is not above the plane of `side`'s.
  bool isBelow(FaceSide side, FaceSide other) const {
    const std::uint32_t f = side.face(), g = other.face();
    const Vec3d normal = cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
    const double area = length(normal);
    if (area == 0) return true;
    const Vec3d apex = corner(g, (other.side % 3 + 2) % 3), foot = corner(f, side.side % 3);
    const double height = dot(apex - foot, normal) / area;
    return height <= kSlack + kBend * length(apex - foot);
  }

  const LightingPoints& points_;
};

}  // namespace

bool isConvexSolid(const LightingPoints& points, Progress& progress) {
  Passes passes(progress, "testing for convexity", points.faces.size(), "faces", 6);
  const ConvexityTest test(points);
  const EdgeGroups edges(points.faces, points.positions.size(), passes);
  bool bulges = true;
  edges.forEach(passes, [&](std::span<const FaceSide> sides) { bulges = bulges && test.bulges(sides, edges); });
  passes.forEach<std::uint32_t>(points.faces.size(), [&](std::uint32_t f) { bulges = bulges && test.staysBelow(f); });
  passes.end();
  if (!bulges) return false;
  const double volume = test.volume();
  const double missing = convexHullVolume(points.positions) - volume;
  return volume > 0 && missing <= kMissingVolume * volume + kSlack * test.area();
}

}  // namespace shbake
