// Hits on faces that touch the ray's own position.
#include "bake/own_faces.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
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

float longestEdge(const LightingPoints& points) {
  float longest2 = 0;
  for (const Triangle& t : points.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f edge = points.positions[t[k]] - points.positions[t[(k + 1) % 3]];
      longest2 = std::max(longest2, dot(edge, edge));
    }
  }
  return std::sqrt(longest2);
}

/// A bit for each lane of a packet that asks for an answer. Without branches: which lane it is cannot be predicted.
unsigned askingLanes(const int* valid, unsigned count) {
  unsigned lanes = 0;
  for (unsigned i = 0; i < count; ++i) lanes |= static_cast<unsigned>(valid[i] == -1) << i;
  return lanes;
}

}  // namespace

OwnFaces::OwnFaces(const LightingPoints& points, double contact)
    : points_(points),
      contact_(contact),
      suspect2_(static_cast<float>(std::pow(kSuspect * contact, 2))),
      product_(static_cast<float>(kProductRounding * std::pow(static_cast<double>(longestEdge(points)), 3))) {}

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

void OwnFaces::leaveOut(const RTCFilterFunctionNArguments* args) {
  const auto& own = *static_cast<const OwnFaces*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned lanes = askingLanes(args->valid, n); lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(lanes));
    const Vec3f normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i), RTCHitN_Ng_z(args->hit, n, i));
    const Vec3f direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                          RTCRayN_dir_z(args->ray, n, i));
    const bool touches = own.touches(RTCHitN_primID(args->hit, n, i), RTCRayN_id(args->ray, n, i), normal, direction,
                                     RTCRayN_tfar(args->ray, n, i));
    if (touches) args->valid[i] = 0;
  }
}

}  // namespace shbake
