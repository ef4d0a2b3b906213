// Sums over a surface by a fine even grid on each face: the plain way, for tests to judge the clever ones by.
#pragma once

#include <array>
#include <cstddef>

#include "mesh/lighting_points.h"

namespace shbake::testing {

/// Calls visit(face, weights) at the centroids of m x m equal parts of each face; the weights are those of its corners.
template <class Visit>
void overFaces(const LightingPoints& points, int m, const Visit& visit) {
  for (std::size_t f = 0; f < points.faces.size(); ++f) {
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < 2 * i + 1; ++j) {
        // Row i has 2 i + 1 triangles, of which every second stands on its head.
        const double down = j % 2 == 0 ? 2.0 / 3 : 1.0 / 3, v = (j / 2 + 1.0 / 3 + (j % 2) / 3.0) / m;
        const double both = (i + down) / m;
        visit(f, std::array<double, 3>{1 - both, both - v, v});
      }
    }
  }
}

}  // namespace shbake::testing
