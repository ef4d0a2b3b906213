// The sky that a vertex truly sees, face by face.
#include "stability/sky_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace shbake::stability {
namespace {

using Real = long double;
using Vec = Vec3<Real>;

/// Of the size of the mesh: how far from the vertex rays start, how far its surroundings reach.
constexpr Real kStart = 1e-10L, kSurroundings = 1e-8L;
/// Of the distance to the vertex: how far above the face.
constexpr Real kAbove = 1e-6L;
/// Faces are equally wide when their angles differ by less than this part.
constexpr Real kTie = 1e-3L;

Vec unit(const Vec& v) {
  return v * (1 / length(v));
}

/// The distance at which the ray from the origin along d meets the triangle a, b, c; not above 0 where it does not. The
/// signed volumes tell on which side of each edge the ray passes.
Real distanceTo(const Vec& d, const Vec& a, const Vec& b, const Vec& c) {
  const Real u = dot(cross(d, a), b), v = dot(cross(d, b), c), w = dot(cross(d, c), a);
  if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return 0;
  const Vec normal = cross(b - a, c - a);
  const Real slope = dot(normal, d);
  return slope == 0 ? 0 : dot(normal, a) / slope;
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

SkyOracle::SkyOracle(std::vector<Vec3d> positions, std::vector<Triangle> faces)
    : positions_(std::move(positions)), users_(positions_.size()) {
  // Vertices at one position get the number of the first of them.
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  std::vector<std::uint32_t> welded(positions_.size());
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    const Vec3d& p = positions_[v];
    welded[v] = known.try_emplace({p.x, p.y, p.z}, v).first->second;
  }
  std::vector<std::uint32_t> parent(positions_.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::set<Triangle> taken;
  Vec3d low = positions_[faces[0][0]], high = low;
  for (const Triangle& face : faces) {
    Triangle t{welded[face[0]], welded[face[1]], welded[face[2]]};
    const Vec a(positions_[t[0]]), b(positions_[t[1]]), c(positions_[t[2]]);
    if (cross(b - a, c - a) == Vec()) continue;
    for (const std::uint32_t v : face) {
      users_[v].push_back(face);
      const Vec3d& p = positions_[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    std::sort(t.begin(), t.end());
    if (!taken.insert(t).second) continue;
    faces_.push_back(t);
    parent[rootOf(parent, t[1])] = rootOf(parent, t[0]);
    parent[rootOf(parent, t[2])] = rootOf(parent, t[0]);
  }
  size_ = length(high - low);
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const Triangle& t : faces_) {
    const auto next = static_cast<std::uint32_t>(numbers.size());
    part_.push_back(numbers.try_emplace(rootOf(parent, t[0]), next).first->second);
  }
  parts_ = static_cast<std::uint32_t>(numbers.size());
}

SkyOracle::Start SkyOracle::startAbove(const Vec3d& vertex, const Vec& offset) const {
  Start start;
  start.origin_ = Vec(vertex) + offset;
  for (const Triangle& t : faces_) {
    const Vec3d a = positions_[t[0]] - vertex, b = positions_[t[1]] - vertex, c = positions_[t[2]] - vertex;
    const Vec3d middle = (a + b + c) * (1.0 / 3);
    // A thousandth more than the corners need, for the rounding of this estimate and the start beside the vertex.
    const double radius = 1.001 * std::max({length(a - middle), length(b - middle), length(c - middle)});
    const double sine = radius / length(middle);
    start.cones_.push_back({normalized(middle), sine < 0.999 ? std::sqrt((1 - sine) * (1 + sine)) - 1e-6 : -2});
  }
  return start;
}

std::vector<SkyOracle::Start> SkyOracle::startsAt(std::uint32_t v, const Vec3d& normal) const {
  struct Sector {
    Real angle;
    Vec offset;
  };
  std::vector<Sector> sectors;
  Real widest = 0;
  for (const Triangle& face : users_[v]) {
    const auto k = static_cast<std::size_t>(std::find(face.begin(), face.end(), v) - face.begin());
    const Vec here(positions_[v]);
    const Vec a = unit(Vec(positions_[face[(k + 1) % 3]]) - here), b = unit(Vec(positions_[face[(k + 2) % 3]]) - here);
    const Vec up = unit(cross(a, b));
    const Real side = dot(up, Vec(normal)) < 0 ? -1 : 1;
    sectors.push_back({angleBetween(a, b), (unit(a + b) + up * (side * kAbove)) * (kStart * size_)});
    widest = std::max(widest, sectors.back().angle);
  }
  std::erase_if(sectors, [&](const Sector& s) { return s.angle < widest * (1 - kTie); });
  const std::size_t count = std::min(sectors.size(), kMostStarts);
  std::vector<Start> starts;
  for (std::size_t i = 0; i < count; ++i) {
    starts.push_back(startAbove(positions_[v], sectors[i * sectors.size() / count].offset));
  }
  return starts;
}

bool SkyOracle::seesSky(const Start& start, const Vec3d& direction) const {
  const Vec d(direction);
  const Real surroundings = kSurroundings * size_;
  std::vector<bool> behind(parts_, false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (dot(start.cones_[f].axis, direction) < start.cones_[f].least) continue;
    const auto corner = [&](std::size_t k) { return Vec(positions_[faces_[f][k]]) - start.origin_; };
    const Real distance = distanceTo(d, corner(0), corner(1), corner(2));
    if (distance > surroundings) return false;
    if (distance > 0) behind[part_[f]] = !behind[part_[f]];
  }
  return std::find(behind.begin(), behind.end(), true) == behind.end();
}

}  // namespace shbake::stability
