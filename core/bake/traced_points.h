// Lighting points and what their rays are traced in, for all who trace them one after another: glances, pilots, the
// bake, fits and judges.
#pragma once

#include <optional>

#include "bake/contact_search.h"
#include "bake/face_tree.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Builds the tree of the faces and searches the contacts of the positions when somebody first asks for them, and keeps
/// both for the next. They take more memory than all else of a large bake without a solver: whoever has no more use for
/// them frees them, and they are built again where somebody asks after all.
class TracedPoints {
 public:
  /// References must outlive the object, and the arrays of `points` stay where they are (FaceTree).
  TracedPoints(const LightingPoints& points, const Parallel& parallel, Progress& progress)
      : points_(points), parallel_(parallel), progress_(progress) {}

  /// The same for points that may change: places from which rays are traced (SurfaceRays) stand among them meanwhile,
  /// where those that may not change are copied.
  TracedPoints(LightingPoints& points, const Parallel& parallel, Progress& progress)
      : points_(points), changeable_(&points), parallel_(parallel), progress_(progress) {}

  const LightingPoints& points() const { return points_; }

  /// Throws as FaceTree's constructor.
  const FaceTree& tree();
  /// The contacts of all positions; cancelled by the progress.
  const Contacts& contacts();

  /// What a bake shall leave behind: false, the default, frees tree and contacts once they have served; true keeps them
  /// for another pass, as far as its budget of memory holds them beside what it stores (BakeOptions::memory).
  void keepForMore(bool keep) { keeps_ = keep; }
  bool keepsForMore() const { return keeps_; }

  void free();

  /// The points themselves or a copy, which is made when somebody first asks for it: to add places, which are gone
  /// again before somebody else looks at them.
  LightingPoints& pointsForPlaces();

 private:
  const LightingPoints& points_;
  LightingPoints* changeable_ = nullptr;  // points_ itself, or null where it may not change
  const Parallel& parallel_;
  Progress& progress_;
  bool keeps_ = false;
  std::optional<LightingPoints> copy_;
  std::optional<FaceTree> tree_;
  std::optional<Contacts> contacts_;
};

}  // namespace shbake
