// What the transfer of the measured points really is, twice: two estimates from many rays, independent of each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bake/ray_scene.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/deadline.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// Two independent estimates of the same transfer. An error against them is freed from their own noise: where t is
/// judged, the mean of (t - first) . (t - second) has the expectation |t - t*|^2.
struct Reference {
  int order = 8;                     ///< bands: what is judged may have fewer
  int rays = 0;                      ///< rays a point of `first`; `second` has 15/16 of them
  std::size_t points = 0;            ///< first points of the sample that are known
  std::vector<float> first, second;  ///< points x order^2, albedo 1

  std::size_t stride() const { return static_cast<std::size_t>(order) * static_cast<std::size_t>(order); }
};

struct ReferenceOptions {
  int order = 8;
  int rays = 32768;
  std::string cache;  ///< a file that keeps what was computed; empty: none does
};

/// What became of the cache, for reports.
enum class CacheUse { none, fresh, resumed, complete, remade };

struct MadeReference {
  Reference reference;
  CacheUse cache = CacheUse::none;
};

/// Traces the points of `sample` in order until all are known or the deadline is over; at least one block of them. With
/// a cache, begins where the last call stopped, and writes what is known every few seconds, at the end and when it is
/// cancelled. A damaged cache, or one of another mesh, sample, version or other options, is remade.
MadeReference makeReference(const LightingPoints& points, const RayScene& scene, std::span<const std::uint32_t> sample,
                            const ReferenceOptions& options, const Deadline& deadline, const Parallel& parallel,
                            Progress& progress);

}  // namespace shbake::chart
