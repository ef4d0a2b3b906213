// The transfer of points on the surface that are no vertices, traced by a set of rays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/direct_transfer.h"
#include "bake/point_tracer.h"
#include "bake/ray_scene.h"
#include "bake/surface_places.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// Traces the transfer of albedo 1 from lighting points, as a bake does; one for each worker thread.
class SurfaceTracer {
 public:
  /// `senders` has what each point of a face sends to others; null: nothing is reflected. All references must outlive
  /// the object.
  SurfaceTracer(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions, std::uint64_t seed,
                bool twoSided, const TransferSet* senders);

  /// Writes the transfer of point `p`: one row of order^2 coefficients a channel.
  void trace(std::uint32_t p, std::span<double> out);

 private:
  const LightingPoints& points_;
  const DirectionSet& directions_;
  const TransferSet* senders_;
  PointTracer tracer_;
  DirectTransfer direct_;
  std::vector<std::uint16_t> sky_;
  std::vector<float> directTransfer_;
  std::vector<Hit> hits_;
};

/// An estimate of what is baked for the corners of faces, and one of the true transfer of a place with albedo 1.
struct PlaceEstimate {
  const TransferSet& baked;
  std::span<const double> truth;  ///< baked.stride() values
};

/// (t_a - t*_a) . (t_b - t*_b) / |t_unshadowed|^2 at the place with these `weights` of the points `corners`, where t is
/// interpolated and t* the truth times the place's albedo. Independent noise of the two estimates cancels in the mean,
/// so that the square of the error remains; a single value may be negative. Not finite where the place is black.
double relativeSquare(const Triangle& corners, const std::array<double, 3>& weights, const Rgb& albedo,
                      const PlaceEstimate& a, const PlaceEstimate& b);

}  // namespace shbake
