// Plane triangulations by CGAL (L. P. Chew, "Constrained Delaunay triangulations", Algorithmica 1989). This file alone
// of its folder is compiled with CGAL's -frounding-math.
#include "mesh/patch_mesher.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>

namespace shbake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel,
                                                           CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using VertexHandle = Delaunay::Vertex_handle;
using FaceHandle = Delaunay::Face_handle;

using Pair = std::array<std::uint32_t, 2>;

constexpr std::uint32_t kNone = PatchLocator::kNone;
constexpr std::uint32_t kInside = 0;
// Points inserted between two counts: some milliseconds.
constexpr std::size_t kCountedPoints = 1 << 12;

class Triangulation {
 public:
  explicit Triangulation(const PointCounter& count) : count_(count) {}

  /// Adds the points of a patch along a curve on which neighbours follow each other, and which only they decide. False
  /// where two coincide.
  bool insert(std::span<const Point2> points) {
    std::vector<Kernel::Point_2> places;
    std::vector<std::size_t> order;
    for (const Point2& p : points) {
      order.push_back(order.size());
      places.emplace_back(p.x, p.y);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    const auto placeOf = CGAL::make_property_map(places);
    CGAL::hilbert_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(placeOf)>(placeOf));
    vertices.resize(points.size());
    for (const std::size_t i : order) {
      const std::size_t before = delaunay.number_of_vertices();
      vertices[i] = delaunay.insert(places[i], hint_);
      if (delaunay.number_of_vertices() == before) return false;
      vertices[i]->info() = static_cast<std::uint32_t>(i);
      hint_ = vertices[i]->face();
      tick();
    }
    return true;
  }

  /// Makes a..b an edge for good. False where another constraint or a point is in its way.
  bool constrain(std::uint32_t a, std::uint32_t b) {
    tick();
    try {
      delaunay.insert_constraint(vertices[a], vertices[b]);
    } catch (const Delaunay::Intersection_of_constraints_exception&) {
      return false;
    }
    return delaunay.is_edge(vertices[a], vertices[b]);
  }

  /// The face on the left of the edge a..b, which exists.
  FaceHandle leftOf(std::uint32_t a, std::uint32_t b) const {
    FaceHandle face;
    int i = 0;
    delaunay.is_edge(vertices[a], vertices[b], face, i);
    return face->vertex(Delaunay::ccw(i)) == vertices[a] ? face : face->neighbor(i);
  }

  void unmark() {
    for (const FaceHandle face : delaunay.all_face_handles()) face->info() = kNone;
  }

  Delaunay delaunay;
  std::vector<VertexHandle> vertices;

 private:
  void tick() {
    if (++done_ % kCountedPoints == 0) count_(kCountedPoints);
  }

  const PointCounter& count_;
  std::size_t done_ = 0;
  FaceHandle hint_{};
};

/// Marks what the border encloses; false where that reaches the outside.
bool markInside(Triangulation& all, std::span<const Pair> border) {
  all.unmark();
  std::vector<FaceHandle> front;
  const auto take = [&](FaceHandle face) {
    if (face->info() == kInside) return;
    face->info() = kInside;
    front.push_back(face);
  };
  for (const auto& [a, b] : border) take(all.leftOf(a, b));
  while (!front.empty()) {
    const FaceHandle face = front.back();
    front.pop_back();
    if (all.delaunay.is_infinite(face)) return false;
    for (int i = 0; i < 3; ++i) {
      if (!face->is_constrained(i)) take(face->neighbor(i));
    }
  }
  return true;
}

/// The faces that are marked. Nothing where they have not `sides` sides that are for good - were there more, the inside
/// would reach over one of them - or do not take all points.
std::optional<std::vector<Triangle>> insideFaces(const Triangulation& all, std::size_t sides) {
  std::vector<Triangle> faces;
  std::size_t constrained = 0;
  std::vector<bool> used(all.vertices.size());
  for (const FaceHandle face : all.delaunay.finite_face_handles()) {
    if (face->info() != kInside) continue;
    Triangle t{};
    for (int k = 0; k < 3; ++k) {
      t[static_cast<std::size_t>(k)] = face->vertex(k)->info();
      constrained += face->is_constrained(k);
      used[face->vertex(k)->info()] = true;
    }
    faces.push_back(t);
  }
  if (constrained != sides || std::find(used.begin(), used.end(), false) != used.end()) return std::nullopt;
  return faces;
}

}  // namespace

struct PatchLocator::State {
  explicit State(const PointCounter& count) : all(count) {}

  Triangulation all;
  bool valid = false;
  FaceHandle hint{};

  bool build(std::span<const Point2> points, std::span<const Triangle> faces) {
    if (!all.insert(points)) return false;
    for (const Triangle& t : faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!all.constrain(t[k], t[(k + 1) % 3])) return false;
      }
    }
    all.unmark();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const auto& [a, b, c] = faces[f];
      const FaceHandle face = all.leftOf(a, b);
      if (face->info() != kNone || !face->has_vertex(all.vertices[c]) || all.delaunay.is_infinite(face)) return false;
      face->info() = f;
    }
    return true;
  }
};

PatchLocator::PatchLocator(std::span<const Point2> points, std::span<const Triangle> faces, const PointCounter& count)
    : state_(std::make_unique<State>(count)) {
  state_->valid = state_->build(points, faces);
}

PatchLocator::~PatchLocator() = default;

bool PatchLocator::valid() const {
  return state_->valid;
}

std::uint32_t PatchLocator::find(Point2 place) {
  const Delaunay& delaunay = state_->all.delaunay;
  Delaunay::Locate_type type = Delaunay::FACE;
  int i = 0;
  const FaceHandle face = delaunay.locate(Kernel::Point_2(place.x, place.y), type, i, state_->hint);
  if (!delaunay.is_infinite(face)) state_->hint = face;
  if (face->info() != kNone || type == Delaunay::FACE) return face->info();
  if (type == Delaunay::EDGE) return face->neighbor(i)->info();
  if (type != Delaunay::VERTEX) return kNone;
  auto around = delaunay.incident_faces(face->vertex(i));
  for (const auto first = around; around->info() == kNone;) {
    if (++around == first) return kNone;
  }
  return around->info();
}

std::optional<std::vector<Triangle>> triangulatePatch(std::span<const Point2> points, std::span<const Pair> border,
                                                      std::span<const Pair> wishes, const PointCounter& count) {
  Triangulation all(count);
  if (!all.insert(points)) return std::nullopt;
  std::vector<Pair> pieces(border.begin(), border.end());
  const auto lesserFirst = [&](const Pair& piece) {
    const Kernel::Point_2 &a = all.vertices[piece[0]]->point(), &b = all.vertices[piece[1]]->point();
    return a < b ? std::pair(a, b) : std::pair(b, a);
  };
  std::sort(pieces.begin(), pieces.end(),
            [&](const auto& s, const auto& t) { return lesserFirst(s) < lesserFirst(t); });
  for (const auto& [a, b] : pieces) {
    if (!all.constrain(a, b)) return std::nullopt;
  }
  for (const auto& [a, b] : wishes) {
    if (!all.constrain(a, b)) continue;
    pieces.push_back({a, b});
    pieces.push_back({b, a});
  }
  // A constraint made later may have been cut by none, but an edge that was there before may have become part of it.
  for (const auto& [a, b] : pieces) {
    if (!all.delaunay.is_edge(all.vertices[a], all.vertices[b])) return std::nullopt;
  }
  if (!markInside(all, pieces)) return std::nullopt;
  return insideFaces(all, pieces.size());
}

}  // namespace shbake
