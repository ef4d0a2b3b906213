// How much surface belongs to each vertex: thirds of triangles.
#include "view/vertex_areas.h"

namespace shbake {

std::vector<double> vertexAreas(const Mesh& mesh) {
  std::vector<double> areas(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.positions[t[0]];
    const double third = length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 6;
    for (const std::uint32_t v : t) areas[v] += third;
  }
  return areas;
}

}  // namespace shbake
