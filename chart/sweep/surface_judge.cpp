// Errors at the same places for all bakes: drawn and traced once, kept in a file, found again on refined meshes.
#include "chart/sweep/surface_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "bake/surface_places.h"
#include "chart/sweep/sample.h"
#include "sh/irradiance.h"

namespace shbake::chart {
namespace {

/// A seed that no bake, and no other reference, draws with.
constexpr std::uint64_t kPlacesSeed = 0x5EED0005;
/// 97.5 % quantile of the normal distribution.
constexpr double kConfidence = 1.959963984540054;

double rootOf(double square) {
  return std::sqrt(std::max(0.0, square));
}

}  // namespace

SurfaceJudge::SurfaceJudge(const LightingPoints& points, const SurfaceJudgeOptions& options, const Deadline& deadline,
                           const Parallel& parallel, Progress& progress)
    : points_(points) {
  Progress polled([&progress](const ProgressState&) { return progress.tryAdvance(0); });
  const std::vector<SurfacePlace> places =
      drawPlaces(points, areaWeights(points, points.faces.size()), options.places, kPlacesSeed, polled);
  if (places.empty()) return;
  addPlaces(points_, places);
  // Blocks of places in an order of which any first part is spread over the surface; both places of a stratum stand in
  // one block.
  sample_ = samplePoints(places.size(), places.size());
  for (std::uint32_t& i : sample_) i += static_cast<std::uint32_t>(points.size());
  const RayScene scene(points_, std::numeric_limits<float>::infinity(), parallel, polled);
  MadeReference made =
      makeReference(points_, scene, sample_, {.order = options.order, .rays = options.rays, .cache = options.cache},
                    deadline, parallel, progress);
  reference_ = std::move(made.reference);
  cache_ = made.cache;
}

Vec3f SurfaceJudge::toWork(const Vec3d& position, const WorkFrame& from) const {
  return points_.frame.toWork(position * (1 / from.scale) + from.centre);
}

PointSurface SurfaceJudge::surfaceOf(const LightingPoints& points) const {
  PointSurface surface{{}, points.pointNormal, points.facePoints};
  for (const std::uint32_t p : points.pointPosition) {
    surface.positions.push_back(toWork(Vec3d(points.positions[p]), points.frame));
  }
  return surface;
}

PointSurface SurfaceJudge::surfaceOf(const Mesh& mesh) const {
  PointSurface surface{{}, mesh.vertexNormals, mesh.triangles};
  for (const Vec3d& p : mesh.positions) surface.positions.push_back(points_.frame.toWork(p));
  return surface;
}

/// The squared error at place number `i` of the reference, which lies at `place` of the surface.
double SurfaceJudge::squareAt(std::size_t i, const SurfacePlace& place, const PointSurface& surface,
                              const TransferSet& baked) const {
  const Rgb& rho = points_.pointAlbedo[sample_[i]];
  const std::array<float, 3> albedo{rho.x, rho.y, rho.z};
  const std::size_t count = reference_.stride();
  const float *first = &reference_.first[i * count], *second = &reference_.second[i * count];
  std::vector<double> t(baked.stride(), 0);
  addInterpolated(baked, surface.faces[place.face], place.weights, 1, t);
  double square = 0, scale = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(baked.channels); ++c) {
    const auto r = static_cast<double>(albedo[c]);
    for (std::size_t k = 0; k < count; ++k) {
      square += (t[c * count + k] - r * static_cast<double>(first[k])) *
                (t[c * count + k] - r * static_cast<double>(second[k]));
    }
    scale += r * r;
  }
  return square / (scale * std::pow(sh::unshadowedNorm(reference_.order), 2));
}

SurfaceError SurfaceJudge::errorOf(const PointSurface& surface, const TransferSet& baked) const {
  SurfaceError error;
  const std::size_t n = places();
  if (n == 0) return error;
  const PlaceFinder finder(surface);
  std::vector<double> squares(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t p = sample_[i];
    const SurfacePlace place = finder.nearest(points_.positions[points_.pointPosition[p]], points_.pointNormal[p]);
    squares[i] = squareAt(i, place, surface, baked);
  }
  const auto count = static_cast<double>(n);
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / count;
  // Two places in each stratum: half their squared difference is its variance, and the mean has 1/count of that.
  double variance = 0;
  for (std::size_t i = 0; i + 1 < n; i += 2) variance += std::pow((squares[i] - squares[i + 1]) / count, 2);
  const double reach = kConfidence * std::sqrt(variance);
  error.samples = n;
  error.rays = reference_.rays + reference_.rays / 16 * 15;
  error.rms = rootOf(mean);
  error.low = rootOf(mean - reach);
  error.high = rootOf(mean + reach);
  const auto worst = std::max_element(squares.begin(), squares.end());
  error.worst = rootOf(*worst);
  const std::uint32_t p = sample_[static_cast<std::size_t>(worst - squares.begin())];
  error.worstPosition =
      Vec3d(points_.positions[points_.pointPosition[p]]) * (1 / points_.frame.scale) + points_.frame.centre;
  return error;
}

}  // namespace shbake::chart
