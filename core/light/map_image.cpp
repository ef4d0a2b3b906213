// Looking up directions in environment maps: the layouts of map_layout.h read the other way round.
#include "light/map_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace shbake {
namespace {

using std::numbers::pi;

/// The width of the squares that a layout consists of, in pixels.
int unitOf(MapLayout layout, int width, int height) {
  return layout == MapLayout::latLong ? height : mapCharts(layout, width, height)[0].size;
}

/// The least block of pixels whose averages are few enough; 1 where none divides the image evenly.
int blockFor(const MapRows& rows, MapLayout layout) {
  const auto count = static_cast<std::size_t>(rows.width) * rows.height;
  if (count <= MapImage::kMostPixels || rows.border) return 1;
  const int unit = unitOf(layout, rows.width, rows.height);
  for (int block = 2; block <= unit; ++block) {
    const bool divides = unit % block == 0 && rows.width % block == 0;
    if (divides && count / block / block <= MapImage::kMostPixels) return block;
  }
  return 1;
}

}  // namespace

MapImage MapImage::read(const std::string& path, const EnvironmentMapOptions& options, int threads) {
  return MapImage(openMapFile(path, options.encoding, threads), options);
}

MapImage::MapImage(const MapRows& rows, const EnvironmentMapOptions& options)
    : layout_(chooseLayout(rows, options.layout).layout),
      border_(rows.border && layout_ != MapLayout::angular),
      toCanonical_(sh::transposed(axesFor(options.up))),
      mirror_(options.mirror),
      gain_(static_cast<float>(std::exp2(options.exposure))) {
  try {
    const int block = blockFor(rows, layout_);
    width_ = rows.width / block;
    height_ = rows.height / block;
    if (layout_ != MapLayout::latLong) charts_ = mapCharts(layout_, width_, height_);
    if (border_ && (width_ < 2 || height_ < 2)) {
      throw Error({.place = "header", .cause = "a map with pixels on its edge needs 2 pixels across"});
    }
    readRows(rows, options, block);
  } catch (const Error& error) {
    rethrowNaming(error, rows.name);
  }
}

void MapImage::readRows(const MapRows& rows, const EnvironmentMapOptions& options, int block) {
  const std::size_t width = static_cast<std::size_t>(rows.width);
  const int step = std::max(block, rows.rowStep / block * block);
  std::vector<Rgb> held;
  pixels_.resize(static_cast<std::size_t>(width_) * height_);
  const float share = 1 / static_cast<float>(block * block);
  for (int begin = 0; begin < rows.height; begin += step) {
    const int end = std::min(begin + step, rows.height);
    held.resize(static_cast<std::size_t>(end - begin) * width);
    rows.read(begin, end, held);
    for (int y = begin; y < end; ++y) {
      const std::span<Rgb> row = std::span(held).subspan(static_cast<std::size_t>(y - begin) * width, width);
      repairRow(row, y, rows.mostFinite, options.keepNegative);
      Rgb* const out = &pixels_[static_cast<std::size_t>(y / block) * width_];
      for (std::size_t x = 0; x < width; ++x) out[x / block] += row[x] * share;
    }
  }
}

/// Where the centre of pixel i of a chart lies, -1..1 within it.
double MapImage::chartCoordinate(int i) const {
  const int size = charts_[0].size;
  return border_ ? -1 + 2.0 * i / (size - 1) : -1 + (2.0 * i + 1) / size;
}

/// The direction that the centre of a pixel stands for; pixels outside of the chart continue it.
Vec3d MapImage::directionOf(int chart, int x, int y) const {
  const CubeFace& face = charts_[chart];
  const double s = chartCoordinate(x), t = -chartCoordinate(y);
  if (layout_ != MapLayout::angular) return normalized(face.forward + s * face.right + t * face.up);
  const double r = std::hypot(s, t), slope = r > 0 ? std::sin(pi * r) / r : 0;
  return std::cos(pi * r) * face.forward + slope * (s * face.right + t * face.up);
}

MapImage::Place MapImage::placeOf(const Vec3d& d) const {
  if (layout_ == MapLayout::latLong) {
    const double u = 0.5 - std::atan2(d.y, d.x) / (2 * pi), v = std::acos(std::clamp(d.z, -1.0, 1.0)) / pi;
    return border_ ? Place{0, u * (width_ - 1), v * (height_ - 1)} : Place{0, u * width_ - 0.5, v * height_ - 0.5};
  }
  const auto ahead = [&](const CubeFace& face) { return dot(face.forward, d); };
  const auto face = std::max_element(charts_.begin(), charts_.end(),
                                     [&](const CubeFace& a, const CubeFace& b) { return ahead(a) < ahead(b); });
  double s = dot(face->right, d), t = dot(face->up, d), scale = 1 / ahead(*face);
  if (layout_ == MapLayout::angular) {
    const double sideways = std::hypot(s, t);
    scale = sideways > 0 ? std::atan2(sideways, ahead(*face)) / pi / sideways : 0;
  }
  s *= scale;
  t *= scale;
  const int chart = static_cast<int>(face - charts_.begin()), size = face->size;
  if (border_) return {chart, (1 + s) / 2 * (size - 1), (1 - t) / 2 * (size - 1)};
  return {chart, (1 + s) / 2 * size - 0.5, (1 - t) / 2 * size - 0.5};
}

Rgb MapImage::nearest(const Vec3d& direction) const {
  Place place = placeOf(direction);
  const int size = charts_[place.chart].size;
  if (layout_ == MapLayout::angular) {
    // The nearest centre is at most half a diagonal away: kept within the circle, outside of which the map says
    // nothing.
    const double middle = 0.5 * (size - 1), x = place.x - middle, y = place.y - middle;
    const double away = std::hypot(x, y), most = size / 2.0 - std::numbers::sqrt2 / 2;
    if (away > most) place = {0, middle + x * most / away, middle + y * most / away};
  }
  const auto inRange = [size](double v) { return std::clamp(static_cast<int>(std::lround(v)), 0, size - 1); };
  const CubeFace& chart = charts_[place.chart];
  return pixels_[static_cast<std::size_t>(chart.y + inRange(place.y)) * width_ + chart.x + inRange(place.x)];
}

Rgb MapImage::pixel(int chart, int x, int y) const {
  if (layout_ == MapLayout::latLong) {
    // Columns go round, and beyond a pole the other half of its rows comes down again.
    const int around = border_ ? width_ - 1 : width_;
    if (y < 0 || y >= height_) {
      y = y < 0 ? -1 - y : 2 * height_ - 1 - y;
      x += around / 2;
    }
    return pixels_[static_cast<std::size_t>(y) * width_ + ((x % around) + around) % around];
  }
  const CubeFace& face = charts_[chart];
  bool known = x >= 0 && y >= 0 && x < face.size && y < face.size;
  if (layout_ == MapLayout::angular) known = known && std::hypot(chartCoordinate(x), chartCoordinate(y)) <= 1;
  if (!known) return nearest(directionOf(chart, x, y));
  return pixels_[static_cast<std::size_t>(face.y + y) * width_ + face.x + x];
}

Rgb MapImage::from(const Vec3d& direction) const {
  Vec3d d = toCanonical_ * direction;
  if (mirror_) d.y = -d.y;
  const Place place = placeOf(d);
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  const auto fx = static_cast<float>(place.x - x), fy = static_cast<float>(place.y - y);
  const auto along = [&](int row) {
    return pixel(place.chart, x, row) * (1 - fx) + pixel(place.chart, x + 1, row) * fx;
  };
  return (along(y) * (1 - fy) + along(y + 1) * fy) * gain_;
}

}  // namespace shbake
