// Pictures to files, encoded in memory by OpenImageIO.
#include "view/picture_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "view/tone_map.h"

namespace shbake {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw Error({.file = path, .cause = "the picture cannot be encoded: " + cause, .remedy = "report it"});
}

std::vector<unsigned char> encode(const std::string& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc from,
                                  const void* pixels) {
  const std::string format = pictureFormatOf(path) == PictureFormat::png ? "png" : "openexr";
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->supports("ioproxy")) fail(path, "this OpenImageIO does not write " + format + " to memory");
  output->set_ioproxy(&memory);
  if (!output->open("picture." + format, spec) || !output->write_image(from, pixels) || !output->close()) {
    fail(path, output->geterror());
  }
  return bytes;
}

}  // namespace

PictureFormat pictureFormatOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".png") return PictureFormat::png;
  if (extension == ".exr") return PictureFormat::exr;
  throw Error({.kind = ErrorKind::usage,
               .file = path,
               .cause = "'" + extension + "' is not a format of pictures that shbake writes",
               .remedy = "name it .png or .exr"});
}

void writePicture(const std::string& path, const Picture& picture) {
  std::vector<unsigned char> bytes;
  if (pictureFormatOf(path) == PictureFormat::png) {
    std::vector<unsigned char> encoded;
    encoded.reserve(3 * picture.pixels.size());
    for (const Rgb& c : picture.pixels) {
      for (const float v : {c.x, c.y, c.z}) encoded.push_back(encodedByte(v));
    }
    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("png:compressionLevel", 9);
    bytes = encode(path, spec, OIIO::TypeUInt8, encoded.data());
  } else {
    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeHalf);
    spec.attribute("oiio:ColorSpace", "Linear");
    bytes = encode(path, spec, OIIO::TypeFloat, picture.pixels.data());
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace shbake
