// The material files of OBJ (MTL): the diffuse colour and its texture.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "base/vec3.h"

namespace shbake {

/// What shbake takes from a material of an MTL file.
struct ObjMaterial {
  std::string name;
  bool hasDiffuse = false;  ///< the file gives `Kd` as numbers
  Rgb diffuse{1, 1, 1};     ///< `Kd`, linear, 0..1
  std::string texture;      ///< the file named by `map_Kd`, as it stands there; or empty
};

/// Reads `newmtl`, `Kd` and `map_Kd`, and passes over all else. A line that cannot be understood adds a warning and is
/// left out: materials are no reason to refuse a mesh. Throws an Error when the file cannot be read.
std::vector<ObjMaterial> readObjMaterials(const std::string& path, Progress& progress,
                                          std::vector<std::string>& warnings);

}  // namespace shbake
