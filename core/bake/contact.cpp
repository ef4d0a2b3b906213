// Faces that a position lies on without being one of their corners.
#include "bake/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shbake {
namespace {

using Corners = std::array<Vec3d, 3>;

Corners cornersOf(const LightingPoints& points, std::uint32_t face, const Vec3d& origin = {}) {
  const Triangle& t = points.faces[face];
  return {Vec3d(points.positions[t[0]]) - origin, Vec3d(points.positions[t[1]]) - origin,
          Vec3d(points.positions[t[2]]) - origin};
}

/// The unit normal of the front; zero for a face without extent.
Vec3d normalOf(const Corners& c) {
  return normalized(cross(c[1] - c[0], c[2] - c[0]));
}

}  // namespace

double contactDistance(const LightingPoints& points) {
  float scale = 0;
  for (const Vec3f& p : points.positions) scale = std::max({scale, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return static_cast<double>(scale) * static_cast<double>(std::numeric_limits<float>::epsilon());
}

std::optional<Contact> contactOf(const LightingPoints& points, std::uint32_t face, std::uint32_t position,
                                 double distance) {
  const Corners c = cornersOf(points, face, Vec3d(points.positions[position]));
  const Vec3d normal = normalOf(c);
  if (normal == Vec3d() || std::abs(dot(normal, c[0])) > distance) return std::nullopt;
  const Triangle& t = points.faces[face];
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double inwards = dot(cross(normal, normalized(c[(k + 1) % 3] - c[k])), -c[k]);
    if (inwards < -distance) return std::nullopt;
    if (inwards < nearest) edge = k;
    nearest = std::min(nearest, inwards);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    // Beside a corner the distances to two edges are within `distance`: of a right angle, the corner's within sqrt(2).
    if (dot(c[k], c[k]) <= 2 * distance * distance) return Contact{Contact::Part::corner, t[k], t[k], face};
  }
  if (nearest > distance) return Contact{Contact::Part::inside, face, face, face};
  const auto [low, high] = std::minmax(t[edge], t[(edge + 1) % 3]);
  return Contact{Contact::Part::edge, low, high, face};
}

bool mayBeNear(const LightingPoints& points, std::uint32_t face, std::uint32_t position, double distance) {
  const Corners c = cornersOf(points, face, Vec3d(points.positions[position]));
  const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const double area2 = dot(normal, normal), distance2 = distance * distance;
  if (area2 == 0) return true;
  const double above = dot(normal, c[0]);
  if (above * above > distance2 * area2) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d edge = c[(k + 1) % 3] - c[k];
    const double inwards = dot(cross(normal, edge), -c[k]);
    if (inwards < 0 && inwards * inwards > distance2 * area2 * dot(edge, edge)) return false;
  }
  return true;
}

bool ContactSectors::hold(const Vec3d& inPlane) const {
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (dot(cross(direction[i], inPlane), normal) >= 0 && dot(cross(inPlane, direction[i + 1]), normal) >= 0)
      return true;
  }
  return false;
}

ContactSectors sectorsOf(const LightingPoints& points, const Contact& contact) {
  const Corners c = cornersOf(points, contact.face);
  const Triangle& t = points.faces[contact.face];
  const Vec3d normal = normalOf(c);
  if (contact.part == Contact::Part::corner) {
    const std::size_t k = t[0] == contact.low ? 0 : t[1] == contact.low ? 1 : 2;
    return {normal, {normalized(c[(k + 1) % 3] - c[k]), normalized(c[(k + 2) % 3] - c[k])}, 2};
  }
  if (contact.part == Contact::Part::inside) {
    const Vec3d u = normalized(c[1] - c[0]), v = cross(normal, u);
    return {normal, {u, v, -u, -v, u}, 5};
  }
  // The same direction for all faces that meet in the edge, so that none of light passes between them.
  const Vec3d along = normalized(Vec3d(points.positions[contact.high]) - Vec3d(points.positions[contact.low]));
  const std::size_t low = t[0] == contact.low ? 0 : t[1] == contact.low ? 1 : 2;
  const Vec3d u = t[(low + 1) % 3] == contact.high ? along : -along;
  return {normal, {u, normalized(cross(normal, u)), -u}, 3};
}

bool areCoplanar(const LightingPoints& points, std::uint32_t a, std::uint32_t b, double distance) {
  const Corners ca = cornersOf(points, a), cb = cornersOf(points, b);
  const auto liesOn = [&](const Corners& corners, const Corners& other) {
    const Vec3d normal = normalOf(other);
    return normal != Vec3d() && std::all_of(corners.begin(), corners.end(), [&](const Vec3d& p) {
             return std::abs(dot(normal, p - other[0])) <= distance;
           });
  };
  return liesOn(ca, cb) || liesOn(cb, ca);
}

Vec3d weightsAt(const LightingPoints& points, std::uint32_t face, std::uint32_t position) {
  const Corners c = cornersOf(points, face, Vec3d(points.positions[position]));
  const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const auto weight = [&](std::size_t k) {
    return std::max(0.0, dot(cross(c[(k + 1) % 3], c[(k + 2) % 3]), normal) / dot(normal, normal));
  };
  const Vec3d w(weight(0), weight(1), weight(2));
  return w * (1 / (w.x + w.y + w.z));
}

}  // namespace shbake
