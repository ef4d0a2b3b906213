// The frame in which geometry is compared.
#include "mesh/work_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shbake {
namespace {

// The power of two that brings `halfExtent` into (0.5, 1]; the largest one for the few subnormal extents beyond its
// reach.
double scaleFor(double halfExtent) {
  if (halfExtent == 0) return 1;
  int exponent = 0;
  const double mantissa =
      std::frexp(halfExtent, &exponent);  // halfExtent = mantissa * 2^exponent, mantissa in [0.5, 1)
  if (mantissa == 0.5) --exponent;
  return std::ldexp(1.0, std::min(-exponent, 1023));
}

}  // namespace

WorkFrame workFrameOf(const Mesh& mesh, Passes& passes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d low(kInfinity, kInfinity, kInfinity), high = -low;
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      const Vec3d& p = mesh.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  });
  WorkFrame frame;
  // Halves first: the sum of two large coordinates may overflow.
  frame.centre = low * 0.5 + high * 0.5;
  const Vec3d half = high * 0.5 - low * 0.5;
  frame.scale = scaleFor(std::max({half.x, half.y, half.z}));
  return frame;
}

}  // namespace shbake
