#include "bake/surface_fit_samples.h"

#include <array>
#include <cmath>

#include "bake/direction_set.h"
#include "bake/surface_rays.h"
#include "sh/irradiance.h"

namespace shbake {

PlaceTracer::PlaceTracer(TracedPoints& traced, const TransferSet& baked, const TransferSet* senders,
                         const BakeOptions& options, const Parallel& parallel, Progress& progress)
    : traced_(traced),
      order_(baked.order),
      channels_(baked.channels),
      senders_(senders),
      options_(options),
      parallel_(parallel),
      progress_(progress) {}

PlaceTransfers PlaceTracer::trace(std::span<const SurfacePlace> places, int rays,
                                  std::span<const std::uint64_t> seeds) {
  const SurfaceRays from(traced_, places, {}, DirectionSet(rays, order_), options_, parallel_, progress_);
  std::vector<RaySet> sets;
  for (const std::uint64_t seed : seeds) sets.push_back({seed, senders_});
  const auto count = static_cast<std::size_t>(order_ * order_), stride = static_cast<std::size_t>(channels_) * count;
  const double norm = sh::unshadowedNorm(order_);
  PlaceTransfers traced;
  traced.sets.assign(seeds.size(), std::vector<float>(places.size() * stride));
  traced.scale.resize(places.size());
  from.tracePlaces("tracing samples", sets, channels_, [&](std::size_t s, const Rgb& rho, auto transfers) {
    const std::array<double, 3> albedo{double{rho.x}, double{rho.y}, double{rho.z}};
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      for (std::size_t k = 0; k < stride; ++k) {
        traced.sets[i][s * stride + k] = static_cast<float>(albedo[k / count] * transfers[i][k]);
      }
    }
    double square = 0;
    for (int c = 0; c < channels_; ++c) square += std::pow(albedo[static_cast<std::size_t>(c)] * norm, 2);
    // A place may touch the black corner of its face.
    traced.scale[s] = square > 0 ? 1 / square : 0;
  });
  rays_ += static_cast<double>(places.size()) * static_cast<double>(seeds.size()) * from.setSize();
  return traced;
}

}  // namespace shbake
