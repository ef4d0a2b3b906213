// Pictures to files.
#pragma once

#include <string>

#include "view/picture.h"

namespace shbake {

/// What a file's extension asks for.
enum class PictureFormat {
  png,  ///< 8-bit sRGB of display light
  exr,  ///< half floats, linear, as they are
};

/// Throws a usage error naming the file for any extension but .png and .exr.
PictureFormat pictureFormatOf(const std::string& path);

/// Writes a picture that appears whole or not at all, with nothing in it but pixels: the same pixels give the same
/// bytes. Throws what pictureFormatOf() and AtomicFile throw.
void writePicture(const std::string& path, const Picture& picture);

}  // namespace shbake
