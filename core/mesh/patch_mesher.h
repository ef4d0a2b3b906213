// Triangulations of plane patches: finding the triangle at a place, and cutting a patch anew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace shbake {

/// A point of a plane.
struct Point2 {
  double x = 0, y = 0;
};

/// Called now and then with the number of points gone through since; may throw to stop the work.
using PointCounter = std::function<void(std::size_t)>;

/// Finds the triangle of a patch that a place lies in. One thread at a time may use an object.
class PatchLocator {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  /// `faces` are triples of point numbers, counter-clockwise.
  PatchLocator(std::span<const Point2> points, std::span<const Triangle> faces, const PointCounter& count);
  ~PatchLocator();

  /// The faces lie side by side: none overlaps another, no point lies in a face or on an edge that it does not belong
  /// to. All else requires that.
  bool valid() const;
  /// The face that `place` lies in or on; kNone: outside all of them. Fast when places follow each other closely.
  std::uint32_t find(Point2 place);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The constrained Delaunay triangulation of the inside of `border`: directed pairs of points with the inside on their
/// left, which form closed loops, or have it on both sides as two opposite pairs. All points lie on the border or
/// inside it. The faces are counter-clockwise triples of point numbers; each border pair is a side of exactly one face,
/// and all other sides are shared by two. Nothing where there are no such faces: borders cross, or points coincide. The
/// edges depend on where the points are, not on their order or which side of a border pair is inside.
/// `wishes` are pairs of points inside that become sides where they cross no border and no earlier wish; nothing where
/// one of them runs through another point.
std::optional<std::vector<Triangle>> triangulatePatch(std::span<const Point2> points,
                                                      std::span<const std::array<std::uint32_t, 2>> border,
                                                      std::span<const std::array<std::uint32_t, 2>> wishes,
                                                      const PointCounter& count);

}  // namespace shbake
