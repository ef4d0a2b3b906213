// Places on the surface and the transfer that rays find there, with which vertex values are fitted and judged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/bake_options.h"
#include "bake/surface_places.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// The transfer at places, their albedo included.
struct PlaceTransfers {
  std::vector<std::vector<float>> sets;  ///< each an independent estimate: a row of the transfer's stride a place
  std::vector<double> scale;             ///< 1 / |unshadowed transfer|^2 of each place, 0 where it is black
};

/// Traces places of a surface whose points are baked.
class PlaceTracer {
 public:
  /// `senders` is what faces reflect to the places; null: nothing. `options.rays` is not looked at. References must
  /// outlive the object.
  PlaceTracer(TracedPoints& traced, const TransferSet& baked, const TransferSet* senders, const BakeOptions& options,
              const Parallel& parallel, Progress& progress);

  /// Traces each place by as many sets of `rays` directions as there are seeds. No place may be on a black face.
  /// Throws as bakePoints(). Progress counts rays.
  PlaceTransfers trace(std::span<const SurfacePlace> places, int rays, std::span<const std::uint64_t> seeds);

  /// The rays traced so far.
  double rays() const { return rays_; }

 private:
  TracedPoints& traced_;
  int order_, channels_;
  const TransferSet* senders_;
  const BakeOptions& options_;
  const Parallel& parallel_;
  Progress& progress_;
  double rays_ = 0;
};

}  // namespace shbake
