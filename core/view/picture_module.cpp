// The module that encodes pictures in memory, by OpenImageIO.
#include "view/picture_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

void shbakeEncodePicture(const ShbakeRawPicture& picture, std::vector<unsigned char>& bytes, std::string& failure) {
  const bool png = picture.display != nullptr;
  const std::string format = png ? "png" : "openexr";
  OIIO::ImageSpec spec(picture.width, picture.height, 3, png ? OIIO::TypeUInt8 : OIIO::TypeHalf);
  spec.attribute("oiio:ColorSpace", png ? "sRGB" : "Linear");
  // OpenImageIO would write the current time otherwise, and the same picture would give other bytes.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (png) spec.attribute("png:compressionLevel", 9);
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->supports("ioproxy")) {
    failure = "this OpenImageIO does not write " + format + " to memory";
    return;
  }
  output->set_ioproxy(&memory);
  const bool written = output->open("picture." + format, spec) &&
                       (png ? output->write_image(OIIO::TypeUInt8, picture.display)
                            : output->write_image(OIIO::TypeFloat, picture.radiance)) &&
                       output->close();
  if (!written) failure = output->geterror();
}
