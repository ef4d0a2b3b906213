// Rays from places of a surface that had no part in a bake: independent estimates of what each receives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bake/bake_options.h"
#include "bake/contact_search.h"
#include "bake/direction_set.h"
#include "bake/ray_scene.h"
#include "bake/surface_places.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/vec3.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// A set of rays: its noise is independent of that of sets with other seeds.
struct RaySet {
  std::uint64_t seed;
  const TransferSet* senders;  ///< what each point of a face sends to others; null: nothing is reflected
};

/// Traces several sets of rays from each of some places, and from lighting points like them where they are named. While
/// it lives, the places stand behind the points that it was given, of which nobody else must ask anything.
class SurfaceRays {
 public:
  /// Each set has all `directions`. `corners` are numbers of lighting points, each once, which traceCorners() looks
  /// from. Of the options, `twoSided` and `maxDistance` count. References must outlive the object. Throws as FaceTree's
  /// constructor; cancelled by `progress`.
  SurfaceRays(TracedPoints& traced, std::span<const SurfacePlace> places, std::span<const std::uint32_t> corners,
              DirectionSet directions, const BakeOptions& options, const Parallel& parallel, Progress& progress);
  ~SurfaceRays();
  SurfaceRays(const SurfaceRays&) = delete;
  SurfaceRays& operator=(const SurfaceRays&) = delete;

  /// Told the number of a place or corner in its list, its albedo, and for each set the transfer of albedo 1: as many
  /// rows of order^2 coefficients as there are channels. Called from any thread, once for each.
  using Visit = std::function<void(std::size_t i, const Rgb& albedo, std::span<const std::vector<double>> transfers)>;

  /// Progress counts rays under the name `stage`.
  void tracePlaces(const char* stage, std::span<const RaySet> sets, int channels, const Visit& visit) const;
  void traceCorners(const char* stage, std::span<const RaySet> sets, int channels, const Visit& visit) const;

  /// Directions of a set.
  int setSize() const { return directions_.size(); }

 private:
  /// The points with the places behind them; without these again where it ends.
  class Added {
   public:
    Added(LightingPoints& points, std::span<const SurfacePlace> places);
    ~Added();
    Added(const Added&) = delete;
    Added& operator=(const Added&) = delete;

    const LightingPoints& points() const { return points_; }
    /// The numbers of the places.
    std::vector<std::uint32_t> places() const;

   private:
    LightingPoints& points_;
    std::size_t ownPoints_;
    std::vector<Vec3f> ownPositions_;
  };

  void trace(const char* stage, std::span<const std::uint32_t> from, std::span<const RaySet> sets, int channels,
             const Visit& visit) const;

  const FaceTree& tree_;  // built before there are places
  Added added_;
  std::vector<std::uint32_t> corners_, places_;  // numbers of points
  DirectionSet directions_;
  bool twoSided_;
  const Parallel& parallel_;
  Progress& progress_;
  Contacts contacts_;
  RayScene scene_;
};

}  // namespace shbake
