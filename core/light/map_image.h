// An environment map held in memory, to be looked up by direction.
#pragma once

#include <string>
#include <vector>

#include "base/vec3.h"
#include "light/environment_map.h"

namespace shbake {

/// Radiance by direction: bilinear between pixel centres, across the edges of a cube's faces, over the poles of a
/// lat-long map and around the rim of an angular one too. Bad pixels count as they do in projectEnvironmentMap().
class MapImage {
 public:
  /// Reads an image file whole. One of more than kMostPixels is averaged over blocks of 2 x 2, 3 x 3 or more pixels
  /// while it is read, where its faces divide into them. Throws what projectEnvironmentMap() throws.
  static MapImage read(const std::string& path, const EnvironmentMapOptions& options, int threads);

  /// The same for any source of rows.
  MapImage(const MapRows& rows, const EnvironmentMapOptions& options);

  /// From a direction of unit length, in the axes that `options` ask for.
  Rgb from(const Vec3d& direction) const;

  int width() const { return width_; }
  int height() const { return height_; }

  static constexpr std::size_t kMostPixels = std::size_t(1) << 24;

 private:
  /// A place on a chart in pixels from the centre of its left upper one: rightwards x, downwards y.
  struct Place {
    int chart;
    double x, y;
  };

  void readRows(const MapRows& rows, const EnvironmentMapOptions& options, int block);
  Place placeOf(const Vec3d& direction) const;
  Vec3d directionOf(int chart, int x, int y) const;
  Rgb pixel(int chart, int x, int y) const;
  Rgb nearest(const Vec3d& direction) const;
  double chartCoordinate(int i) const;

  MapLayout layout_;
  bool border_;
  int width_ = 0, height_ = 0;
  std::vector<Rgb> pixels_;
  std::vector<CubeFace> charts_;  ///< faces of a cube, or the one square of an angular map
  sh::Matrix3d toCanonical_;      ///< from the axes that were asked for
  bool mirror_;
  float gain_;
};

}  // namespace shbake
