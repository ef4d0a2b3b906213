// Random places on the surface of lighting points, and what is interpolated there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// A place on a face: the weights of its corners, each 0..1, their sum 1.
struct SurfacePlace {
  std::uint32_t face;
  std::array<double, 3> weights;
};

/// The area of a face in square work units.
double faceArea(const LightingPoints& points, std::uint32_t face);

/// True where none of a face's corners reflects light.
bool isBlackFace(const LightingPoints& points, std::uint32_t face);

/// The areas of the first `faces` faces, but 0 for black ones: weights that spread places evenly over the surface.
std::vector<double> areaWeights(const LightingPoints& points, std::size_t faces);

/// Draws two places from each of count / 2 equal shares of the weights along the Morton curve, on which points are
/// numbered; `count` is even. A face gets places in proportion to its weight (0 or more), spread evenly over it; the
/// weights are those of the first faces, and faces behind them get none. No places where all weights are 0. Depends on
/// the points' numbers, not on the order of faces or corners. Progress counts faces.
std::vector<SurfacePlace> drawPlaces(const LightingPoints& points, std::span<const double> weights, std::size_t count,
                                     std::uint64_t seed, Progress& progress);

/// What a lighting point has, interpolated at a place.
struct PlacedPoint {
  Vec3f position;  ///< in work units
  Vec3f normal;    ///< unit; the face's own where the interpolated one vanishes
  Rgb albedo;
};
PlacedPoint pointAt(const LightingPoints& points, const SurfacePlace& place);

/// Adds a lighting point for each place, pointAt() it, in their order behind the others. No face has it as a corner:
/// the fan test finds it in contact with its own. Positions may move: whoever traces them in place (FaceTree) must not
/// be left behind.
void addPlaces(LightingPoints& points, std::span<const SurfacePlace> places);

/// A copy of the points with places added, for whoever traces rays: without what is written to files. The faces of a
/// tree (FaceTree) of `points` are those of the copy too.
LightingPoints withPlaces(const LightingPoints& points, std::span<const SurfacePlace> places);

/// The positions of the points from number `first` on.
std::vector<std::uint32_t> positionsFrom(const LightingPoints& points, std::size_t first);

/// Adds `weight` times the transfer at a place with these weights of the corners to `sum`, which has set.stride()
/// values.
void addInterpolated(const TransferSet& set, const Triangle& corners, const std::array<double, 3>& weights,
                     double weight, std::span<double> sum);

}  // namespace shbake
