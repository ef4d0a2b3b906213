// Environment maps to light: the way of the pixels from the file to the coefficients.
#include "light/environment_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "light/map_projector.h"

namespace shbake {
namespace {

/// Pixels held at a time: 8 MB as RGB, which stay in a cache while they are read, checked and projected; as much again
/// where OpenImageIO hands them over.
constexpr std::size_t kChunkPixels = (std::size_t(8) << 20) / sizeof(Rgb);

/// How many of the strips from `first` on fit a chunk, ending where the file's blocks of rows do if possible: 1 or
/// more.
std::size_t stripsOfChunk(const std::vector<RowStrip>& strips, std::size_t first, const MapRows& rows) {
  const std::size_t fit = kChunkPixels / static_cast<std::size_t>(rows.width);
  std::size_t count = 1, aligned = 0;
  for (std::size_t i = first; i < strips.size(); ++i) {
    const auto height = static_cast<std::size_t>(strips[i].end - strips[first].begin);
    if (height > fit && i > first) break;
    count = i - first + 1;
    if (strips[i].end % rows.rowStep == 0 || i + 1 == strips.size()) aligned = count;
  }
  return aligned > 0 ? aligned : count;
}

/// The rows of a chunk. Tiled files are read in whole rows of tiles, so that a chunk may bring rows of the next one.
class ChunkReader {
 public:
  explicit ChunkReader(const MapRows& rows) : rows_(rows), width_(static_cast<std::size_t>(rows.width)) {}

  /// The pixels of rows begin..end-1, until the next call. `begin` does not fall.
  std::span<Rgb> read(int begin, int end) {
    // Rows that are held already move to the front.
    if (begin > first_ && begin < end_) std::copy(held_.begin() + at(begin), held_.begin() + at(end_), held_.begin());
    first_ = begin;
    end_ = std::max(end_, begin);
    if (end > end_) {
      const int upTo = std::min(rows_.height, (end + rows_.rowStep - 1) / rows_.rowStep * rows_.rowStep);
      const auto need = static_cast<std::size_t>(at(upTo));
      if (held_.size() < need) held_.resize(need);
      rows_.read(end_, upTo, std::span(held_).subspan(at(end_), static_cast<std::size_t>(upTo - end_) * width_));
      end_ = upTo;
    }
    return std::span(held_).first(static_cast<std::size_t>(at(end)));
  }

 private:
  /// Where a row begins among the pixels.
  std::ptrdiff_t at(int row) const { return static_cast<std::ptrdiff_t>(row - first_) * rows_.width; }

  const MapRows& rows_;
  std::size_t width_;
  int first_ = 0, end_ = 0;  ///< the rows that are held
  std::vector<Rgb> held_;
};

void projectChunk(const MapProjector& projector, std::span<const RowStrip> strips, std::span<Rgb> pixels,
                  const MapRows& rows, bool keepNegative, const Parallel& parallel, EnvironmentMapLight& result) {
  const std::size_t width = static_cast<std::size_t>(rows.width);
  std::vector<std::vector<Vec3d>> sums(strips.size(), std::vector<Vec3d>(result.light.coefficients.size()));
  std::vector<BadPixels> bad(strips.size());
  parallel.forBlocks(strips.size(), 1, [&](std::size_t i, std::size_t, int) {
    const int begin = strips[i].begin, end = strips[i].end;
    const std::span<Rgb> own = pixels.subspan(static_cast<std::size_t>(begin - strips[0].begin) * width,
                                              static_cast<std::size_t>(end - begin) * width);
    for (int y = begin; y < end; ++y) {
      bad[i].add(
          repairRow(own.subspan(static_cast<std::size_t>(y - begin) * width, width), y, rows.mostFinite, keepNegative));
    }
    projector.project(strips[i], own, sums[i]);
  });
  // Summed in the order of the rows, so that the result does not depend on the number of threads.
  for (std::size_t i = 0; i < strips.size(); ++i) {
    for (std::size_t k = 0; k < sums[i].size(); ++k) result.light.coefficients[k] += sums[i][k];
    result.badPixels.add(bad[i]);
  }
}

}  // namespace

sh::Matrix3d axesFor(UpAxis up) {
  if (up == UpAxis::z) return {};
  return {{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}};  // y -> -z, z -> y
}

EnvironmentMapLight projectEnvironmentMap(const std::string& path, int order, const EnvironmentMapOptions& options,
                                          const Parallel& parallel, Progress& progress) {
  return projectEnvironmentMap(openMapFile(path, options.encoding, parallel.threads()), order, options, parallel,
                               progress);
}

EnvironmentMapLight projectEnvironmentMap(const MapRows& rows, int order, const EnvironmentMapOptions& options,
                                          const Parallel& parallel, Progress& progress) {
  EnvironmentMapLight result;
  result.light = Light(order);
  result.width = rows.width;
  result.height = rows.height;
  result.notes = rows.notes;
  const ChosenLayout chosen = chooseLayout(rows, options.layout);
  result.layout = chosen.layout;
  result.layoutGuessed = chosen.guessed;

  std::unique_ptr<MapProjector> projector;
  try {
    projector = makeMapProjector({result.layout, rows.width, rows.height, rows.border}, order);
  } catch (const Error& error) {
    rethrowNaming(error, rows.name);
  }

  progress.begin("projecting", static_cast<double>(rows.width) * rows.height, "pixels");
  const std::vector<RowStrip> strips = projector->strips();
  ChunkReader reader(rows);
  for (std::size_t first = 0; first < strips.size();) {
    const std::size_t count = stripsOfChunk(strips, first, rows);
    const auto chunk = std::span(strips).subspan(first, count);
    const std::span<Rgb> pixels = reader.read(chunk.front().begin, chunk.back().end);
    projectChunk(*projector, chunk, pixels, rows, options.keepNegative, parallel, result);
    progress.advance(static_cast<double>(pixels.size()));
    first += count;
  }
  progress.end();

  if (options.mirror) result.light = mirrored(result.light, MirrorAxis::y);
  if (options.up != UpAxis::z) result.light = rotated(result.light, axesFor(options.up));
  result.light = scaled(result.light, Vec3d{1, 1, 1} * std::exp2(options.exposure));
  return result;
}

}  // namespace shbake
