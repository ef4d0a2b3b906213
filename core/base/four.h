// Four numbers that are calculated with side by side.
#pragma once

namespace shbake {

/// Four doubles: arithmetic works on all of them at once, in whatever vector registers there are (base/wide.h).
class alignas(32) Four {
 public:
  /// Not set, as a double by itself.
  Four() = default;
  /// The same in all lanes.
  [[gnu::always_inline]] Four(double value) : lanes_{value, value, value, value} {}

  double operator[](int lane) const { return lanes_[lane]; }
  void set(int lane, double value) { lanes_[lane] = value; }

  [[gnu::always_inline]] friend Four operator+(const Four& a, const Four& b) { return Four(a.lanes_ + b.lanes_); }
  [[gnu::always_inline]] friend Four operator-(const Four& a, const Four& b) { return Four(a.lanes_ - b.lanes_); }
  [[gnu::always_inline]] friend Four operator*(const Four& a, const Four& b) { return Four(a.lanes_ * b.lanes_); }

 private:
  // By itself it is aligned as the processor asks that a function is compiled for: clones would disagree.
  using Lanes [[gnu::vector_size(32)]] = double;

  [[gnu::always_inline]] explicit Four(const Lanes& lanes) : lanes_(lanes) {}

  Lanes lanes_;
};

}  // namespace shbake
