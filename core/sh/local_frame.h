// The axes of a lighting point, and the rotation of coefficients between them and the world's.
#pragma once

#include <array>
#include <span>

#include "base/four.h"
#include "base/vec3.h"
#include "sh/quarter_turn.h"

namespace shbake::sh {

/// Right-handed orthonormal axes in world coordinates; z is the normal.
struct LocalFrame {
  Vec3d x, y, z;
};

/// The columns of R_z(phi) R_y(theta) R_z(spin), where the normal has polar angles (theta, phi); phi = 0 at both poles.
/// `normal` may be off unit length (its length is divided out) but not zero; `spin` turns x and y about the normal, in
/// radians. The axes are orthonormal to 1e-15 and the direction of z keeps that of the normal to 1e-15.
LocalFrame localFrame(const Vec3d& normal, double spin);

/// Turns coefficient vectors of one order between local frames and world axes. Immutable, free of allocation after
/// construction and therefore safe to share between threads.
class FrameRotation {
 public:
  /// Throws a usage error unless 1 <= order <= kMaxTurnOrder.
  explicit FrameRotation(int order);

  int order() const { return turn_.order(); }

  /// A function given by `local` in the axes of localFrame(normal, spin) gets its coefficients in world axes. Both hold
  /// order^2 coefficients and may be the same array.
  void toWorld(const Vec3d& normal, double spin, std::span<const double> local, std::span<double> world) const;
  /// The same of four functions, function i being lane i: the same bits, sooner.
  void toWorld(const std::array<Vec3d, 4>& normals, const std::array<double, 4>& spins, std::span<const Four> local,
               std::span<Four> world) const;
  /// The inverse of the first.
  void toLocal(const Vec3d& normal, double spin, std::span<const double> world, std::span<double> local) const;

 private:
  QuarterTurn turn_;
};

}  // namespace shbake::sh
