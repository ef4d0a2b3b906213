// The one function of the module that reads image files.
#pragma once

#include <string>

#include "light/map_rows.h"

/// Sets `rows` to what openMapFile() returns for a file that is there; throws what it throws.
extern "C" void shbakeOpenMapFile(const std::string& path, shbake::PixelEncoding encoding, int threads,
                                  shbake::MapRows& rows);
