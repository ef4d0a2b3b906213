// Pictures to files, encoded by a module that is loaded for the first of them.
#include "view/picture_file.h"

#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_name.h"
#include "base/module.h"
#include "view/picture_module.h"
#include "view/tone_map.h"

namespace shbake {
namespace {

decltype(&shbakeEncodePicture) encoder(const std::string& path) {
  static const ModuleFunction module =
      moduleFunction(SHBAKE_PICTURE_MODULE, SHBAKE_MODULE_FOLDER, "shbakeEncodePicture");
  if (module.address != nullptr) return reinterpret_cast<decltype(&shbakeEncodePicture)>(module.address);
  throw Error({.file = path,
               .cause = "the part of shbake that writes pictures cannot be loaded: " + module.problem,
               .remedy = "build shbake again with libopenimageio-dev installed, or install it whole"});
}

}  // namespace

PictureFormat pictureFormatOf(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension == ".png") return PictureFormat::png;
  if (extension == ".exr") return PictureFormat::exr;
  throw Error({.kind = ErrorKind::usage,
               .file = path,
               .cause = "'" + extension + "' is not a format of pictures that shbake writes",
               .remedy = "name it .png or .exr"});
}

void writePicture(const std::string& path, const Picture& picture) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  ShbakeRawPicture raw{picture.width, picture.height};
  std::vector<unsigned char> display;
  if (pictureFormatOf(path) == PictureFormat::png) {
    display.reserve(3 * picture.pixels.size());
    for (const Rgb& c : picture.pixels) {
      for (const float v : {c.x, c.y, c.z}) display.push_back(encodedByte(v));
    }
    raw.display = display.data();
  } else {
    raw.radiance = &picture.pixels.data()->x;
  }
  std::vector<unsigned char> bytes;
  std::string failure;
  encoder(path)(raw, bytes, failure);
  if (!failure.empty()) {
    throw Error({.file = path, .cause = "the picture cannot be encoded: " + failure, .remedy = "try the other format"});
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace shbake
