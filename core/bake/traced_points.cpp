// Lighting points and what their rays are traced in.
#include "bake/traced_points.h"

#include "bake/surface_places.h"

namespace shbake {

const FaceTree& TracedPoints::tree() {
  if (!tree_) tree_.emplace(points_, parallel_, progress_);
  return *tree_;
}

const Contacts& TracedPoints::contacts() {
  if (!contacts_) contacts_.emplace(points_, tree(), parallel_, progress_);
  return *contacts_;
}

void TracedPoints::free() {
  contacts_.reset();
  tree_.reset();
  copy_.reset();
}

LightingPoints& TracedPoints::pointsForPlaces() {
  if (changeable_ != nullptr) return *changeable_;
  if (!copy_) copy_.emplace(withPlaces(points_, {}));
  return *copy_;
}

}  // namespace shbake
