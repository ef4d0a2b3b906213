#include "bake/surface_fit_samples.h"

#include <array>
#include <cmath>

#include "bake/direction_set.h"
#include "bake/flush_denormals.h"
#include "bake/ray_scene.h"
#include "bake/surface_tracer.h"
#include "sh/irradiance.h"

namespace shbake {

PlaceTracer::PlaceTracer(TracedPoints& traced, const TransferSet& baked, const TransferSet* senders,
                         const BakeOptions& options, const Parallel& parallel, Progress& progress)
    : traced_(traced),
      points_(withPlaces(traced.points(), {})),
      ownPoints_(points_.size()),
      ownPositions_(points_.positions.size()),
      order_(baked.order),
      channels_(baked.channels),
      senders_(senders),
      options_(options),
      parallel_(parallel),
      progress_(progress) {}

void PlaceTracer::forget() {
  points_.positions.resize(ownPositions_);
  points_.positionFaces.starts.resize(ownPositions_ + 1);
  points_.pointPosition.resize(ownPoints_);
  points_.pointNormal.resize(ownPoints_);
  points_.pointAlbedo.resize(ownPoints_);
}

PlaceTransfers PlaceTracer::trace(std::span<const SurfacePlace> places, int rays,
                                  std::span<const std::uint64_t> seeds) {
  addPlaces(points_, places);
  const Contacts contacts(points_, traced_.tree(), positionsFrom(points_, ownPoints_), parallel_, progress_);
  const auto maxDistance = static_cast<float>(options_.maxDistance * points_.frame.scale);
  const RayScene scene(points_, traced_.tree(), contacts, maxDistance);
  const DirectionSet directions(rays, order_);
  std::vector<std::vector<SurfaceTracer>> tracers(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (int w = 0; w < parallel_.threads(); ++w) {
      tracers[i].emplace_back(points_, scene, directions, seeds[i], options_.twoSided, senders_);
    }
  }
  const auto count = static_cast<std::size_t>(order_ * order_), stride = static_cast<std::size_t>(channels_) * count;
  const double norm = sh::unshadowedNorm(order_);
  PlaceTransfers traced;
  traced.sets.assign(seeds.size(), std::vector<float>(places.size() * stride));
  traced.scale.resize(places.size());
  const double raysAPlace = static_cast<double>(seeds.size()) * directions.size();
  progress_.begin("tracing samples", static_cast<double>(places.size()) * raysAPlace, "rays");
  parallel_.forBlocks(places.size(), 16, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    std::vector<double> received(stride);
    for (std::size_t s = begin; s < end; ++s) {
      const auto p = static_cast<std::uint32_t>(ownPoints_ + s);
      const Rgb& rho = points_.pointAlbedo[p];
      const std::array<double, 3> albedo{double{rho.x}, double{rho.y}, double{rho.z}};
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        tracers[i][static_cast<std::size_t>(worker)].trace(p, received);
        for (std::size_t k = 0; k < stride; ++k) {
          traced.sets[i][s * stride + k] = static_cast<float>(albedo[k / count] * received[k]);
        }
      }
      double square = 0;
      for (int c = 0; c < channels_; ++c) square += std::pow(albedo[static_cast<std::size_t>(c)] * norm, 2);
      // A place may touch the black corner of its face.
      traced.scale[s] = square > 0 ? 1 / square : 0;
    }
    progress_.advance(static_cast<double>(end - begin) * raysAPlace);
  });
  progress_.end();
  rays_ += static_cast<double>(places.size()) * raysAPlace;
  forget();
  return traced;
}

}  // namespace shbake
