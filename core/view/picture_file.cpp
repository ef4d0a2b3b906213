// Pictures to files, encoded by a module that is loaded for the first of them.
#include "view/picture_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "view/picture_module.h"
#include "view/tone_map.h"

namespace shbake {
namespace {

/// The module's function. It stays loaded.
decltype(&shbakeEncodePicture) encoder() {
  static void* const module = ::dlopen(SHBAKE_PICTURE_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* const symbol = module == nullptr ? nullptr : ::dlsym(module, "shbakeEncodePicture");
  if (symbol != nullptr) return reinterpret_cast<decltype(&shbakeEncodePicture)>(symbol);
  const char* const reason = ::dlerror();
  throw Error({.file = SHBAKE_PICTURE_MODULE,
               .cause = std::string("this part of shbake cannot be loaded: ") + (reason ? reason : "no reason is told"),
               .remedy = "build shbake again, or install it whole"});
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
  encoder()(raw, bytes, failure);
  if (!failure.empty()) {
    throw Error({.file = path, .cause = "the picture cannot be encoded: " + failure, .remedy = "try the other format"});
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace shbake
