// Which rays from a position run so close along a face at that position that rounding may let them meet it.
//
// The position is a corner of the face, so that the exact distance along every ray is 0. Embree (Moeller, Trumbore,
// "Fast, minimum storage ray/triangle intersection", 1997) computes it as a quotient t = (N.C) / (N.d), of the face's
// normal N, the ray's direction d and an edge C of the face. The numerator is rounding alone, of at most a few ulp of
// the cube of the face's longest edge L; hence a hit farther away than some distance tells that |N.d| is below the
// quotient of both, whichever way the rounding goes.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/lighting_points.h"

namespace shbake {

/// The planes of the faces at one position at a time, as seen from a point's own axes.
class OwnPlanes {
 public:
  /// Takes up a position and orthonormal axes. `near` > 0 is where its rays begin.
  void setPosition(const LightingPoints& points, std::uint32_t position, const Vec3f& axisX, const Vec3f& axisY,
                   const Vec3f& axisZ, float near);

  /// Of the directions in the mask `asked`, those whose rays may meet a face at the position by rounding. 16 components
  /// each of unit vectors in the axes; at least 0 z. The others meet none, as sure as float arithmetic keeps its
  /// bounds.
  std::uint16_t close(const float* x, const float* y, const float* z, std::uint16_t asked) const;

 private:
  struct Plane {
    Vec3f normal;  // in the axes, of twice the face's area
    float bound;   // directions with a smaller product are close
  };
  std::vector<Plane> planes_;
  float top_ = 0;  // directions that rise at least this far are close to none
};

}  // namespace shbake
