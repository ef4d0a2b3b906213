// Refinement of flat regions where the light on them changes, and nowhere else.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bake/bake_options.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "mesh/refine.h"
#include "pipeline/albedo.h"
#include "pipeline/traced_scene.h"

namespace shbake {

struct AutoRefineOptions {
  /// The surface error that interpolation alone may leave: RMS over the surface, relative to the unshadowed transfer,
  /// 0.0001..1.
  double target = 0.02;
  /// What is flat, degrees: RefineOptions::flatDegrees.
  double flatDegrees = RefineOptions().flatDegrees;
  /// Vertices that the refined mesh may have.
  std::size_t maxVertices = std::numeric_limits<std::uint32_t>::max();
};

/// Why refinement ended.
enum class RefineEnd {
  met,        ///< the error of interpolation is within the target
  flatDone,   ///< what is left above the target lies on curved faces
  noFlat,     ///< there is no flat region
  flatFine,   ///< flat regions are a small part of the surface and miss too little to matter; the rest was not judged
  budget,     ///< the next step would have taken more vertices than allowed
  noProgress  ///< more vertices no longer lower the error
};

struct AutoRefinement {
  RefinedMesh refined;
  RefineEnd end = RefineEnd::met;
  int rounds = 0;       ///< meshes that were judged
  double before = 0;    ///< error of interpolation of the mesh as it was: an estimate from samples
  double after = 0;     ///< the same of the refined mesh
  double shortest = 0;  ///< the shortest edges that were asked for, in file units; 0: none
  /// The lighting points of the refined mesh, kept for more, for as long as `parallel` and `progress` live; null where
  /// the mesh is as it was.
  std::unique_ptr<TracedScene> scene;
  double curved = 0;  ///< the part of `after` that curved faces have: after^2 = flat^2 + curved^2
};

/// Divides flat regions of `mesh` until interpolation between its vertices errs by no more than the target, as far as
/// flat regions can mend it. Each round draws places on the surface, measures there what interpolation misses
/// (bake/interpolation_error.h), and asks for finer edges around the places that miss most, as few as lower the error
/// enough (Doerfler 1996, "A convergent adaptive algorithm for Poisson's equation": the smallest set with a fixed share
/// of the error). `scene` has what makeScenePoints() made of mesh and blockers; what it is traced in serves the bake to
/// come where it is kept for more and nothing is refined. `bake` has the options of that bake, but for its number of
/// rays. Throws as refineFlatRegions() and bakePoints(), and a usage error when the target
/// is out of range.
AutoRefinement refineWhereLightChanges(const Mesh& mesh, const std::vector<Mesh>& blockers, TracedScene& scene,
                                       const LightingPointOptions& points, const AlbedoOptions& albedo,
                                       const BakeOptions& bake, const AutoRefineOptions& options,
                                       const Parallel& parallel, Progress& progress);

}  // namespace shbake
