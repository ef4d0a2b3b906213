// What the rounding of coordinates lets be known of flat faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

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
  return mesh.doublePositions ? p : Vec3d(Vec3f(p));
}

/// A face of a mesh in space.
struct FaceShape {
  std::array<Vec3d, 3> corners;
  Vec3d areaVector;   ///< along the normal; its length is twice the area
  double ulp = 0;     ///< of its coordinates
  double height = 0;  ///< over its longest side

  FaceShape(const Mesh& mesh, std::uint32_t face) {
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.triangles[face][k]];
    const Vec3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    areaVector = cross(ab, ac);
    ulp = coordinateUlp(mesh, std::max({magnitudeOf(corners[0]), magnitudeOf(corners[1]), magnitudeOf(corners[2])}));
    const double longest = std::max({length(ab), length(ac), length(corners[2] - corners[1])});
    if (longest > 0) height = length(areaVector) / longest;
  }

  /// The rounding of its corners does not decide which way it faces.
  bool hasPlane() const { return height > kPlaneUlps * ulp; }
  double area() const { return length(areaVector) / 2; }
  Vec3d normal() const { return normalized(areaVector); }
};

}  // namespace shbake
