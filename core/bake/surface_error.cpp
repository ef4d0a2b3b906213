// The error of interpolated transfer, measured at random points of the surface: maths.md (26) to (28).
#include "bake/surface_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bake/direction_set.h"
#include "bake/sampled_mean.h"
#include "bake/senders.h"
#include "bake/surface_places.h"
#include "bake/surface_rays.h"
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
      : traced_(traced), baked_(baked), bake_(bake), parallel_(parallel), progress_(progress) {}

  SurfaceError run(std::size_t faces, std::size_t samples, const TruthRays& rays) {
    const LightingPoints& points = traced_.points();
    places_ = drawPlaces(points, areaWeights(points, faces), samples, hashBits(bake_.seed, kPlaces), progress_);
    if (places_.empty()) return {};
    squares_.resize(samples);
    if (bake_.kind == TransferKind::unshadowed) {
      measureUnshadowed();
    } else {
      measureTraced(rays);
    }
    SurfaceError error = surfaceErrorOf(
        squares_, [&](std::size_t s) { return points.frame.toFile(Vec3d(pointAt(points, places_[s]).position)); });
    error.rays = raysOfSample_;
    return error;
  }

 private:
  void take(std::size_t s, const Rgb& albedo, std::span<const double> first, std::span<const double> second) {
    squares_[s] = relativeSquare(traced_.points().facePoints[places_[s].face], places_[s].weights, albedo,
                                 {baked_, first}, {baked_, second});
  }

  void measureUnshadowed() {
    progress_.begin("measuring the surface", static_cast<double>(places_.size()), "samples");
    parallel_.forBlocks(places_.size(), 64, [&](std::size_t begin, std::size_t end, int) {
      const auto count = static_cast<std::size_t>(baked_.coefficientsPerChannel());
      std::vector<double> exact(count), all(baked_.stride());
      for (std::size_t s = begin; s < end; ++s) {
        const PlacedPoint place = pointAt(traced_.points(), places_[s]);
        sh::unshadowedTransfer(baked_.order, normalized(Vec3d(place.normal)), 1, exact);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = exact[i % count];
        take(s, place.albedo, all, all);
      }
      progress_.advance(static_cast<double>(end - begin));
    });
    progress_.end();
  }

  void measureTraced(const TruthRays& rays) {
    const Senders senders(traced_, baked_, bake_, parallel_, progress_);
    const int most = std::max(kMostTruthRays, bake_.rays);
    const int each = std::max(rays.least, bake_.rays > most / rays.perRay ? most : rays.perRay * bake_.rays);
    const SurfaceRays truth(traced_, places_, {}, DirectionSet(each, baked_.order), bake_, parallel_, progress_);
    raysOfSample_ = 2 * truth.setSize();
    const auto set = [&](Stream stream) { return RaySet{hashBits(bake_.seed, stream), senders.transfer()}; };
    truth.tracePlaces("measuring the surface", std::array{set(kFirstSet), set(kSecondSet)}, baked_.channels,
                      [&](std::size_t s, const Rgb& albedo, auto sets) { take(s, albedo, sets[0], sets[1]); });
  }

  TracedPoints& traced_;
  const TransferSet& baked_;
  const BakeOptions& bake_;
  const Parallel& parallel_;
  Progress& progress_;
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
