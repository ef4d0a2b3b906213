// The contacts of positions, found once before rays start there, and which positions are far from all faces but their
// own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/contact.h"
#include "bake/face_tree.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace shbake {

/// The contacts of each position; most have none.
class Contacts {
 public:
  Contacts() = default;
  /// Finds the faces that each position lies on without being their corner (contact.h), by point queries of `tree`,
  /// which holds the faces of `points`. Meshes whose faces meet in shared corners alone have none. Cancelled by
  /// `progress`.
  Contacts(const LightingPoints& points, const FaceTree& tree, const Parallel& parallel, Progress& progress);

  /// The same for some positions alone: of others, nothing is known. `points` may have places beyond those that the
  /// tree was built of (addPlaces()).
  Contacts(const LightingPoints& points, const FaceTree& tree, std::span<const std::uint32_t> positions,
           const Parallel& parallel, Progress& progress);

  /// The contacts of a position; those with one part of a surface follow each other.
  std::span<const Contact> of(std::uint32_t position) const;
  /// How many (position, face) pairs there are.
  std::size_t size() const { return contacts_.size(); }
  /// contactDistance() of the mesh.
  double distance() const { return distance_; }

  /// Whether all faces but those that share the position are farther from it than clearance().
  bool isClear(std::uint32_t position) const { return clear_[position] != 0; }
  /// 1024 contact distances, in work units: far above the rounding of hit distances, far below the edges of most
  /// meshes.
  double clearance() const { return kClearance * distance_; }

 private:
  static constexpr double kClearance = 1024;

  template <class PositionAt>
  void search(const LightingPoints& points, const FaceTree& tree, std::size_t count, const PositionAt& positionAt,
              const Parallel& parallel, Progress& progress);

  double distance_ = 0;
  std::vector<std::uint32_t> positions_;  // ascending, one entry a contact
  std::vector<Contact> contacts_;
  std::vector<std::uint8_t> clear_;  // one flag a position
};

}  // namespace shbake
