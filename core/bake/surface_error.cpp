// The error of interpolated transfer, measured at random points of the surface: maths.md (26) to (28).
#include "bake/surface_error.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bake/flush_denormals.h"
#include "bake/ray_scene.h"
#include "bake/sampled_mean.h"
#include "bake/senders.h"
#include "bake/surface_places.h"
#include "bake/surface_tracer.h"
#include "base/error.h"
#include "base/hash.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

/// A set has no more rays than this, or as many as the bake, whose table of directions would not fit the memory at
/// more.
constexpr int kMostTruthRays = 65536;
/// The independent streams of random numbers.
enum Stream : std::uint64_t { kPlaces, kFirstSet, kSecondSet };

class SurfaceMeter {
 public:
  SurfaceMeter(TracedPoints& traced, const TransferSet& baked, const BakeOptions& bake, const Parallel& parallel,
               Progress& progress)
      : traced_(traced),
        baked_(baked),
        bake_(bake),
        parallel_(parallel),
        progress_(progress),
        firstSample_(traced.points().size()) {}

  SurfaceError run(std::size_t faces, std::size_t samples, const TruthRays& rays) {
    const LightingPoints& own = traced_.points();
    places_ = drawPlaces(own, areaWeights(own, faces), samples, hashBits(bake_.seed, kPlaces), progress_);
    if (places_.empty()) return {};
    squares_.resize(samples);
    if (bake_.kind == TransferKind::unshadowed) {
      measureUnshadowed();
    } else {
      measureTraced(rays);
    }
    SurfaceError error =
        surfaceErrorOf(squares_, [&](std::size_t s) { return points_.filePosition(firstSample_ + s); });
    error.rays = raysOfSample_;
    return error;
  }

 private:
  double squareOf(std::size_t s, std::span<const double> first, std::span<const double> second) const {
    const auto p = static_cast<std::uint32_t>(firstSample_ + s);
    return relativeSquare(points_.facePoints[places_[s].face], places_[s].weights, points_.pointAlbedo[p],
                          {baked_, first}, {baked_, second});
  }

  void measureUnshadowed() {
    points_ = withPlaces(traced_.points(), places_);
    progress_.begin("measuring the surface", static_cast<double>(places_.size()), "samples");
    parallel_.forBlocks(places_.size(), 64, [&](std::size_t begin, std::size_t end, int) {
      const auto count = static_cast<std::size_t>(baked_.coefficientsPerChannel());
      std::vector<double> exact(count), all(baked_.stride());
      for (std::size_t s = begin; s < end; ++s) {
        const Vec3d normal = normalized(Vec3d(points_.pointNormal[firstSample_ + s]));
        sh::unshadowedTransfer(baked_.order, normal, 1, exact);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = exact[i % count];
        squares_[s] = squareOf(s, all, all);
      }
      progress_.advance(static_cast<double>(end - begin));
    });
    progress_.end();
  }

  void measureTraced(const TruthRays& rays) {
    const Senders senders(traced_, baked_, bake_, parallel_, progress_);
    points_ = withPlaces(traced_.points(), places_);
    const Contacts contacts(points_, traced_.tree(), positionsFrom(points_, firstSample_), parallel_, progress_);
    const auto maxDistance = static_cast<float>(bake_.maxDistance * points_.frame.scale);
    const RayScene scene(points_, traced_.tree(), contacts, maxDistance);
    const int most = std::max(kMostTruthRays, bake_.rays);
    const DirectionSet directions(
        std::max(rays.least, bake_.rays > most / rays.perRay ? most : rays.perRay * bake_.rays), baked_.order);
    raysOfSample_ = 2 * directions.size();
    std::vector<SurfaceTracer> first, second;
    for (int i = 0; i < parallel_.threads(); ++i) {
      const auto set = [&](Stream stream) {
        return SurfaceTracer(points_, scene, directions, hashBits(bake_.seed, stream), bake_.twoSided,
                             senders.transfer());
      };
      first.push_back(set(kFirstSet));
      second.push_back(set(kSecondSet));
    }
    progress_.begin("measuring the surface", static_cast<double>(places_.size()) * raysOfSample_, "rays");
    parallel_.forBlocks(places_.size(), 4, [&](std::size_t begin, std::size_t end, int worker) {
      const FlushDenormals flush;
      std::vector<double> one(baked_.stride()), other(baked_.stride());
      for (std::size_t s = begin; s < end; ++s) {
        const auto p = static_cast<std::uint32_t>(firstSample_ + s);
        first[static_cast<std::size_t>(worker)].trace(p, one);
        second[static_cast<std::size_t>(worker)].trace(p, other);
        squares_[s] = squareOf(s, one, other);
        progress_.advance(raysOfSample_);
      }
    });
    progress_.end();
  }

  TracedPoints& traced_;
  LightingPoints points_;  // with a place for each sample
  const TransferSet& baked_;
  const BakeOptions& bake_;
  const Parallel& parallel_;
  Progress& progress_;
  std::size_t firstSample_;
  std::vector<SurfacePlace> places_;
  std::vector<double> squares_;  // of each sample's relative error; where rays are traced, with noise of mean zero
  int raysOfSample_ = 0;
};

}  // namespace

void validate(const SurfaceErrorOptions& options) {
  constexpr std::size_t kLeast = SurfaceErrorOptions::kLeastSamples, kMost = SurfaceErrorOptions::kMostSamples;
  if (options.samples < kLeast || options.samples > kMost) {
    throw usageError("the number of surface samples, " + std::to_string(options.samples) + ", is out of range",
                     "use " + std::to_string(kLeast) + " to " + std::to_string(kMost));
  }
}

SurfaceError measureSurfaceError(TracedPoints& traced, const TransferSet& baked, const BakeOptions& bake,
                                 const SurfaceErrorOptions& options, const Parallel& parallel, Progress& progress) {
  validate(bake);
  validate(options);
  if (bake.kind != TransferKind::unshadowed && bake.rays == 0) {
    throw usageError("the surface error needs the number of rays that the bake took", "set BakeOptions::rays");
  }
  const LightingPoints& points = traced.points();
  const bool hasColor = std::any_of(points.pointAlbedo.begin(), points.pointAlbedo.end(), isColored);
  if (baked.size() != points.size() || baked.order != bake.order || baked.channels != (hasColor ? 3 : 1)) {
    throw usageError("the transfer does not belong to these points and options", "give what bakePoints() returned");
  }
  const std::size_t faces = options.faces == 0 ? points.faces.size() : std::min(options.faces, points.faces.size());
  SurfaceMeter meter(traced, baked, bake, parallel, progress);
  return meter.run(faces, (options.samples + 1) / 2 * 2, options.rays);
}

SurfaceError measureSurfaceError(const LightingPoints& points, const TransferSet& baked, const BakeOptions& bake,
                                 const SurfaceErrorOptions& options, const Parallel& parallel, Progress& progress) {
  TracedPoints traced(points, parallel, progress);
  traced.keepForMore(true);
  return measureSurfaceError(traced, baked, bake, options, parallel, progress);
}

}  // namespace shbake
