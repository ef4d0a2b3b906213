#include "mesh/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <vector>

namespace shbake {

double convexHullVolume(std::span<const Vec3f> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> copies;
  copies.reserve(points.size());
  for (const Vec3f& p : points) copies.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(copies.begin(), copies.end(), hull);
  const auto at = [&](auto vertex) {
    const Kernel::Point_3& p = hull.point(vertex);
    return Vec3d(p.x(), p.y(), p.z());
  };
  double sum = 0;
  for (const auto face : hull.faces()) {
    // A fan of triangles: faces with coplanar points may have more corners than three.
    const auto first = hull.halfedge(face);
    for (auto h = hull.next(first); hull.next(h) != first; h = hull.next(h)) {
      sum += dot(at(hull.target(first)), cross(at(hull.target(h)), at(hull.target(hull.next(h)))));
    }
  }
  return sum / 6;
}

}  // namespace shbake
