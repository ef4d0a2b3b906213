// A lat-long environment map held in memory, to be looked up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "light/map_rows.h"

namespace shbake {

/// Radiance by direction, interpolated bilinearly between pixel centres. Pixels that are negative or not finite are
/// black: those of BadPixels, which the light does without as well.
class LatLongImage {
 public:
  /// Reads an image file; nothing where it is not known to be a lat-long map (its own word, or 2:1). Throws what
  /// openMapFile() throws.
  static std::optional<LatLongImage> read(const std::string& path, PixelEncoding encoding, int threads);

  /// From a direction of unit length, in the axes of UpAxis::z: row 0 is +z, the centre +x, u = 1/2 - atan2(y, x) /
  /// 2pi.
  Rgb from(const Vec3d& direction) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<Rgb> pixels_;
};

/// The direction that the place (u, v) of a lat-long map stands for, both 0..1 from its upper left corner.
Vec3d latLongDirection(double u, double v);

}  // namespace shbake
