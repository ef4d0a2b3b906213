// Integrals of an environment map against spherical harmonics, a strip of rows at a time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "light/map_layout.h"

namespace shbake {

/// Rows begin..end-1 of an image.
struct RowStrip {
  int begin = 0, end = 0;
};

/// The shape of an environment map.
struct MapShape {
  MapLayout layout = MapLayout::latLong;  ///< not `automatic`
  int width = 0, height = 0;
  bool border = false;  ///< see MapRows::border; ignored by angular maps
};

/// Each pixel stands for an even radiance over its part of the sphere, and y_lm is integrated over that part: exactly
/// for lat-long maps, for the others to 1e-12 of the pixel's share. Immutable, so that strips can be done in parallel.
class MapProjector {
 public:
  virtual ~MapProjector() = default;

  /// How the rows are to be handed over, from top to bottom.
  virtual std::vector<RowStrip> strips() const = 0;
  /// Adds the integrals over the strip to `sum` (order^2 coefficients in the canonical frame of CubeFace). `pixels`
  /// holds the strip's rows; all finite.
  virtual void project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const = 0;
};

/// Throws an Error without a file name when the image does not have the shape that its layout asks for.
std::unique_ptr<MapProjector> makeMapProjector(const MapShape& shape, int order);

}  // namespace shbake
