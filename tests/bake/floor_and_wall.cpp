#include "bake/floor_and_wall.h"

#include <vector>

#include "bake/closed_forms.h"
#include "support/shapes.h"

namespace shbake::testing {

Mesh floorAndWall(int n) {
  const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return shapes::merged(shapes::grid({}, x, y, n, n), shapes::grid({}, y, z, n, n));
}

double skyOfFloorAndWall(const LightingPoints& points, std::size_t face, const std::array<double, 3>& weights) {
  Vec3d at;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d corner(points.positions[points.faces[face][k]]);
    at += points.frame.toFile(corner) * weights[k];
  }
  const bool onFloor = points.pointNormal[points.facePoints[face][0]].z > 0.5f;
  std::vector<Vec3d> other = onFloor ? std::vector<Vec3d>{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}
                                     : std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (Vec3d& q : other) q -= at;
  return 1 - formFactor(onFloor ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0), other);
}

}  // namespace shbake::testing
