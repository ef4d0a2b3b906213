// A bake that is told how good it has to be, and chooses all else.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "light/light.h"
#include "mesh/refine.h"
#include "pipeline/bake_mesh.h"

namespace shbake {

/// What becomes of the flat regions of a mesh before it is baked.
struct RefinementOptions {
  enum class Kind {
    none,       ///< they stay as they are
    length,     ///< edges of about `length` (mesh/refine.h)
    automatic,  ///< finer where the light on them changes (pipeline/auto_refine.h)
  };
  Kind kind = Kind::none;
  double length = 0;                                 ///< in file units, > 0; for Kind::length
  double flatDegrees = RefineOptions{}.flatDegrees;  ///< 0..45
  std::size_t maxVertices = 2'000'000;               ///< that the refined mesh may have
};

/// What a bake may choose by itself, and for what end.
struct AutoBakeOptions {
  /// The surface error to reach: RMS over the surface, relative to the unshadowed transfer, 0.0001..1. None: the rays
  /// are those of BakeOptions, and an automatic refinement aims at kDefaultTolerance.
  std::optional<double> tolerance;
  /// The kind of transfer may be replaced by a cheaper one that gives the same.
  bool transfer = false;
  RefinementOptions refinement;
  /// The light of the pictures, of LightOrder::kMost bands or more: no more bands are baked than it needs, by the
  /// tolerance. None: as many as BakeOptions::order says.
  std::optional<Light> light;

  static constexpr double kDefaultTolerance = 0.02;
};

/// One choice of a bake.
struct Choice {
  std::string what;    ///< "rays"
  std::string value;   ///< "240"
  std::string reason;  ///< what was measured, and what it saved: a clause
};

struct AutoBake {
  BakedMesh baked;  ///< `sourceVertex` is kNewVertex for vertices that refinement made
  std::vector<Choice> choices;
  /// The surface error is within the tolerance, or none was asked for. Where it is not, a warning of `baked` says why.
  bool met = true;
};

/// bakeMesh() with a refinement before it, for a tolerance of what is seen: with no more transfer, bands, vertices and
/// rays than that needs, as far as they are left open (options.bake.rays = 0 leaves the rays open). The result is
/// judged by its surface error, at options.surfaceSamples places or a number of its own choice. Throws as bakeMesh(),
/// refineFlatRegions() and refineWhereLightChanges(), and a usage error for a tolerance out of range.
AutoBake autoBake(Mesh mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& options,
                  const AutoBakeOptions& choose, const Parallel& parallel, Progress& progress);

}  // namespace shbake
