// Three-component vectors and linear RGB colours.
#pragma once

#include <cmath>

namespace shbake {

/// A vector, point or direction in right-handed axes.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class U>
  constexpr explicit Vec3(const Vec3<U>& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  constexpr Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a * s; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
/// Linear red, green, blue.
using Rgb = Vec3<float>;

inline bool isColored(const Rgb& c) {
  return c.x != c.y || c.y != c.z;
}

template <class T>
constexpr T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}

/// `a` at unit length; a vector whose squared length is zero, or underflows to it, becomes zero.
template <class T>
Vec3<T> normalized(Vec3<T> a) {
  const T l = length(a);
  return l > T(0) ? a * (T(1) / l) : Vec3<T>{};
}

template <class T>
bool isFinite(Vec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Each component rounded to the nearest float. Vec3d(Vec3f(v)) does not do: where GCC 12 makes vectors of neighbouring
/// values (-O2 and -O3), it drops the way to float and back.
Vec3d roundedToFloat(const Vec3d& v);

/// The angle between two vectors of any length in radians, accurate near 0 and pi (Kahan, "How Futile are Mindless
/// Assessments of Roundoff in Floating-Point Computation?", 2006, section 12).
template <class T>
T angleBetween(Vec3<T> a, Vec3<T> b) {
  const Vec3<T> u = a * length(b), v = b * length(a);
  return T(2) * std::atan2(length(u - v), length(u + v));
}

}  // namespace shbake
