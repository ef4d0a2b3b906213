// Environment maps ("light probes") as light.
#pragma once

#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "light/bad_pixels.h"
#include "light/light.h"
#include "light/map_layout.h"
#include "light/map_rows.h"

namespace shbake {

/// Which axis points up.
enum class UpAxis {
  z,  ///< forward = +x, right = -y, up = +z: lat-long maps have u = 1/2 - atan2(y, x) / 2pi (Blender)
  y,  ///< forward = +x, right = +z, up = +y: the same scene turned by -90 degrees about x, as glTF exporters do
      ///< (three.js); sh::toYUp()
};

struct EnvironmentMapOptions {
  MapLayout layout = MapLayout::automatic;
  UpAxis up = UpAxis::z;
  bool mirror = false;                                ///< the image shows the world mirrored (left and right exchanged)
  double exposure = 0;                                ///< radiance is multiplied by 2^exposure
  bool keepNegative = false;                          ///< negative pixels count as they are; otherwise as 0
  PixelEncoding encoding = PixelEncoding::automatic;  ///< for files only
};

/// An environment map's light and what was found in it.
struct EnvironmentMapLight {
  Light light;
  MapLayout layout = MapLayout::latLong;  ///< the layout taken
  bool layoutGuessed = false;             ///< from width : height, not from the file or the options
  int width = 0, height = 0;
  BadPixels badPixels;
  std::vector<std::string> notes;  ///< what was assumed, one sentence each
};

/// Projects an image file. Pixels are read once, from top to bottom, and about 16 MB (more where a row of tiles is
/// larger) are held at a time. Each pixel is an even patch of the sphere, integrated in double precision
/// (MapProjector); nothing is clamped but what BadPixels counts. Throws an Error: usage for an order out
/// of 1..kMaxLightOrder, work for a file that cannot be read or whose shape does not fit the layout, cancelled.
EnvironmentMapLight projectEnvironmentMap(const std::string& path, int order, const EnvironmentMapOptions& options,
                                          const Parallel& parallel, Progress& progress);

/// The same for any source of rows.
EnvironmentMapLight projectEnvironmentMap(const MapRows& rows, int order, const EnvironmentMapOptions& options,
                                          const Parallel& parallel, Progress& progress);

/// The rotation from the canonical frame (UpAxis::z) to the axes of `up`.
sh::Matrix3d axesFor(UpAxis up);

}  // namespace shbake
