// Environment maps from files by OpenImageIO. Its shared libraries (over 200 on Debian 12) cost every program that
// links them 0.3 s and 120 MB at its start: this file is a module of its own, loaded by map_rows.cpp when it is first
// needed.
#include "light/map_file_module.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "base/error.h"
#include "base/srgb.h"

namespace shbake {
namespace {

constexpr float kMostHalf = 65504;  // the largest finite half float

/// The channels that hold red, green and blue; one channel three times for grey images.
using ChannelChoice = std::array<int, 3>;

[[noreturn]] void fail(const std::string& path, std::string place, std::string cause, std::string remedy) {
  throw Error({.file = path, .place = std::move(place), .cause = std::move(cause), .remedy = std::move(remedy)});
}

/// OpenImageIO's messages end with newlines and may repeat the file's name.
std::string cleaned(std::string message, const std::string& path) {
  for (std::size_t at; (at = message.find('"' + path + '"')) != std::string::npos;) message.erase(at, path.size() + 2);
  std::replace(message.begin(), message.end(), '\n', ' ');
  while (!message.empty() && (std::isspace(static_cast<unsigned char>(message.back())) || message.back() == '.')) {
    message.pop_back();
  }
  return message.empty() ? "cannot be read" : message;
}

int channelNamed(const OIIO::ImageSpec& spec, const std::string& name) {
  for (int c = 0; c < spec.nchannels; ++c) {
    std::string known = spec.channel_name(c);
    std::transform(known.begin(), known.end(), known.begin(), [](unsigned char ch) { return std::toupper(ch); });
    if (known == name) return c;
  }
  return -1;
}

ChannelChoice chooseChannels(const std::string& path, const OIIO::ImageSpec& spec, std::vector<std::string>& notes) {
  const ChannelChoice rgb{channelNamed(spec, "R"), channelNamed(spec, "G"), channelNamed(spec, "B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  if (channelNamed(spec, "RY") >= 0) {
    fail(path, "channels", "holds luminance and chroma (Y, RY, BY) instead of colours", "save it as RGB");
  }
  if (spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0) < 3) {
    const int grey = spec.alpha_channel == 0 && spec.nchannels > 1 ? 1 : 0;
    notes.push_back("one channel, taken as grey");
    return {grey, grey, grey};
  }
  notes.push_back("channels " + spec.channelnames[0] + ", " + spec.channelnames[1] + ", " + spec.channelnames[2] +
                  " taken as red, green, blue");
  return {0, 1, 2};
}

/// What the file's own attributes say.
std::optional<MapLayout> statedLayout(const OIIO::ImageSpec& spec) {
  const std::string format = spec.get_string_attribute("textureformat");
  if (format == "LatLong Environment") return MapLayout::latLong;
  if (format == "CubeFace Environment") return MapLayout::openexrCube;
  return std::nullopt;
}

bool isFloat(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point();
}

/// An open file and what is needed to turn its pixels into linear RGB.
struct OpenFile {
  std::string path;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  ChannelChoice channels{};
  bool decodeSrgb = false;
  std::vector<float> pixels;  ///< the rows of the current read, channelCount() floats a pixel

  int firstChannel() const { return *std::min_element(channels.begin(), channels.end()); }
  int channelCount() const { return *std::max_element(channels.begin(), channels.end()) + 1 - firstChannel(); }

  void read(int begin, int end, std::span<Rgb> out) {
    const int count = channelCount(), first = firstChannel();
    pixels.resize(static_cast<std::size_t>(end - begin) * spec.width * count);
    const int top = spec.y + begin, bottom = spec.y + end, last = first + count;
    const bool done = spec.tile_width > 0 ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, top, bottom, spec.z,
                                                              spec.z + 1, first, last, OIIO::TypeFloat, pixels.data())
                                          : input->read_scanlines(0, 0, top, bottom, spec.z, first, last,
                                                                  OIIO::TypeFloat, pixels.data());
    if (!done) {
      fail(path, "rows " + std::to_string(begin) + " to " + std::to_string(end - 1), cleaned(input->geterror(), path),
           "the file is damaged or cut off: fetch it again");
    }
    const int r = channels[0] - first, g = channels[1] - first, b = channels[2] - first;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float* p = pixels.data() + i * static_cast<std::size_t>(count);
      out[i] = {p[r], p[g], p[b]};
      if (decodeSrgb) out[i] = srgbToLinear(out[i]);
    }
  }
};

void requireUpright(const std::string& path, const OIIO::ImageSpec& spec) {
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation != 1) {
    fail(path, "header", "the image is stored turned or mirrored (orientation " + std::to_string(orientation) + ")",
         "save it upright");
  }
}

MapRows openImage(const std::string& path, PixelEncoding encoding, int threads) {
  // OpenEXR decodes on a pool of its own, which OpenImageIO sizes for the whole process.
  OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);
  auto file = std::make_shared<OpenFile>();
  file->path = path;
  file->input = OIIO::ImageInput::open(path);
  if (!file->input) {
    fail(path, "", cleaned(OIIO::geterror(), path), "give an HDR, EXR or other image file");
  }
  file->input->threads(threads);
  file->spec = file->input->spec();
  const OIIO::ImageSpec& spec = file->spec;
  if (spec.depth > 1 || spec.deep) fail(path, "header", "is a volume or a deep image", "give a flat image");
  requireUpright(path, spec);

  MapRows rows;
  rows.name = path;
  rows.width = spec.width;
  rows.height = spec.height;
  // Compressed scanlines come in blocks of up to 32 in OpenEXR's lossless formats.
  rows.rowStep = spec.tile_height > 0 ? spec.tile_height : 32;
  rows.border = spec.get_int_attribute("oiio:sampleborder") != 0;
  rows.mostFinite = spec.format == OIIO::TypeHalf ? kMostHalf : 0;
  rows.layout = statedLayout(spec);
  file->channels = chooseChannels(path, spec, rows.notes);
  file->decodeSrgb = encoding == PixelEncoding::srgb || (encoding == PixelEncoding::automatic && !isFloat(spec));
  if (file->decodeSrgb) rows.notes.push_back("display values, decoded from sRGB to linear light");
  if (!isFloat(spec))
    rows.notes.push_back("integers of a limited range: bright sources such as the sun may be cut off");
  rows.read = [file](int begin, int end, std::span<Rgb> out) { file->read(begin, end, out); };
  return rows;
}

}  // namespace

}  // namespace shbake

void shbakeOpenMapFile(const std::string& path, shbake::PixelEncoding encoding, int threads, shbake::MapRows& rows) {
  rows = shbake::openImage(path, encoding, threads);
}
