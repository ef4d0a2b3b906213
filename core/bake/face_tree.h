// The faces of a scene in Embree: what depends on them alone, whatever rays are traced among them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

struct RTCSceneTy;  // what Embree's RTCScene points to

namespace shbake {

/// The bounding volume hierarchy of the faces, the dearest part of a short bake: one serves all that trace the same
/// faces, from whatever places. Safe to use by many threads at once.
class FaceTree {
 public:
  /// Builds it on the threads of `parallel`. Embree traces the arrays `faces` and `positions` of `points` in place, the
  /// latter where it has room for one more: they must stay where they are for the tree's life. They do where `points`
  /// are moved; copies have arrays of their own, and places added to `points` themselves may move theirs.
  /// Throws a work error where Embree fails, std::bad_alloc where memory is short, cancelled by `progress`.
  FaceTree(const LightingPoints& points, const Parallel& parallel, Progress& progress);
  ~FaceTree();

  /// The committed scene: one geometry, whose primitives are numbered like the faces. Filters are taken from the
  /// context of a call.
  RTCSceneTy* scene() const;
  /// Packets of 16 rays are native; streams of single rays are faster elsewhere.
  bool hasPackets() const;

  /// contactDistance() of the points.
  double contact() const;
  /// The longest edge of a face, in work units.
  float longestEdge() const;
  /// faceTwins() of the points.
  const std::vector<std::uint32_t>& twins() const;

  /// What it holds in memory, in bytes.
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shbake
