// All contacts of a mesh, found once before it is traced, and the positions that are far from all faces but their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/contact.h"
#include "base/parallel.h"
#include "base/progress.h"

struct RTCSceneTy;  // what Embree's RTCScene points to

namespace shbake {

/// The contacts of each position; most have none.
class Contacts {
 public:
  Contacts() = default;
  /// Finds the faces that each position lies on without being their corner (contact.h), by point queries of the
  /// committed Embree scene of the faces, whose primitives are numbered like them. Meshes whose faces meet in shared
  /// corners alone have none. Cancelled by `progress`.
  Contacts(const LightingPoints& points, RTCSceneTy* scene, const Parallel& parallel, Progress& progress);

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

  double distance_ = 0;
  std::vector<std::uint32_t> positions_;  // ascending, one entry a contact
  std::vector<Contact> contacts_;
  std::vector<std::uint8_t> clear_;  // one flag a position
};

}  // namespace shbake
