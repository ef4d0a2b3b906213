// The one function of the module that encodes pictures.
#pragma once

#include <string>
#include <vector>

/// A picture as the module takes it: one of the two arrays is set, three values a pixel.
struct ShbakeRawPicture {
  int width = 0, height = 0;
  const unsigned char* display = nullptr;  ///< sRGB, for a PNG file
  const float* radiance = nullptr;         ///< for an OpenEXR file of half floats
};

/// Sets `bytes` to the file's, or `failure` to what went wrong.
extern "C" void shbakeEncodePicture(const ShbakeRawPicture& picture, std::vector<unsigned char>& bytes,
                                    std::string& failure);
