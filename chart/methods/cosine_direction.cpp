// The map from the square to the cosine-weighted hemisphere.
#include "chart/methods/cosine_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shbake::chart {

Vec3d cosineDirection(double x, double y) {
  const double a = 2 * x - 1, b = 2 * y - 1;
  double r = 0, phi = 0;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = std::numbers::pi / 4 * b / a;
  } else if (b != 0) {
    r = b;
    phi = std::numbers::pi / 2 - std::numbers::pi / 4 * a / b;
  }
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, (1 - r) * (1 + r)))};
}

}  // namespace shbake::chart
