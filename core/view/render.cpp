// A z-buffer with edge functions (Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988).
#include "view/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "view/placed_triangles.h"

namespace shbake {
namespace {

constexpr int kBandRows = 16;

void validate(const Mesh& mesh, std::span<const Rgb> colors, const RenderOptions& options) {
  if (colors.size() != mesh.positions.size()) {
    throw usageError("there are " + std::to_string(colors.size()) + " colours for " +
                     std::to_string(mesh.positions.size()) + " vertices");
  }
  if (options.samples < 1 || options.samples > 16) {
    throw usageError("the number of samples is out of range", "give 1 to 16");
  }
}

/// Twice the signed area of (a, b, p): positive where p lies to the right of the way from a to b, y downwards.
std::int64_t edge(const PlacedCorner& a, const PlacedCorner& b, std::int64_t x, std::int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// The samples of some rows of pixels.
class Band {
 public:
  Band(int firstRow, int rows, const RenderOptions& options)
      : options_(options), first_(firstRow), rows_(rows), width_(options.width * options.samples) {
    const std::size_t count = static_cast<std::size_t>(width_) * rows * options.samples;
    colors_.resize(count);
    nearness_.resize(count);
  }

  void draw(const PlacedCorner& a, const PlacedCorner& b, const PlacedCorner& c);
  void resolve(const Camera& camera, Picture& picture) const;

 private:
  Rgb background(const Camera& camera, int x, int y) const;
  Rgb mapped(const Rgb& radiance) const { return options_.tone ? displayLight(radiance, *options_.tone) : radiance; }

  const RenderOptions& options_;
  int first_, rows_, width_;
  std::vector<Rgb> colors_;
  std::vector<double> nearness_;  ///< 1 / depth of the nearest surface so far, 0 for none
};

void Band::draw(const PlacedCorner& a, const PlacedCorner& b, const PlacedCorner& c) {
  const std::int64_t area = edge(a, b, c.x, c.y);
  // With y downwards, a triangle that runs counter-clockwise for its viewer has a negative area.
  if (area == 0 || (options_.cullBackFaces && area > 0)) return;
  const std::int64_t sign = area > 0 ? 1 : -1;
  const int top = first_ * options_.samples, bottom = top + rows_ * options_.samples;
  const auto [lowX, highX] = std::minmax({a.x, b.x, c.x});
  const auto [lowY, highY] = std::minmax({a.y, b.y, c.y});
  // Samples lie in the middle of their cells; a cell too many at either end is found to be outside.
  const auto cell = [](std::int64_t place, std::int64_t least, std::int64_t most) {
    return static_cast<int>(std::clamp(place >= 0 ? place / kGridSteps : std::int64_t(-1), least, most));
  };
  const int x0 = cell(lowX, 0, width_), x1 = cell(highX, -1, width_ - 1);
  const int y0 = cell(lowY, top, bottom), y1 = cell(highY, top - 1, bottom - 1);
  const double scale = 1 / static_cast<double>(sign * area);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const std::int64_t px = x * kGridSteps + kGridSteps / 2, py = y * kGridSteps + kGridSteps / 2;
      const std::int64_t ea = sign * edge(b, c, px, py), eb = sign * edge(c, a, px, py), ec = sign * edge(a, b, px, py);
      if (ea < 0 || eb < 0 || ec < 0) continue;
      // 1 / depth is linear in the picture, and so is whatever is linear in space, divided by depth.
      const double wa = static_cast<double>(ea) * scale * a.inverseDepth;
      const double wb = static_cast<double>(eb) * scale * b.inverseDepth;
      const double wc = static_cast<double>(ec) * scale * c.inverseDepth;
      const double nearness = wa + wb + wc;
      const std::size_t at = static_cast<std::size_t>(y - top) * width_ + x;
      if (!(nearness > nearness_[at])) continue;
      nearness_[at] = nearness;
      colors_[at] = a.color * static_cast<float>(wa / nearness) + b.color * static_cast<float>(wb / nearness) +
                    c.color * static_cast<float>(wc / nearness);
    }
  }
}

Rgb Band::background(const Camera& camera, int x, int y) const {
  const Background& b = options_.background;
  const double down = (y + 0.5) / options_.height;
  if (b.radiance) return mapped(b.radiance(camera.direction(2 * (x + 0.5) / options_.width - 1, 1 - 2 * down)));
  return b.top * static_cast<float>(1 - down) + b.bottom * static_cast<float>(down);
}

void Band::resolve(const Camera& camera, Picture& picture) const {
  const int n = options_.samples;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < options_.width; ++x) {
      Rgb sum;
      int covered = 0;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const std::size_t at = static_cast<std::size_t>(y * n + j) * width_ + static_cast<std::size_t>(x * n + i);
          if (nearness_[at] == 0) continue;
          sum += mapped(colors_[at]);
          ++covered;
        }
      }
      if (covered < n * n) sum += background(camera, x, first_ + y) * static_cast<float>(n * n - covered);
      picture.at(x, first_ + y) = sum * (1 / static_cast<float>(n * n));
    }
  }
}

}  // namespace

Picture render(const Mesh& mesh, std::span<const Rgb> colors, const Camera& camera, const RenderOptions& options,
               const Parallel& parallel) {
  validate(mesh, colors, options);
  Picture picture(options.width, options.height);
  const PlacedTriangles placed =
      placeTriangles(mesh, colors, camera, options.width * options.samples, options.height * options.samples);
  parallel.forBlocks(static_cast<std::size_t>(options.height), kBandRows, [&](std::size_t begin, std::size_t end, int) {
    Band band(static_cast<int>(begin), static_cast<int>(end - begin), options);
    const auto top = static_cast<std::int64_t>(begin) * options.samples * kGridSteps;
    const auto bottom = static_cast<std::int64_t>(end) * options.samples * kGridSteps;
    for (const Triangle& t : placed.triangles) {
      const PlacedCorner &a = placed.corners[t[0]], &b = placed.corners[t[1]], &c = placed.corners[t[2]];
      const auto [low, high] = std::minmax({a.y, b.y, c.y});
      if (high < top || low > bottom) continue;
      band.draw(a, b, c);
    }
    band.resolve(camera, picture);
  });
  return picture;
}

}  // namespace shbake
