// Pairs of boxes that meet.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "base/vec3.h"

namespace shbake {

/// An axis-aligned box: its least and its greatest corner.
struct Box {
  Vec3d low, high;
};

/// Calls visit(i, j) once for each box i of `first` and j of `second` that have a point in common, in any order. Takes
/// O(n log^3 n + pairs) steps for n boxes. `visit` may throw to stop it.
void forEachMeeting(std::span<const Box> first, std::span<const Box> second,
                    const std::function<void(std::size_t, std::size_t)>& visit);

}  // namespace shbake
