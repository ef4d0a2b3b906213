// Coincident faces that are the two sides of one sheet.
#include "bake/face_twins.h"

#include <algorithm>

#include "base/passes.h"

namespace shbake {
namespace {

/// Whether `b` has the corners of `a` in the opposite order.
bool areOpposite(const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (b[k] == a[0]) return b[(k + 1) % 3] == a[2] && b[(k + 2) % 3] == a[1];
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> faceTwins(const LightingPoints& points, Progress& progress) {
  std::vector<std::uint32_t> twins;
  Passes passes(progress, "twin faces", points.faces.size(), "faces", 1);
  passes.forEach<std::uint32_t>(points.faces.size(), [&](std::uint32_t f) {
    // Whoever has all corners is among the faces at the one with the fewest: that keeps wide fans from taking quadratic
    // time.
    const Triangle& t = points.faces[f];
    const std::uint32_t corner = *std::min_element(t.begin(), t.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points.positionFaces[a].size() < points.positionFaces[b].size();
    });
    for (const std::uint32_t other : points.positionFaces[corner]) {
      if (!areOpposite(t, points.faces[other])) continue;
      if (twins.empty()) twins.assign(points.faces.size(), LightingPoints::kNone);
      twins[f] = other;
      break;
    }
  });
  passes.end();
  return twins;
}

}  // namespace shbake
