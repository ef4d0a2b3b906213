// Light that flat blockers take away, in closed form and by quadrature: what baked transfer is held against.
#pragma once

#include <vector>

#include "base/vec3.h"

namespace shbake::testing {

/// The share of a point's cosine-weighted hemisphere that a polygon hides: Lambert's sum over its edges ("Photometria",
/// 1760). The point is at the origin with unit normal `n`; the polygon lies above its tangent plane.
double formFactor(const Vec3d& n, const std::vector<Vec3d>& polygon);

/// The transfer of albedo 1, order^2 values, that comes through the parallelogram o, o+u, o+u+v, o+v, seen from a point
/// at the origin with unit normal `n`: Gauss-Legendre in 24 x 24 nodes of each of cells x cells parts. The sky that a
/// wall takes away, or an opening lets in. The point lies off its plane, and the parallelogram above the tangent plane.
std::vector<double> transferThrough(int order, const Vec3d& n, const Vec3d& o, const Vec3d& u, const Vec3d& v,
                                    int cells);
/// The same for the triangle a, b, c (its nodes are those of a square drawn together in a).
std::vector<double> transferThroughTriangle(int order, const Vec3d& n, const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                            int cells);

/// The transfer of albedo 1 of a point with normal +z that sees the azimuths from `from` to `to` only.
std::vector<double> transferOfSector(int order, double from, double to);

/// The closed form of an open point, order^2 values.
std::vector<double> openTransfer(int order, const Vec3d& n, double albedo = 1);

/// Adds factor * b to a.
void add(std::vector<double>& a, const std::vector<double>& b, double factor = 1);

}  // namespace shbake::testing
