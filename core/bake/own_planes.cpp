// Which rays from a position run close along a face at that position.
#include "bake/own_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/wide.h"

namespace shbake {
namespace {

/// Relative rounding of the products, in units of the edge length cubed (N.C) and squared (N.d): the cross product is
/// off by 2 sqrt(2) half ulp, a scalar product by 3, a rotation and the turned direction by 3 each: below 16.
constexpr float kRounding = 16 * 0x1p-24f;

/// Bit i where direction i is closer to the plane of `normal` than `bound`.
SHBAKE_WIDE void markClose(const Vec3f& normal, float bound, const float* x, const float* y, const float* z,
                           std::int32_t* marks) {
  for (std::size_t i = 0; i < 16; ++i) {
    const float product = normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
    marks[i] |= static_cast<std::int32_t>(std::abs(product) < bound);
  }
}

}  // namespace

void OwnPlanes::setPosition(const LightingPoints& points, std::uint32_t position, const Vec3f& axisX,
                            const Vec3f& axisY, const Vec3f& axisZ, float near) {
  planes_.clear();
  top_ = 0;
  const Vec3f origin = points.positions[position];
  for (const std::uint32_t f : points.positionFaces[position]) {
    const Triangle& t = points.faces[f];
    const std::size_t corner = t[0] == position ? 0 : t[1] == position ? 1 : 2;
    const Vec3f a = points.positions[t[(corner + 1) % 3]] - origin, b = points.positions[t[(corner + 2) % 3]] - origin;
    const Vec3f normal = cross(a, b), local(dot(normal, axisX), dot(normal, axisY), dot(normal, axisZ));
    const float longest = std::sqrt(2 * (dot(a, a) + dot(b, b)));  // |a| + |b| or more: no edge is longer
    const float bound = kRounding * longest * longest * (longest / near + 2);
    planes_.push_back({local, bound});
    // |N.d| >= |N_z| d_z - |N_x| - |N_y|, the horizontal parts of d being 1 at most.
    top_ = std::max(top_, (std::abs(local.x) + std::abs(local.y) + bound) / std::abs(local.z));
  }
}

std::uint16_t OwnPlanes::close(const float* x, const float* y, const float* z, std::uint16_t asked) const {
  unsigned low = 0;
  for (unsigned bits = asked; bits != 0; bits &= bits - 1) {
    const int i = std::countr_zero(bits);
    low |= static_cast<unsigned>(z[i] < top_) << i;
  }
  if (low == 0) return 0;
  std::array<std::int32_t, 16> marks{};
  for (const Plane& p : planes_) markClose(p.normal, p.bound, x, y, z, marks.data());
  unsigned mask = 0;
  for (unsigned i = 0; i < 16; ++i) mask |= static_cast<unsigned>(marks[i]) << i;
  return static_cast<std::uint16_t>(mask & low);
}

}  // namespace shbake
