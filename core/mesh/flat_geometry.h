// What the rounding of coordinates lets be known of flat faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake {

/// Three or fewer roundings of a coordinate add up to less than this many units in the last place: a plane through
/// three rounded corners, extended to a fourth as far off as they are from each other.
inline constexpr double kPlaneUlps = 4;

/// A unit in the last place, at the precision in which `mesh` is stored, of coordinates up to `magnitude`.
inline double coordinateUlp(const Mesh& mesh, double magnitude) {
  return magnitude * (mesh.doublePositions ? std::numeric_limits<double>::epsilon()
                                           : static_cast<double>(std::numeric_limits<float>::epsilon()));
}

/// The largest coordinate of a point in absolute value.
inline double magnitudeOf(const Vec3d& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// `p` as the mesh's file can hold it.
inline Vec3d storedPosition(const Mesh& mesh, const Vec3d& p) {
  return mesh.doublePositions ? p : roundedToFloat(p);
}

/// An order of positions that does not depend on their numbers.
inline bool comesBefore(const Vec3d& a, const Vec3d& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// A face of a mesh in space. Faces with the same corners, in whatever order, have the same numbers to the last bit,
/// but for the signs of the area vector: both sides of a doubled sheet are to be cut alike.
struct FaceShape {
  std::array<Vec3d, 3> corners;
  Vec3d areaVector;   ///< along the normal; its length is twice the area
  double ulp = 0;     ///< of its coordinates
  double height = 0;  ///< over its longest side

  FaceShape(const Mesh& mesh, std::uint32_t face) {
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.triangles[face][k]];
    std::array<Vec3d, 3> p = corners;
    // Each exchange of two corners turns the face over.
    bool turned = false;
    const auto order = [&](std::size_t i, std::size_t j) {
      if (!comesBefore(p[j], p[i])) return;
      std::swap(p[i], p[j]);
      turned = !turned;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    const Vec3d ab = p[1] - p[0], ac = p[2] - p[0], bc = p[2] - p[1];
    areaVector = turned ? cross(ac, ab) : cross(ab, ac);
    ulp = coordinateUlp(mesh, std::max({magnitudeOf(corners[0]), magnitudeOf(corners[1]), magnitudeOf(corners[2])}));
    const double longest = std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)}));
    if (longest > 0) height = length(areaVector) / longest;
  }

  std::array<Vec3d, 3> sortedCorners() const {
    std::array<Vec3d, 3> sorted = corners;
    std::sort(sorted.begin(), sorted.end(), comesBefore);
    return sorted;
  }
  /// The rounding of its corners does not decide which way it faces.
  bool hasPlane() const { return height > kPlaneUlps * ulp; }
  double area() const { return length(areaVector) / 2; }
  Vec3d normal() const { return normalized(areaVector); }
};

}  // namespace shbake
