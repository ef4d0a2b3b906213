// What a bake can be asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "transfer/transfer_set.h"

namespace shbake {

struct BakeOptions {
  TransferKind kind = TransferKind::interreflected;
  /// SH bands, 1..32: order n gives n^2 coefficients a channel.
  int order = 4;
  /// Directions a point, 1..1048576, rounded up to a multiple of 16; 0: chosen from `tolerance`.
  int rays = 0;
  /// Stated RMS error to reach, relative to the unshadowed transfer, 0.0001..1; used where `rays` is 0, and by
  /// `bounces` = kBouncesAuto as the point where summing stops.
  double tolerance = 0.01;
  /// Reflections to sum, 0..10000, or kBouncesAuto: as many as the tolerance needs.
  int bounces = kBouncesAuto;
  /// Faces reflect from both sides instead of the front only (they block from both sides in any case).
  bool twoSided = false;
  /// Faces farther away than this neither block nor reflect, in file units; the sky is seen instead.
  double maxDistance = std::numeric_limits<double>::infinity();
  /// Chooses the turn of each point's directions: another seed, another sample of the same expectation.
  std::uint64_t seed = 1;
  /// Bytes that the bake may use for stored hits and solver vectors (reflection_memory.h); 0: half of what is free.
  /// Never changes the result.
  std::size_t memory = 0;

  static constexpr int kBouncesAuto = -1;
};

/// Throws a usage error that names the first option out of its range.
void validate(const BakeOptions& options);

}  // namespace shbake
