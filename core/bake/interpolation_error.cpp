#include "bake/interpolation_error.h"

#include "bake/baker.h"
#include "bake/direction_set.h"
#include "bake/ray_scene.h"
#include "bake/surface_tracer.h"
#include "base/error.h"
#include "base/hash.h"

namespace shbake {
namespace {

/// The independent streams of random numbers.
enum Stream : std::uint64_t { kFirstBake, kSecondBake, kFirstRays, kSecondRays };

TransferSet bakeOnce(const LightingPoints& points, const std::vector<std::uint8_t>& corners, BakeOptions options,
                     Stream stream, const Parallel& parallel, Progress& progress) {
  options.seed = hashBits(options.seed, stream);
  return bakePoints(points, corners, options, parallel, progress).transfer;
}

}  // namespace

std::vector<double> interpolationSquares(LightingPoints points, std::span<const SurfacePlace> places,
                                         const BakeOptions& options, const Parallel& parallel, Progress& progress) {
  if (options.kind == TransferKind::unshadowed || options.rays == 0) {
    throw usageError("the error of interpolation needs rays", "set BakeOptions::rays and a kind that is traced");
  }
  std::vector<std::uint8_t> corners(points.size(), 0);
  for (const SurfacePlace& place : places) {
    for (const std::uint32_t p : points.facePoints[place.face]) corners[p] = 1;
  }
  const TransferSet first = bakeOnce(points, corners, options, kFirstBake, parallel, progress);
  const TransferSet second = bakeOnce(points, corners, options, kSecondBake, parallel, progress);
  const bool reflects = options.kind == TransferKind::interreflected && options.bounces != 0;

  const std::size_t firstPlace = points.size();
  addPlaces(points, places);
  const RayScene scene(points, static_cast<float>(options.maxDistance * points.frame.scale), parallel, progress);
  const DirectionSet directions(options.rays, options.order);
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
      squares[s] = relativeSquare(points, places[s], p, {first, one}, {second, other});
      progress.advance(2 * directions.size());
    }
  });
  progress.end();
  return squares;
}

}  // namespace shbake
