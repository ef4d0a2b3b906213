// One reflection of light: what each lighting point receives from the faces that it sees.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bake/point_tracer.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace shbake {

/// Traces once and remembers the hits, 8 bytes each, so that every reflection is a sparse product. Past its memory
/// budget it forgets: those points are traced again for each product, with the same rays and so the same result.
class Reflections {
 public:
  /// Points handled together by one worker.
  static constexpr std::size_t kBlock = 64;

  /// `memoryBudget` in bytes bounds the stored hits. All references must outlive the object, but `scene`
  /// is of no use after trace() when no points were forgotten.
  Reflections(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions, std::uint64_t seed,
              bool twoSided, std::size_t memoryBudget, const Parallel& parallel);

  /// Called with a point, its sky masks (one a group of the direction set), its reflecting hits and the worker's
  /// number.
  using Visit = std::function<void(std::uint32_t point, std::span<const std::uint16_t> sky, std::span<const Hit> hits,
                                   int worker)>;
  /// Traces every point, hands it to `visit` and stores its hits. `progress` advances by rays.
  void trace(const Visit& visit, Progress& progress);

  /// Forgets hits until no more than `memoryBudget` bytes of them are stored.
  void forget(std::size_t memoryBudget);

  /// out[p] = 1/N sum over the hits of p of `in`, interpolated on the face hit: the light that one reflection brings to
  /// p before p's own albedo. Arrays hold `columns` values a point (a multiple of 4).
  void gather(const float* in, float* out, std::size_t columns, Progress& progress);

  /// out[p] = sum over successive hits of p of the squared difference of `in` between them: how uneven the reflected
  /// light is that p sees. Successive hits are mostly neighbours on the sphere. Arrays as for gather(), `out` one value
  /// a point.
  void roughness(const float* in, float* out, std::size_t columns, Progress& progress);

  /// Bytes of hits that are stored, and the points that are traced again for each product.
  std::size_t storedBytes() const { return storedBytes_; }
  /// Bytes of all hits, stored or not.
  std::size_t hitBytes() const { return storedBytes_ + forgottenBytes_; }
  std::size_t forgottenPoints() const { return forgottenPoints_; }

 private:
  struct Block {
    std::vector<Hit> hits;
    std::vector<std::uint32_t> ends;  // end of each point's hits; empty: forgotten

    std::size_t bytes() const { return hits.size() * sizeof(Hit) + ends.size() * sizeof(std::uint32_t); }
  };

  void traceBlock(std::size_t begin, std::size_t end, int worker, Block& block, const Visit* visit);
  template <class Body>
  void forHits(Progress& progress, const Body& body);
  void gatherPoint(std::span<const Hit> hits, const float* in, float* out, std::size_t columns) const;

  const LightingPoints& points_;
  const DirectionSet& directions_;
  const Parallel& parallel_;
  std::size_t memoryBudget_;
  std::vector<PointTracer> tracers_;               // one a worker
  std::vector<std::vector<std::uint16_t>> skies_;  // scratch, one a worker
  std::vector<Block> traced_;                      // scratch, one a worker: what is kept is copied from it in one piece
  std::vector<Block> blocks_;
  std::atomic<std::size_t> storedBytes_{0}, forgottenBytes_{0}, forgottenPoints_{0};
};

}  // namespace shbake
