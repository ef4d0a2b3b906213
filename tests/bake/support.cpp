// What the tests of baking share.
#include "bake/support.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bake/ray_scene.h"
#include "sh/local_frame.h"

namespace shbake::testing {

LightingPoints pointsOf(const Mesh& mesh, Rgb albedo, const LightingPointOptions& options) {
  Albedo all;
  all.values = {albedo};
  if (!mesh.faceColors.empty()) {
    all.per = Albedo::Per::face;
    all.values = mesh.faceColors;
  }
  Progress progress;
  return makeLightingPoints(mesh, options, all, progress);
}

Contacts contactsOf(const LightingPoints& points) {
  Progress progress;
  return RayScene(points, std::numeric_limits<float>::infinity(), Parallel(1), progress).contacts();
}

BakeOptions optionsOf(TransferKind kind, int order, int rays, std::uint64_t seed) {
  BakeOptions options;
  options.kind = kind;
  options.order = order;
  options.rays = rays;
  options.seed = seed;
  return options;
}

PointBake bakeAll(const LightingPoints& points, const BakeOptions& options, int threads) {
  const Parallel parallel(threads);
  Progress progress;
  return bakePoints(points, {}, options, parallel, progress);
}

PointBake bakeSome(const LightingPoints& points, const std::vector<std::uint32_t>& wanted, const BakeOptions& options) {
  std::vector<std::uint8_t> flags(points.size(), 0);
  for (const std::uint32_t p : wanted) flags[p] = 1;
  const Parallel parallel(1);
  Progress progress;
  return bakePoints(points, flags, options, parallel, progress);
}

std::uint32_t pointOfVertex(const LightingPoints& points, std::uint32_t v) {
  REQUIRE(points.outputPoint.at(v) != LightingPoints::kNone);
  return points.outputPoint[v];
}

Vec3d randomDirection(std::uint64_t seed, std::uint64_t i) {
  const double z = 2 * hashUnit(seed, 2 * i) - 1, phi = 2 * kPi * hashUnit(seed, 2 * i + 1), r = std::sqrt(1 - z * z);
  return normalized(Vec3d{r * std::cos(phi), r * std::sin(phi), z});
}

std::vector<Vec3d> directionsOf(const LightingPoints& points, std::uint32_t point, const DirectionSet& set,
                                std::uint64_t seed) {
  const sh::LocalFrame frame = sh::localFrame(Vec3d(points.pointNormal[point]), 2 * kPi * hashUnit(seed, point));
  std::vector<Vec3d> directions(static_cast<std::size_t>(set.size()));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    directions[i] = frame.x * double(set.x()[i]) + frame.y * double(set.y()[i]) + frame.z * double(set.z()[i]);
  }
  return directions;
}

void Samples::add(std::span<const double> values) {
  if (count_ == 0) {
    shift_.assign(values.begin(), values.end());
    sum_.assign(values.size(), 0);
    squares_.assign(values.size(), 0);
  }
  REQUIRE(values.size() == sum_.size());
  ++count_;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double d = values[i] - shift_[i];
    sum_[i] += d;
    squares_[i] += d * d;
  }
}

double Samples::standardError(std::size_t i) const {
  const double variance = (squares_[i] - sum_[i] * sum_[i] / count_) / (count_ - 1);
  return std::sqrt(std::max(0.0, variance) / count_);
}

double errorLimit(std::size_t comparisons, int samples) {
  const double tail = 1e-4 / static_cast<double>(comparisons);  // both tails together
  double low = 0, high = 40;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::numbers::sqrt2) > tail ? low : high) = middle;
  }
  return low * (1 + (low * low + 1) / (4 * (samples - 1)));
}

double relativeDifference(std::span<const float> a, std::span<const float> b) {
  REQUIRE(a.size() == b.size());
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::pow(double(a[i]) - double(b[i]), 2);
    norm += std::pow(double(b[i]), 2);
  }
  return std::sqrt(difference / norm);
}

}  // namespace shbake::testing
