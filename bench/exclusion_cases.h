// Small scenes in which what a ray leaves out decides, and whose answer is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/lighting_points.h"

namespace shbake::bench {

struct ExclusionCase {
  std::string name;    ///< for tables
  std::string detail;  ///< what is where
  LightingPoints points;
  std::vector<std::uint32_t> judged;  ///< the points whose answer is known
  double truth;                       ///< the share of the sky that each of them sees
};

/// A lid close above a vertex, a tilted box that stands on the ground, a closed room.
std::vector<ExclusionCase> exclusionCases();

}  // namespace shbake::bench
