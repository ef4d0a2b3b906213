// How the memory of a bake is shared out between the hits that it remembers and the vectors of its solver.
#pragma once

#include <cstddef>

namespace shbake {

/// Shares out the memory for reflections. Hits that find no room are traced again for every reflection of every batch
/// of columns; fewer columns a batch leave room for more hits, and make more batches. Never changes a result.
class ReflectionMemory {
 public:
  /// `asked` in bytes, for hits and solver together; 0: half of `available`, of which the solver then takes no more
  /// than the hits do or kFreely. `columns` are all of a channel, a multiple of kColumns.
  ReflectionMemory(std::size_t asked, std::size_t available, std::size_t points, std::size_t columns);

  /// Columns move in whole vectors of four floats.
  static constexpr std::size_t kColumns = 4;
  /// Solver vectors below this are not worth a second look at the hits, nor are they noticed beside the BVH of a mesh
  /// that they are that large for.
  static constexpr std::size_t kFreely = std::size_t(256) << 20;

  /// Bytes of hits that may be stored while they are traced: what the narrowest solver leaves.
  std::size_t hitsWhileTracing() const;

  struct Share {
    std::size_t columns;  ///< solved at a time: a multiple of kColumns
    std::size_t hits;     ///< bytes of hits to keep, at most
  };
  /// The share with which fewest rays are traced again, of several the one with fewest batches; `hitBytes` is what all
  /// hits take, stored or not. Where the budget is below the narrowest solver, which needs 96 bytes a point, the solver
  /// exceeds it and no hit is kept.
  Share shareOut(std::size_t hitBytes) const;

  /// Whether the budget holds `bytes` of something else beside the hits that are stored and the solver.
  bool hasRoomBeside(const Share& share, std::size_t storedBytes, std::size_t bytes) const {
    return storedBytes + solverBytes(share.columns) + bytes <= budget_;
  }

  /// The smallest budget with which all hits are stored.
  std::size_t sufficient(std::size_t hitBytes) const { return hitBytes + solverBytes(kColumns); }

 private:
  std::size_t solverBytes(std::size_t columns) const;
  std::size_t roomBeside(std::size_t columns) const;

  std::size_t budget_, points_, columns_;
  bool isDefault_;
};

}  // namespace shbake
