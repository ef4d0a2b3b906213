// Affine transforms of points and normals.
#include "meshlab_plugin/placement.h"

#include <algorithm>
#include <cmath>

namespace shbake::meshlab {
namespace {

/// The cofactors of a matrix: its determinant times the transpose of its inverse.
sh::Matrix3d cofactorsOf(const sh::Matrix3d& a) {
  sh::Matrix3d c;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  }
  return c;
}

}  // namespace

Placement::Placement(const std::array<double, 16>& rows, const std::string& layer) {
  const auto fail = [&layer](const char* cause) {
    throw Error({.file = layer, .place = "transform", .cause = cause, .remedy = "reset or freeze the layer's matrix"});
  };
  if (!std::all_of(rows.begin(), rows.end(), [](double v) { return std::isfinite(v); })) fail("is not finite");
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) linear_(i, j) = rows[4 * i + j];
  }
  shift_ = {rows[3], rows[7], rows[11]};
  if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] != 1) fail("is not affine");
  cofactors_ = cofactorsOf(linear_);
  determinant_ = linear_(0, 0) * cofactors_(0, 0) + linear_(0, 1) * cofactors_(0, 1) + linear_(0, 2) * cofactors_(0, 2);
  if (determinant_ == 0) fail("flattens the layer");
  identity_ = linear_ == sh::Matrix3d{} && shift_ == Vec3d{};
}

Vec3d Placement::pointBack(const Vec3d& p) const {
  return identity_ ? p : sh::transposed(cofactors_) * (p - shift_) * (1 / determinant_);
}

Vec3f Placement::normal(const Vec3f& n) const {
  if (identity_) return n;
  // The cofactors of a mirror turn normals to the other side.
  const double side = determinant_ < 0 ? -1 : 1;
  return Vec3f(normalized(cofactors_ * Vec3d(n)) * side);
}

Vec3f Placement::normalBack(const Vec3f& n) const {
  return identity_ ? n : Vec3f(normalized(sh::transposed(linear_) * Vec3d(n)));
}

sh::Matrix3d Placement::turnFrom(const Placement& from) const {
  if (linear_ == from.linear_) return {};
  // linear_ * inverse(from.linear_), scaled to determinant 1.
  sh::Matrix3d turn = linear_ * sh::transposed(from.cofactors_);
  const double scale = 1 / (from.determinant_ * std::cbrt(std::abs(determinant_ / from.determinant_)));
  for (auto& row : turn.m) {
    for (double& v : row) v *= scale;
  }
  return sh::nearestRotation(turn);
}

}  // namespace shbake::meshlab
