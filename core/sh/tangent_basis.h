// Irradiance in three directions of the tangent plane and one through the surface: four numbers instead of nine.
#pragma once

#include <array>
#include <span>

#include "sh/local_frame.h"

namespace shbake::sh {

/// Three unit vectors 45 degrees off the normal z, at azimuths 180, -60 and 60 degrees. They are not orthogonal: each
/// pair has dot product 1/4.
inline constexpr std::array<Vec3d, 3> kTangentDirections{
    {{-0.70710678118654752440, 0, 0.70710678118654752440},
     {0.35355339059327376220, -0.61237243569579452455, 0.70710678118654752440},
     {0.35355339059327376220, 0.61237243569579452455, 0.70710678118654752440}}};

struct TangentIrradiance {
  std::array<double, 3> front{};  ///< irradiance of surfaces facing kTangentDirections
  double through = 0;             ///< irradiance of the back side, -z, for translucency
};

/// Irradiance from light with order^2 coefficients in world axes at a point with this frame. Each direction sees the
/// cone of cosine `coneCosine` about itself: 0 for the whole hemisphere, sqrt(1/2) for a cone of 45 degrees, the widest
/// that never reaches below the surface; a point under ambient occlusion passes the greater of that and
/// coneFromCosineVisibility().
TangentIrradiance tangentIrradiance(int order, std::span<const double> light, const LocalFrame& frame,
                                    double coneCosine = 0);

/// Irradiance for a normal in tangent axes (unit length): the affine function of the normal that has the four values.
/// Exact for light of order 2 and whole hemispheres.
double interpolate(const TangentIrradiance& values, const Vec3d& normal);

}  // namespace shbake::sh
