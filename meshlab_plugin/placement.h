// Where a layer stands: its transform, applied to points and normals in double precision.
#pragma once

#include <array>
#include <string>

#include "shbake.h"

namespace shbake::meshlab {

/// An affine transform from a layer's own axes to those of the world.
class Placement {
 public:
  /// The identity.
  Placement() = default;
  /// From the sixteen numbers of a 4x4 matrix, row by row. Throws an Error naming the layer when they are not finite,
  /// or no affine transform that can be inverted.
  Placement(const std::array<double, 16>& rows, const std::string& layer);

  bool isIdentity() const { return identity_; }
  bool mirrors() const { return determinant_ < 0; }

  Vec3d point(const Vec3d& p) const { return linear_ * p + shift_; }
  /// The way back of point(), to rounding.
  Vec3d pointBack(const Vec3d& p) const;
  /// A normal of unit length; zero stays zero.
  Vec3f normal(const Vec3f& n) const;
  /// The way back of normal().
  Vec3f normalBack(const Vec3f& n) const;

  /// The rotation between the axes of `from` and these, for placements that differ by a rotation, a shift and a scale
  /// only; throws a usage error otherwise.
  sh::Matrix3d turnFrom(const Placement& from) const;

 private:
  bool identity_ = true;
  sh::Matrix3d linear_, cofactors_;  // cofactors_ takes normals where linear_ takes points
  Vec3d shift_;
  double determinant_ = 1;
};

}  // namespace shbake::meshlab
