// Rotation of coefficients about the z axis.
#pragma once

#include <array>

namespace shbake::sh {

/// The highest order that ZRotation and what stands on it accept.
inline constexpr int kMaxTurnOrder = 128;

/// cos and sin of an angle, without the angle. T is double, or Four of four angles.
template <class T>
struct TurnOf {
  T cosine = 1, sine = 0;
};
using Turn = TurnOf<double>;

/// cos m a and sin m a for m below an order, by the addition theorem, on the stack.
template <class T>
class ZRotationOf {
 public:
  /// The rotation by the angle a about z, for degrees 0..order-1; order <= kMaxTurnOrder.
  [[gnu::always_inline]] ZRotationOf(int order, const TurnOf<T>& a) {
    cosines_[0] = 1;
    sines_[0] = 0;
    for (int m = 1; m < order; ++m) {
      cosines_[m] = cosines_[m - 1] * a.cosine - sines_[m - 1] * a.sine;
      sines_[m] = cosines_[m - 1] * a.sine + sines_[m - 1] * a.cosine;
    }
  }

  /// Turns the 2l+1 coefficients m = -l..l of one band in place, maths.md (15).
  [[gnu::always_inline]] void apply(int l, T* band) const {
    for (int m = 1; m <= l; ++m) {
      const T c = band[l + m], s = band[l - m];
      band[l + m] = c * cosines_[m] - s * sines_[m];
      band[l - m] = c * sines_[m] + s * cosines_[m];
    }
  }

 private:
  std::array<T, kMaxTurnOrder> cosines_, sines_;
};
using ZRotation = ZRotationOf<double>;

}  // namespace shbake::sh
