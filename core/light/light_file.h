// Light files (.shlight): light as JSON, with what it was made from.
#pragma once

#include <string>
#include <vector>

#include "light/environment_map.h"
#include "light/light.h"

namespace shbake {

struct LightFile {
  Light light;
  UpAxis up = UpAxis::z;
  std::vector<std::string> sources;  ///< what it was made from, one sentence each
};

/// Reads a light file. Throws an Error naming the file and the field for anything but exactly what writeLightFile()
/// writes: other fields, missing or contradictory ones, another basis, numbers that are not finite.
LightFile readLightFile(const std::string& path);

/// Writes {"shbake_light": 1, "order": n, "basis": "real-orthonormal", "condon_shortley": false, "axes": "z-up" or
/// "y-up", "radiance": [[r, g, b], ... n^2 rows], "sources": [...]}; numbers in the shortest form that reads back to
/// the same double. The file appears whole or not at all.
void writeLightFile(const std::string& path, const LightFile& file);

}  // namespace shbake
