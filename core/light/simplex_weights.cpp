// Delaunay simplices by CGAL. This file alone is compiled with CGAL's -frounding-math.
#include "light/simplex_weights.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>

namespace shbake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex>>;
using VertexHandle = Delaunay::Vertex_handle;

Vec3d positionOf(VertexHandle v) {
  return {v->point().x(), v->point().y(), v->point().z()};
}

/// The barycentric weight of `place` at b on the segment a..b, clamped to it.
double alongSegment(const Vec3d& place, const Vec3d& a, const Vec3d& b) {
  const Vec3d edge = b - a;
  const double squared = dot(edge, edge);
  return squared > 0 ? std::clamp(dot(place - a, edge) / squared, 0.0, 1.0) : 0;
}

double tetrahedronVolume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return dot(b - a, cross(c - a, d - a));
}

/// The best simplex found so far.
struct Nearest {
  double squaredDistance = HUGE_VAL;
  SimplexWeights weights;

  template <std::size_t N>
  void offer(const Vec3d& place, const std::array<VertexHandle, N>& corners, const std::array<double, N>& w) {
    Vec3d point;
    for (std::size_t i = 0; i < N; ++i) point += w[i] * positionOf(corners[i]);
    const Vec3d away = place - point;
    const double squared = dot(away, away);
    if (squared >= squaredDistance) return;
    squaredDistance = squared;
    weights = {};
    for (std::size_t i = 0; i < N; ++i) {
      weights.corner[i] = corners[i]->info();
      weights.weight[i] = w[i];
    }
  }
};

}  // namespace

struct DelaunaySimplices::Triangulation {
  Delaunay delaunay;

  void offerFacet(const Vec3d& place, const Delaunay::Facet& facet, Nearest& nearest) const {
    const auto corner = [&](int k) { return facet.first->vertex(Delaunay::vertex_triple_index(facet.second, k)); };
    const std::array<VertexHandle, 3> corners{corner(0), corner(1), corner(2)};
    nearest.offer(place, corners,
                  nearestOnTriangle(place, positionOf(corners[0]), positionOf(corners[1]), positionOf(corners[2])));
  }

  SimplexWeights inCell(const Vec3d& place, Delaunay::Cell_handle cell) const {
    SimplexWeights result;
    std::array<Vec3d, 4> p;
    for (int i = 0; i < 4; ++i) {
      p[i] = positionOf(cell->vertex(i));
      result.corner[i] = cell->vertex(i)->info();
    }
    const double whole = tetrahedronVolume(p[0], p[1], p[2], p[3]);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      std::array<Vec3d, 4> q = p;
      q[i] = place;
      result.weight[i] = std::max(0.0, tetrahedronVolume(q[0], q[1], q[2], q[3]) / whole);
      sum += result.weight[i];
    }
    for (double& w : result.weight) w /= sum;
    return result;
  }

  /// Outside the hull, or where the points do not span space: a search over all boundary or all simplices.
  SimplexWeights nearestSimplex(const Vec3d& place) const {
    Nearest nearest;
    switch (delaunay.dimension()) {
      case 0:
        nearest.offer(place, std::array{VertexHandle(delaunay.finite_vertices_begin())}, std::array{1.0});
        break;
      case 1:
        for (const Delaunay::Edge& e : delaunay.finite_edges()) {
          const std::array corners{e.first->vertex(e.second), e.first->vertex(e.third)};
          const double w = alongSegment(place, positionOf(corners[0]), positionOf(corners[1]));
          nearest.offer(place, corners, std::array{1 - w, w});
        }
        break;
      case 2:
        for (const Delaunay::Facet& f : delaunay.finite_facets()) offerFacet(place, f, nearest);
        break;
      default:
        for (const Delaunay::Facet& f : delaunay.finite_facets()) {
          const bool onHull = delaunay.is_infinite(f.first) || delaunay.is_infinite(f.first->neighbor(f.second));
          if (onHull) offerFacet(place, f, nearest);
        }
    }
    return nearest.weights;
  }
};

DelaunaySimplices::DelaunaySimplices(std::span<const Vec3d> points)
    : triangulation_(std::make_unique<Triangulation>()) {
  // One by one: inserting a range shuffles it, and the result should depend on the points alone.
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t before = triangulation_->delaunay.number_of_vertices();
    const VertexHandle v = triangulation_->delaunay.insert({points[i].x, points[i].y, points[i].z});
    if (triangulation_->delaunay.number_of_vertices() > before) v->info() = static_cast<int>(i);
  }
}

DelaunaySimplices::~DelaunaySimplices() = default;

SimplexWeights DelaunaySimplices::weightsAt(const Vec3d& place) const {
  const Delaunay& delaunay = triangulation_->delaunay;
  if (delaunay.dimension() == 3) {
    Delaunay::Locate_type type;
    int i, j;
    const Delaunay::Cell_handle cell = delaunay.locate({place.x, place.y, place.z}, type, i, j);
    if (type != Delaunay::OUTSIDE_CONVEX_HULL) return triangulation_->inCell(place, cell);
  }
  return triangulation_->nearestSimplex(place);
}

std::array<double, 3> nearestOnTriangle(const Vec3d& place, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = cross(b - a, c - a);
  const double area = dot(normal, normal);
  if (area > 0) {
    const double wa = dot(cross(c - b, place - b), normal) / area, wb = dot(cross(a - c, place - c), normal) / area;
    const double wc = 1 - wa - wb;
    if (wa >= 0 && wb >= 0 && wc >= 0) return {wa, wb, wc};
  }
  // Outside: the nearest point is on an edge.
  const double ab = alongSegment(place, a, b), bc = alongSegment(place, b, c), ca = alongSegment(place, c, a);
  const std::array<std::array<double, 3>, 3> candidates{{{1 - ab, ab, 0}, {0, 1 - bc, bc}, {ca, 0, 1 - ca}}};
  const auto squared = [&](const std::array<double, 3>& w) {
    const Vec3d away = place - (w[0] * a + w[1] * b + w[2] * c);
    return dot(away, away);
  };
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const auto& v, const auto& w) { return squared(v) < squared(w); });
}

}  // namespace shbake
