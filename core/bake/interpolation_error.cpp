#include "bake/interpolation_error.h"

#include <algorithm>
#include <array>

#include "bake/baker.h"
#include "bake/direction_set.h"
#include "bake/flush_denormals.h"
#include "bake/ray_scene.h"
#include "bake/surface_tracer.h"
#include "base/error.h"
#include "base/hash.h"

namespace shbake {
namespace {

/// The independent streams of random numbers.
enum Stream : std::uint64_t { kFirstBake, kSecondBake, kFirstRays, kSecondRays };

/// A bake of the marked points, with reflections.
TransferSet bakeOnce(TracedPoints& traced, const std::vector<std::uint8_t>& corners, BakeOptions options, Stream stream,
                     const Parallel& parallel, Progress& progress) {
  options.seed = hashBits(options.seed, stream);
  return bakePoints(traced, corners, options, parallel, progress).transfer;
}

/// The same without reflections, and without looking at other points.
TransferSet traceOnce(const LightingPoints& points, const std::vector<std::uint8_t>& corners, const RayScene& scene,
                      const DirectionSet& directions, const BakeOptions& options, Stream stream,
                      const Parallel& parallel, Progress& progress) {
  TransferSet set;
  set.order = options.order;
  const auto count = static_cast<std::size_t>(set.coefficientsPerChannel());
  for (std::size_t p = 0; p < corners.size(); ++p) {
    if (corners[p] != 0 && isColored(points.pointAlbedo[p])) set.channels = 3;
  }
  set.coefficients.assign(corners.size() * set.stride(), 0);
  std::vector<SurfaceTracer> tracers;
  for (int i = 0; i < parallel.threads(); ++i) {
    tracers.emplace_back(points, scene, directions, hashBits(options.seed, stream), options.twoSided, nullptr);
  }
  progress.begin("tracing", static_cast<double>(corners.size()), "points");
  parallel.forBlocks(corners.size(), 256, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    std::vector<double> row(count);
    for (std::size_t p = begin; p < end; ++p) {
      if (corners[p] == 0) continue;
      tracers[static_cast<std::size_t>(worker)].trace(static_cast<std::uint32_t>(p), row);
      const Rgb& rho = points.pointAlbedo[p];
      const std::array<float, 3> albedo{rho.x, rho.y, rho.z};
      for (std::size_t i = 0; i < set.stride(); ++i) {
        set.coefficients[p * set.stride() + i] = albedo[i / count] * static_cast<float>(row[i % count]);
      }
    }
    progress.advance(static_cast<double>(end - begin));
  });
  progress.end();
  return set;
}

/// Appends the position of each point that is marked, once.
void addPositions(const LightingPoints& points, const std::vector<std::uint8_t>& marked,
                  std::vector<std::uint32_t>& positions) {
  const auto first = static_cast<std::ptrdiff_t>(positions.size());
  for (std::size_t p = 0; p < marked.size(); ++p) {
    if (marked[p] != 0) positions.push_back(points.pointPosition[p]);
  }
  std::sort(positions.begin() + first, positions.end());
  positions.erase(std::unique(positions.begin() + first, positions.end()), positions.end());
}

}  // namespace

std::vector<double> interpolationSquares(TracedPoints& traced, std::span<const SurfacePlace> places,
                                         const BakeOptions& options, const Parallel& parallel, Progress& progress) {
  if (options.kind == TransferKind::unshadowed || options.rays == 0) {
    throw usageError("the error of interpolation needs rays", "set BakeOptions::rays and a kind that is traced");
  }
  const std::size_t firstPlace = traced.points().size();
  const LightingPoints points = withPlaces(traced.points(), places);
  std::vector<std::uint8_t> corners(firstPlace, 0);
  for (const SurfacePlace& place : places) {
    for (const std::uint32_t p : points.facePoints[place.face]) corners[p] = 1;
  }
  const bool reflects = options.kind == TransferKind::interreflected && options.bounces != 0;
  TransferSet first, second;
  if (reflects) {
    first = bakeOnce(traced, corners, options, kFirstBake, parallel, progress);
    second = bakeOnce(traced, corners, options, kSecondBake, parallel, progress);
  }
  std::vector<std::uint32_t> origins = positionsFrom(points, firstPlace);
  if (!reflects) addPositions(points, corners, origins);
  const Contacts contacts(points, traced.tree(), origins, parallel, progress);
  const RayScene scene(points, traced.tree(), contacts, static_cast<float>(options.maxDistance * points.frame.scale));
  const DirectionSet directions(options.rays, options.order);
  if (!reflects) {
    first = traceOnce(points, corners, scene, directions, options, kFirstBake, parallel, progress);
    second = traceOnce(points, corners, scene, directions, options, kSecondBake, parallel, progress);
  }
  std::vector<SurfaceTracer> ones, others;
  for (int i = 0; i < parallel.threads(); ++i) {
    const auto tracer = [&](Stream stream, const TransferSet& baked) {
      return SurfaceTracer(points, scene, directions, hashBits(options.seed, stream), options.twoSided,
                           reflects ? &baked : nullptr);
    };
    ones.push_back(tracer(kFirstRays, first));
    others.push_back(tracer(kSecondRays, second));
  }
  std::vector<double> squares(places.size());
  progress.begin("probing the surface", static_cast<double>(places.size()) * 2 * directions.size(), "rays");
  parallel.forBlocks(places.size(), 16, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    std::vector<double> one(first.stride()), other(first.stride());
    for (std::size_t s = begin; s < end; ++s) {
      const auto p = static_cast<std::uint32_t>(firstPlace + s);
      ones[static_cast<std::size_t>(worker)].trace(p, one);
      others[static_cast<std::size_t>(worker)].trace(p, other);
      squares[s] = relativeSquare(points.facePoints[places[s].face], places[s].weights, points.pointAlbedo[p],
                                  {first, one}, {second, other});
      progress.advance(2 * directions.size());
    }
  });
  progress.end();
  return squares;
}

}  // namespace shbake
