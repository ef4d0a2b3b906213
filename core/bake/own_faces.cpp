// Hits on faces that touch the ray's own position.
#include "bake/own_faces.h"

#include <cmath>

namespace shbake {
namespace {

/// Float hit distances are off by a few ulp of the coordinate scale, contactDistance(); hits that seem farther from
/// contact than this are.
constexpr double kSuspect = 16;
/// Rounding of the product of normal and distance of a face that the origin lies on, in units of its edge length cubed:
/// differences of coordinates carry one half ulp, a cross and a scalar product three each, sqrt(3) times as sums of
/// absolute values. Of slivers, whose normal is short, this is far more than the suspect distance.
constexpr double kProductRounding = 16 * 0x1p-24;

}  // namespace

OwnFaces::OwnFaces(const LightingPoints& points, double contact, float longestEdge)
    : points_(points),
      contact_(contact),
      suspect2_(static_cast<float>(std::pow(kSuspect * contact, 2))),
      product_(static_cast<float>(kProductRounding * std::pow(static_cast<double>(longestEdge), 3))) {}

/// Whether the position lies on the plane of a face but for the rounding of coordinates. Exact to double.
bool OwnFaces::isInContact(std::uint32_t face, std::uint32_t position) const {
  const Triangle& t = points_.faces[face];
  const Vec3d a(points_.positions[t[0]]), b(points_.positions[t[1]]), c(points_.positions[t[2]]);
  const Vec3d normal = cross(b - a, c - a);
  return std::abs(dot(normal, a - Vec3d(points_.positions[position]))) <= contact_ * length(normal);
}

bool OwnFaces::touches(std::uint32_t face, std::uint32_t position, const Vec3f& normal, const Vec3f& direction,
                       float distance) const {
  const float beyond = std::abs(dot(normal, direction) * distance) - product_;
  if (beyond > 0 && beyond * beyond > suspect2_ * dot(normal, normal)) return false;
  const Triangle& t = points_.faces[face];
  return t[0] == position || t[1] == position || t[2] == position || isInContact(face, position);
}

}  // namespace shbake
