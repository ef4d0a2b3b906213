// The convex hull of points.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake {

/// The volume of the convex hull of some points; 0 where they lie in one plane or there are none.
double convexHullVolume(std::span<const Vec3f> points);

}  // namespace shbake
