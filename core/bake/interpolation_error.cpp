#include "bake/interpolation_error.h"

#include <algorithm>
#include <array>

#include "bake/baker.h"
#include "bake/surface_rays.h"
#include "bake/surface_tracer.h"
#include "base/error.h"
#include "base/hash.h"

namespace shbake {
namespace {

/// The independent streams of random numbers.
enum Stream : std::uint64_t { kFirstBake, kSecondBake, kFirstRays, kSecondRays };
constexpr std::array kBakes{kFirstBake, kSecondBake};

/// The corners of the places' faces in ascending order, each once.
std::vector<std::uint32_t> cornersOf(const LightingPoints& points, std::span<const SurfacePlace> places) {
  std::vector<std::uint32_t> corners;
  for (const SurfacePlace& place : places) {
    const Triangle& t = points.facePoints[place.face];
    corners.insert(corners.end(), t.begin(), t.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Two independent estimates of the transfer of corners.
class BakedCorners {
 public:
  explicit BakedCorners(std::vector<std::uint32_t> corners) : corners_(std::move(corners)) {}

  const std::vector<std::uint32_t>& points() const { return corners_; }
  const TransferSet& set(std::size_t i) const { return sets_[i]; }

  /// With reflections: sets have a row for each lighting point.
  void bake(TracedPoints& traced, const BakeOptions& options, const Parallel& parallel, Progress& progress) {
    std::vector<std::uint8_t> wanted(traced.points().size(), 0);
    for (const std::uint32_t p : corners_) wanted[p] = 1;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      BakeOptions once = options;
      once.seed = hashBits(options.seed, kBakes[i]);
      sets_[i] = bakePoints(traced, wanted, once, parallel, progress).transfer;
    }
    hasAllPoints_ = true;
  }

  /// Without reflections, and without looking at other points: a row for each corner.
  void trace(const SurfaceRays& rays, bool hasColor, const BakeOptions& options) {
    std::array<RaySet, 2> seeds{};
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      seeds[i] = {hashBits(options.seed, kBakes[i]), nullptr};
      sets_[i].order = options.order;
      sets_[i].channels = hasColor ? 3 : 1;
      sets_[i].coefficients.resize(corners_.size() * sets_[i].stride());
    }
    const auto count = static_cast<std::size_t>(sets_[0].coefficientsPerChannel()), stride = sets_[0].stride();
    rays.traceCorners("tracing", seeds, 1, [&](std::size_t row, const Rgb& rho, auto transfers) {
      const std::array<float, 3> albedo{rho.x, rho.y, rho.z};
      for (std::size_t i = 0; i < sets_.size(); ++i) {
        for (std::size_t k = 0; k < stride; ++k) {
          sets_[i].coefficients[row * stride + k] = albedo[k / count] * static_cast<float>(transfers[i][k % count]);
        }
      }
    });
    hasAllPoints_ = false;
  }

  /// The rows of a face's corners.
  Triangle rowsOf(const Triangle& points) const {
    if (hasAllPoints_) return points;
    const auto row = [&](std::uint32_t p) {
      return static_cast<std::uint32_t>(std::lower_bound(corners_.begin(), corners_.end(), p) - corners_.begin());
    };
    return {row(points[0]), row(points[1]), row(points[2])};
  }

 private:
  std::vector<std::uint32_t> corners_;
  std::array<TransferSet, 2> sets_;
  bool hasAllPoints_ = false;
};

}  // namespace

std::vector<double> interpolationSquares(TracedPoints& traced, std::span<const SurfacePlace> places,
                                         const BakeOptions& options, const Parallel& parallel, Progress& progress) {
  if (options.kind == TransferKind::unshadowed || options.rays == 0) {
    throw usageError("the error of interpolation needs rays", "set BakeOptions::rays and a kind that is traced");
  }
  const LightingPoints& points = traced.points();
  const bool reflects = options.kind == TransferKind::interreflected && options.bounces != 0;
  BakedCorners baked(cornersOf(points, places));
  if (reflects) baked.bake(traced, options, parallel, progress);
  const SurfaceRays rays(traced, places, reflects ? std::span<const std::uint32_t>() : baked.points(),
                         DirectionSet(options.rays, options.order), options, parallel, progress);
  if (!reflects) {
    const bool hasColor =
        std::ranges::any_of(baked.points(), [&](std::uint32_t p) { return isColored(points.pointAlbedo[p]); });
    baked.trace(rays, hasColor, options);
  }
  const auto set = [&](Stream stream, std::size_t i) {
    return RaySet{hashBits(options.seed, stream), reflects ? &baked.set(i) : nullptr};
  };
  std::vector<double> squares(places.size());
  rays.tracePlaces("probing the surface", std::array{set(kFirstRays, 0), set(kSecondRays, 1)}, baked.set(0).channels,
                   [&](std::size_t s, const Rgb& albedo, auto transfers) {
                     const Triangle rows = baked.rowsOf(points.facePoints[places[s].face]);
                     squares[s] = relativeSquare(rows, places[s].weights, albedo, {baked.set(0), transfers[0]},
                                                 {baked.set(1), transfers[1]});
                   });
  return squares;
}

}  // namespace shbake
