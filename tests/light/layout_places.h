// An independent account of every layout: where a direction is found in a map, worked out from the layouts'
// descriptions and not from the library.
#pragma once

#include "light/support.h"

namespace shbake::testing {

/// A place in an image, in pixels from the left upper corner.
struct Place {
  double x, y;
};

/// What a viewer who looks along +x with +z above has ahead, to the left and above.
struct Viewed {
  double ahead, left, above;

  explicit Viewed(const Vec3d& d) : ahead(d.x), left(d.y), above(d.z) {}
};

enum class Side { front, back, left, right, up, down };

/// A place on a face of a cube that is upright in a horizontal cross: -1..1, rightwards and downwards in its image.
struct FacePlace {
  Side side;
  double rightwards, downwards;
};

inline FacePlace facePlaceOf(const Viewed& d) {
  const double most = std::max({std::abs(d.ahead), std::abs(d.left), std::abs(d.above)});
  const double a = d.ahead / most, l = d.left / most, u = d.above / most;
  if (a == 1) return {Side::front, -l, -u};
  if (a == -1) return {Side::back, l, -u};
  if (l == 1) return {Side::left, a, -u};
  if (l == -1) return {Side::right, -a, -u};
  if (u == 1) return {Side::up, -l, a};
  return {Side::down, -l, -a};
}

/// A face's column and row, in faces, and the place on it.
struct Slot {
  int column, row;
  double rightwards, downwards;
};

inline Slot crossSlot(MapLayout layout, const FacePlace& p) {
  const int column = p.side == Side::left ? 0 : p.side == Side::right ? 2 : 1;
  const int row = p.side == Side::up ? 0 : p.side == Side::down ? 2 : 1;
  if (p.side != Side::back) return {column, row, p.rightwards, p.downwards};
  // The back stands beside the right face, or hangs upside down below the lower one.
  if (layout == MapLayout::crossHorizontal) return {3, 1, p.rightwards, p.downwards};
  return {1, 3, -p.rightwards, -p.downwards};
}

inline Slot stripSlot(MapLayout layout, const FacePlace& p) {
  const Side order[] = {Side::right, Side::left, Side::up, Side::down, Side::front, Side::back};
  const int at = static_cast<int>(std::find(std::begin(order), std::end(order), p.side) - order);
  return {layout == MapLayout::stripHorizontal ? at : 0, layout == MapLayout::stripVertical ? at : 0, p.rightwards,
          p.downwards};
}

/// OpenEXR (ImfEnvmap): faces +X -X +Y -Y +Z -Z, where X = left, Y = up, Z = ahead. Its images show rightwards and
/// downwards: +X: +Z, -Y; -X: -Z, -Y; +Y: +X, -Z; -Y: +X, +Z; +Z: -X, -Y; -Z: +X, -Y.
inline Slot openexrSlot(const Viewed& d) {
  const double most = std::max({std::abs(d.ahead), std::abs(d.left), std::abs(d.above)});
  const double x = d.left / most, y = d.above / most, z = d.ahead / most;
  if (x == 1) return {0, 0, z, -y};
  if (x == -1) return {0, 1, -z, -y};
  if (y == 1) return {0, 2, x, -z};
  if (y == -1) return {0, 3, x, z};
  if (z == 1) return {0, 4, -x, -y};
  return {0, 5, x, -y};
}

inline Slot slotOf(MapLayout layout, const Viewed& d) {
  switch (layout) {
    case MapLayout::crossHorizontal:
    case MapLayout::crossVertical:
      return crossSlot(layout, facePlaceOf(d));
    case MapLayout::openexrCube:
      return openexrSlot(d);
    default:
      return stripSlot(layout, facePlaceOf(d));
  }
}

/// Where direction d, of unit length, is found in a map.
inline Place placeOf(MapLayout layout, const Image& image, const Vec3d& direction) {
  const Viewed d(direction);
  if (layout == MapLayout::latLong) {
    return {(0.5 - std::atan2(d.left, d.ahead) / (2 * kPi)) * image.width, std::acos(d.above) / kPi * image.height};
  }
  if (layout == MapLayout::angular) {
    const double angle = std::acos(d.ahead), sideways = std::hypot(d.left, d.above);
    const double r = sideways > 0 ? angle / kPi / sideways : 0;
    return {(1 - d.left * r) / 2 * image.width, (1 - d.above * r) / 2 * image.height};
  }
  const Slot slot = slotOf(layout, d);
  const int n = layout == MapLayout::crossHorizontal ? image.width / 4
                : layout == MapLayout::crossVertical ? image.width / 3
                                                     : std::min(image.width, image.height);
  return {(slot.column + (1 + slot.rightwards) / 2) * n, (slot.row + (1 + slot.downwards) / 2) * n};
}

}  // namespace shbake::testing
