// What a baked layer remembers beside its coefficients: kept with the mesh as one attribute.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "shbake.h"

namespace shbake::meshlab {

struct BakeRecord {
  int order = 0, channels = 1;
  bool hasError = false, hasVisibility = false, hasSource = false;
  std::uint64_t number = 0;  ///< another one for each bake of this process
  TransferFacts facts;
  std::vector<std::string> comments;   ///< other comments of the file that the layer was read from
  std::array<double, 16> transform{};  ///< the layer's at the time of the bake, row by row
  double facing = 0;                   ///< how far faces and stored normals agreed then: -1..1 (bridge_attributes.cpp)
  bool hasOwnColors = false;           ///< the layer has colours of its own that shbake's hide
  /// Hashes of all vertex colours that shbake has shown. MeshLab's preview brings earlier ones back.
  std::set<std::uint64_t> shown;
};

}  // namespace shbake::meshlab
