// Light files (.shlight): light as JSON, with what it was made from.
#pragma once

#include <string>
#include <vector>

#include "light/environment_map.h"
#include "light/light.h"
#include "light/rig.h"

namespace shbake {

struct LightFile {
  Light light;
  UpAxis up = UpAxis::z;
  std::vector<std::string> sources;  ///< what it was made from, one sentence each
};

/// Lights at places of a scene (LightRig), all of one order.
struct RigFile {
  std::vector<LightSample> samples;
  RigOptions options;
  UpAxis up = UpAxis::z;             ///< of positions and lights alike
  std::vector<std::string> sources;  ///< what it was made from, one sentence each
};

/// True for a light file that holds a rig. Throws an Error naming the file when it is no light file at all.
bool isRigFile(const std::string& path);

/// Reads a light file. Throws an Error naming the file and the field for anything but exactly what writeLightFile()
/// writes: other fields, missing or contradictory ones, another basis, numbers that are not finite; a rig.
LightFile readLightFile(const std::string& path);
/// The same for a rig and writeRigFile().
RigFile readRigFile(const std::string& path);

/// Writes {"shbake_light": 1, "order": n, "basis": "real-orthonormal", "condon_shortley": false, "axes": "z-up" or
/// "y-up", "radiance": [[r, g, b], ... n^2 rows], "sources": [...]}; numbers in the shortest form that reads back to
/// the same double. The file appears whole or not at all.
void writeLightFile(const std::string& path, const LightFile& file);

/// Writes the same with "blend": "inverse-distance", "power": p or "blend": "barycentric", and "samples":
/// [{"position": [x, y, z], "radiance": [[r, g, b], ... n^2 rows]}, ...] in place of "radiance". Throws a usage error
/// for a rig without samples, of lights of several orders, or with numbers that are not finite.
void writeRigFile(const std::string& path, const RigFile& file);

/// The name of a way to blend samples in files and on the command line: "inverse-distance" or "barycentric".
const char* blendName(RigMethod method);

}  // namespace shbake
