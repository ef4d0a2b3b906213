// A tree of equilateral triangles. Its corners at all depths lie on one lattice, as those of a quadtree do, and in the
// densest packing of equal discs: their Delaunay triangles are equilateral but where depths meet.
#include "mesh/patch_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/hash.h"

namespace shbake {
namespace {

constexpr int kDeepest = 30;
const double kRowHeight = std::sqrt(3.0) / 2;
// Of the side: from the centre to the corners; and what points keep away from obstacles, half of what lies between two
// rows: a border between rows then has the next one at most one and a half rows away.
constexpr double kCircumradius = 0.5773502691896258;
constexpr double kClearance = 0.4330127018922193;
constexpr std::size_t kCountedPoints = 1 << 10;

/// Where a corner of the tree is, in units of the deepest triangles: (i, j) stands for i along x and j at 60 degrees.
struct LatticePlace {
  std::int64_t i, j;
  friend bool operator==(const LatticePlace&, const LatticePlace&) = default;
};

struct LatticeHash {
  std::size_t operator()(const LatticePlace& p) const {
    return mixBits(static_cast<std::uint64_t>(p.i) + 3 * mixBits(static_cast<std::uint64_t>(p.j)));
  }
};

/// A triangle at some depth: corners (i, j), (i+1, j), (i, j+1), or, where it points down, (i+1, j+1), (i, j+1),
/// (i+1, j), on the lattice of that depth.
struct Node {
  int depth = 0;
  std::int64_t i = 0, j = 0;
  bool down = false;

  std::array<LatticePlace, 3> corners() const {
    if (down) return {{{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}};
    return {{{i, j}, {i + 1, j}, {i, j + 1}}};
  }
  std::array<Node, 4> halves() const {
    const int d = depth + 1;
    const std::int64_t x = 2 * i, y = 2 * j;
    if (down) return {{{d, x + 1, y, true}, {d, x + 1, y + 1, false}, {d, x, y + 1, true}, {d, x + 1, y + 1, true}}};
    return {{{d, x, y, false}, {d, x, y, true}, {d, x + 1, y, false}, {d, x, y + 1, false}}};
  }
};

class Tree {
 public:
  Tree(PatchLocator& patch, std::span<const PatchObstacle> obstacles, const PatchLength& length,
       const PointCounter& count)
      : patch_(patch), obstacles_(obstacles), length_(length), count_(count) {}

  std::vector<PatchPoint> run() {
    placeRoot();
    std::vector<std::uint32_t> all(obstacles_.size());
    for (std::uint32_t o = 0; o < all.size(); ++o) all[o] = o;
    visit({}, all);
    std::vector<PatchPoint> points;
    for (const Corner& c : corners_) {
      if (!c.free) continue;
      const std::uint32_t face = patch_.find(c.place);
      if (face != PatchLocator::kNone) points.push_back({c.place, face});
    }
    return points;
  }

 private:
  // A corner of leaves, judged by the smallest one that has been seen.
  struct Corner {
    Point2 place;
    double side;
    bool free;
  };

  void placeRoot();
  void visit(const Node& node, std::span<const std::uint32_t> near);
  bool isShort(const Node& node, Point2 centre, std::span<const std::uint32_t> near, bool& outside);
  void judgeCorners(const Node& node, std::span<const std::uint32_t> near);

  static double clearanceOf(const PatchObstacle& o, double side) { return std::max(kClearance * side, o.clearance); }
  double sideAt(int depth) const { return std::ldexp(rootSide_, -depth); }
  Point2 placeOf(LatticePlace p, int depth) const {
    const double side = sideAt(depth), i = static_cast<double>(p.i), j = static_cast<double>(p.j);
    return {origin_.x + side * (i + 0.5 * j), origin_.y + side * kRowHeight * j};
  }

  PatchLocator& patch_;
  std::span<const PatchObstacle> obstacles_;
  const PatchLength& length_;
  const PointCounter& count_;
  Point2 origin_;
  double rootSide_ = 0;
  std::vector<Corner> corners_;
  std::unordered_map<LatticePlace, std::size_t, LatticeHash> numbers_;
};

/// A triangle around all obstacles whose side is a power of two times the least length at any of them.
void Tree::placeRoot() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point2 low{kFar, kFar}, high{-kFar, -kFar};
  double least = kFar;
  for (const PatchObstacle& o : obstacles_) {
    for (const Point2& p : {o.a, o.b}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    least = std::min(least, o.length);
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  // Finer than the deepest triangles need not be met, coarser than the patch neither.
  const double unit = std::clamp(least, std::ldexp(extent, 2 - kDeepest), extent);
  const double rowsBelow = std::max(0.0, std::ceil(-low.y / (kRowHeight * unit)));
  origin_.y = -rowsBelow * kRowHeight * unit;
  const double slant = (high.y - origin_.y) / (2 * kRowHeight);
  const double columnsBefore = std::ceil((slant - low.x) / unit - rowsBelow / 2);
  origin_.x = -(columnsBefore + rowsBelow / 2) * unit;
  rootSide_ = unit;
  while (rootSide_ < high.x - origin_.x + slant) rootSide_ *= 2;
}

void Tree::visit(const Node& node, std::span<const std::uint32_t> near) {
  Point2 centre;
  for (const LatticePlace& corner : node.corners()) {
    const Point2 p = placeOf(corner, node.depth);
    centre = {centre.x + p.x / 3, centre.y + p.y / 3};
  }
  const double side = sideAt(node.depth);
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t o : near) {
    const double reach = kCircumradius * side + clearanceOf(obstacles_[o], side);
    if (distanceTo(obstacles_[o], centre) <= reach) kept.push_back(o);
  }
  bool outside = false;
  const bool leaf = isShort(node, centre, kept, outside);
  if (outside) return;
  if (leaf || node.depth == kDeepest) return judgeCorners(node, kept);
  for (const Node& half : node.halves()) visit(half, kept);
}

/// The triangle's side is what is wanted at its centre, or where that is outside the patch, around it.
bool Tree::isShort(const Node& node, Point2 centre, std::span<const std::uint32_t> near, bool& outside) {
  const std::uint32_t face = patch_.find(centre);
  outside = face == PatchLocator::kNone && near.empty();
  double wanted = std::numeric_limits<double>::infinity();
  if (face != PatchLocator::kNone) {
    wanted = length_(face, centre);
  } else {
    for (const std::uint32_t o : near) {
      wanted = std::min(wanted, obstacles_[o].length + kSteepest * distanceTo(obstacles_[o], centre));
    }
  }
  return sideAt(node.depth) <= kLongestEdge * wanted;
}

void Tree::judgeCorners(const Node& node, std::span<const std::uint32_t> near) {
  const double side = sideAt(node.depth);
  for (const LatticePlace& corner : node.corners()) {
    const int shift = kDeepest - node.depth;
    const auto [found, isNew] = numbers_.try_emplace({corner.i << shift, corner.j << shift}, corners_.size());
    const Point2 place = placeOf(corner, node.depth);
    if (isNew) {
      corners_.push_back({place, std::numeric_limits<double>::infinity(), false});
      if (corners_.size() % kCountedPoints == 0) count_(kCountedPoints);
    }
    Corner& c = corners_[found->second];
    if (side >= c.side) continue;
    c.side = side;
    c.free = std::none_of(near.begin(), near.end(), [&](std::uint32_t o) {
      return distanceTo(obstacles_[o], place) < clearanceOf(obstacles_[o], side);
    });
  }
}

}  // namespace

double distanceTo(const PatchObstacle& o, Point2 p) {
  const double ex = o.b.x - o.a.x, ey = o.b.y - o.a.y, px = p.x - o.a.x, py = p.y - o.a.y;
  const double squared = ex * ex + ey * ey;
  const double t = squared > 0 ? std::clamp((px * ex + py * ey) / squared, 0.0, 1.0) : 0;
  return std::hypot(px - t * ex, py - t * ey);
}

std::vector<PatchPoint> spreadPoints(PatchLocator& patch, std::span<const PatchObstacle> obstacles,
                                     const PatchLength& length, const PointCounter& count) {
  return Tree(patch, obstacles, length, count).run();
}

}  // namespace shbake
