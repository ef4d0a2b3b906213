#include "bake/surface_places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "base/passes.h"

namespace shbake {
namespace {

/// The corner with the lowest number of a point, and the points from there on: the same however a face is turned.
std::size_t firstCorner(const Triangle& t) {
  return static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
}
Triangle fromFirstCorner(const Triangle& t) {
  const std::size_t k = firstCorner(t);
  return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}

/// The faces that have a weight, in the order of their points from the lowest on, whatever their own order. Points are
/// numbered along a curve, so that their lists are nearly sorted: one list for each lowest point, then within them.
std::vector<std::uint32_t> facesAlongCurve(const LightingPoints& points, std::span<const double> weights,
                                           Passes& passes) {
  const auto lowest = [&](std::uint32_t f) { return *std::ranges::min_element(points.facePoints[f]); };
  std::vector<std::uint32_t> ends(points.size() + 1, 0), order;
  passes.forEach<std::uint32_t>(weights.size(), [&](std::uint32_t f) {
    if (weights[f] > 0) ++ends[lowest(f) + 1];
  });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  order.resize(ends.back());
  passes.forEach<std::uint32_t>(weights.size(), [&](std::uint32_t f) {
    if (weights[f] > 0) order[ends[lowest(f)]++] = f;
  });
  passes.forEach(points.size(), [&](std::size_t p) {
    const auto begin = order.begin() + (p == 0 ? 0 : ends[p - 1]);
    std::sort(begin, order.begin() + ends[p], [&](std::uint32_t a, std::uint32_t b) {
      const Triangle ta = fromFirstCorner(points.facePoints[a]), tb = fromFirstCorner(points.facePoints[b]);
      return ta != tb ? ta < tb : a < b;
    });
  });
  return order;
}

/// The place's value of something that each corner has.
template <class T, class OfCorner>
Vec3<T> blend(const SurfacePlace& place, const OfCorner& ofCorner) {
  Vec3d sum;
  for (std::size_t k = 0; k < 3; ++k) sum += Vec3d(ofCorner(k)) * place.weights[k];
  return Vec3<T>(sum);
}

}  // namespace

double faceArea(const LightingPoints& points, std::uint32_t face) {
  const auto corner = [&](std::size_t k) { return Vec3d(points.positions[points.faces[face][k]]); };
  return length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
}

bool isBlackFace(const LightingPoints& points, std::uint32_t face) {
  const Triangle& t = points.facePoints[face];
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t p) { return points.pointAlbedo[p] == Rgb(); });
}

std::vector<double> areaWeights(const LightingPoints& points, std::size_t faces) {
  std::vector<double> weights(faces);
  for (std::uint32_t f = 0; f < faces; ++f) weights[f] = isBlackFace(points, f) ? 0 : faceArea(points, f);
  return weights;
}

std::vector<SurfacePlace> drawPlaces(const LightingPoints& points, std::span<const double> weights, std::size_t count,
                                     std::uint64_t seed, Progress& progress) {
  // Lists 3, weights 1.
  Passes passes(progress, "placing samples", weights.size(), "faces", 4);
  const std::vector<std::uint32_t> order = facesAlongCurve(points, weights, passes);
  std::vector<double> ends;  // the weight up to the end of each face in order
  ends.reserve(order.size());
  double total = 0;
  passes.forEach(order.size(), [&](std::size_t i) { ends.push_back(total += weights[order[i]]); });
  passes.end();
  std::vector<SurfacePlace> places;
  if (total == 0) return places;
  const double stratum = total / static_cast<double>(count / 2);
  for (std::size_t s = 0; s < count; ++s) {
    const double at = (static_cast<double>(s / 2) + hashUnit(seed, 2 * s)) * stratum;
    // The last face with a weight where rounding has carried `at` to the end.
    auto end = std::upper_bound(ends.begin(), ends.end(), at);
    if (end == ends.end()) end = std::lower_bound(ends.begin(), ends.end(), total);
    const double begin = end == ends.begin() ? 0 : *(end - 1);
    const double x = std::min((at - begin) / (*end - begin), 1.0), y = hashUnit(seed, 2 * s + 1), root = std::sqrt(x);
    SurfacePlace place{order[static_cast<std::size_t>(end - ends.begin())], {}};
    const std::size_t k = firstCorner(points.facePoints[place.face]);
    place.weights[k] = 1 - root;
    place.weights[(k + 1) % 3] = root * (1 - y);
    place.weights[(k + 2) % 3] = root * y;
    places.push_back(place);
  }
  return places;
}

PlacedPoint pointAt(const LightingPoints& points, const SurfacePlace& place) {
  const Triangle &corners = points.faces[place.face], &facePoints = points.facePoints[place.face];
  const auto position = [&](std::size_t k) { return points.positions[corners[k]]; };
  Vec3d normal = normalized(blend<double>(place, [&](std::size_t k) { return points.pointNormal[facePoints[k]]; }));
  if (normal == Vec3d()) {
    normal = normalized(cross(Vec3d(position(1) - position(0)), Vec3d(position(2) - position(0))));
  }
  // Adding zeros makes negative ones positive.
  return {blend<float>(place, position) + Vec3f(), Vec3f(normal),
          blend<float>(place, [&](std::size_t k) { return points.pointAlbedo[facePoints[k]]; })};
}

void addPlaces(LightingPoints& points, std::span<const SurfacePlace> places) {
  for (const SurfacePlace& place : places) {
    const PlacedPoint point = pointAt(points, place);
    points.pointPosition.push_back(static_cast<std::uint32_t>(points.positions.size()));
    points.positions.push_back(point.position);
    points.positionFaces.starts.push_back(static_cast<std::uint32_t>(points.positionFaces.items.size()));
    points.pointNormal.push_back(point.normal);
    points.pointAlbedo.push_back(point.albedo);
  }
  // Room for one more, so that they are traced in place.
  points.positions.reserve(points.positions.size() + 1);
}

LightingPoints withPlaces(const LightingPoints& points, std::span<const SurfacePlace> places) {
  LightingPoints more;
  more.frame = points.frame;
  more.faces = points.faces;
  more.facePoints = points.facePoints;
  more.positionFaces.items = points.positionFaces.items;
  const auto copy = [&](auto& to, const auto& from) {
    to.reserve(from.size() + places.size() + 1);  // one position more, as addPlaces() leaves
    to.assign(from.begin(), from.end());
  };
  copy(more.positions, points.positions);
  copy(more.positionFaces.starts, points.positionFaces.starts);
  copy(more.pointPosition, points.pointPosition);
  copy(more.pointNormal, points.pointNormal);
  copy(more.pointAlbedo, points.pointAlbedo);
  addPlaces(more, places);
  return more;
}

std::vector<std::uint32_t> positionsFrom(const LightingPoints& points, std::size_t first) {
  return {points.pointPosition.begin() + static_cast<std::ptrdiff_t>(first), points.pointPosition.end()};
}

void addInterpolated(const TransferSet& set, const Triangle& corners, const std::array<double, 3>& weights,
                     double weight, std::span<double> sum) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* row = &set.coefficients[corners[k] * set.stride()];
    const double w = weight * weights[k];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * static_cast<double>(row[i]);
  }
}

}  // namespace shbake
