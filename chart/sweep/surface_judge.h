// How far what is interpolated between vertices is from the truth, at places of the surface that are the same for all
// that is judged: however a mesh is refined, its surface stays where it is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/deadline.h"
#include "chart/sweep/place_finder.h"
#include "chart/sweep/reference.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake::chart {

struct SurfaceJudgeOptions {
  int order = 4;              ///< bands of what is judged, 1..8
  std::size_t places = 2048;  ///< that judge at most, an even number
  int rays = 4096;            ///< of each place's first estimate; the second has 15/16 of them
  std::string cache;          ///< a file that keeps the truth; empty: none does
};

/// Draws places spread evenly over the surface that have no part in any bake, and traces what their transfer really is.
class SurfaceJudge {
 public:
  /// Traces as many places as the time up to the deadline allows (makeReference()), with a cache none that are known.
  SurfaceJudge(const LightingPoints& points, const SurfaceJudgeOptions& options, const Deadline& deadline,
               const Parallel& parallel, Progress& progress);

  /// Places that judge; 0 where no face has an area and reflects light.
  std::size_t places() const { return reference_.points; }
  CacheUse cache() const { return cache_; }

  /// The lighting points of the same surface, however refined, in the judge's own work units.
  PointSurface surfaceOf(const LightingPoints& points) const;
  /// The same of a baked mesh, whose vertices carry the transfer; it has vertexNormals.
  PointSurface surfaceOf(const Mesh& mesh) const;

  /// The error of shadowed transfer that is interpolated between the points of `surface`, of the judge's order: RMS
  /// over the surface, relative to the unshadowed transfer and freed from the truth's own noise (maths.md (26) to
  /// (28)). No samples in the result where there are no places.
  SurfaceError errorOf(const PointSurface& surface, const TransferSet& baked) const;

 private:
  double squareAt(std::size_t i, const SurfacePlace& place, const PointSurface& surface,
                  const TransferSet& baked) const;
  Vec3f toWork(const Vec3d& position, const WorkFrame& from) const;

  LightingPoints points_;              // those of the mesh, and the places behind them
  std::vector<std::uint32_t> sample_;  // points of the places, in the order of the reference
  Reference reference_;
  CacheUse cache_ = CacheUse::none;
};

}  // namespace shbake::chart
