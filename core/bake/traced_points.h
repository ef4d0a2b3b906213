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

 private:
  const LightingPoints& points_;
  const Parallel& parallel_;
  Progress& progress_;
  bool keeps_ = false;
  std::optional<FaceTree> tree_;
  std::optional<Contacts> contacts_;
};

}  // namespace shbake
