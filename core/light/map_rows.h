// Where an environment map's pixels come from: rows read from top to bottom, never the whole image at once.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vec3.h"
#include "light/map_layout.h"

namespace shbake {

/// What the numbers of an image mean.
enum class PixelEncoding {
  automatic,  ///< integers are sRGB display values, floats are linear radiance
  linear,
  srgb,
};

/// An image as a sequence of rows of linear RGB.
struct MapRows {
  std::string name;  ///< for messages
  int width = 0, height = 0;
  int rowStep = 1;       ///< rows that are stored together: reading multiples of it is cheapest
  bool border = false;   ///< the outermost pixel centres lie on the edge of the map (OpenEXR's environment maps)
  float mostFinite = 0;  ///< what an infinity stands for: the largest number a half float holds, 0 for other formats
  std::optional<MapLayout> layout;  ///< what the file says about its layout
  std::vector<std::string> notes;   ///< what was assumed in reading, one sentence each

  /// Fills `out` with rows begin..end-1 (width pixels each). Called with rising rows, from one thread at a time.
  std::function<void(int begin, int end, std::span<Rgb> out)> read;
};

/// Opens an image file of any format that OpenImageIO reads; one-channel images are grey, alpha is ignored. `threads`
/// decode (0: all cores). Throws an Error naming the file when it cannot be read, is turned by an orientation tag, or
/// holds luminance and chroma instead of colours; `read` throws when the file ends early.
MapRows openMapFile(const std::string& path, PixelEncoding encoding, int threads);

/// The layout that is asked for; for MapLayout::automatic what the file says, else what the shape tells. Throws an
/// Error where nothing tells it.
struct ChosenLayout {
  MapLayout layout = MapLayout::latLong;
  bool guessed = false;  ///< from the shape
};
ChosenLayout chooseLayout(const MapRows& rows, MapLayout asked);

/// Throws the error again with the file's name, which projectors and layouts do not know.
[[noreturn]] void rethrowNaming(const Error& error, const std::string& name);

/// The rows of an image in memory, which must outlive them. Throws a usage error unless pixels.size() = width * height.
MapRows mapInMemory(int width, int height, std::span<const Rgb> pixels);

}  // namespace shbake
