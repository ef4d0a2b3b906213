#include "mesh/position_precision.h"

#include <algorithm>

namespace shbake {

bool positionsNeedDouble(std::span<const Vec3d> positions) {
  constexpr double kLoss = 1e-7;
  if (positions.empty()) return false;
  Vec3d low = positions[0], high = positions[0];
  double moved = 0;
  for (const Vec3d& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    if (!isFinite(Vec3f(p))) return true;  // beyond the range of float
    moved = std::max(moved, length(p - roundedToFloat(p)));
  }
  return moved > kLoss * length(high - low);
}

}  // namespace shbake
