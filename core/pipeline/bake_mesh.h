// The whole way from a mesh to its baked transfer in one function.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bake/bake_options.h"
#include "bake/surface_error.h"
#include "bake/surface_fit.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh.h"
#include "pipeline/albedo.h"
#include "pipeline/traced_scene.h"
#include "transfer/transfer_set.h"

namespace shbake {

struct BakeMeshOptions {
  LightingPointOptions points;
  AlbedoOptions albedo;
  BakeOptions bake;
  /// Whether vertices get their own transfer, as is the default, or what interpolates best between them.
  SurfaceFitOptions fit;
  /// Points at which the surface error is measured after the bake (bake/surface_error.h), 16..1048576; 0: it is not.
  std::size_t surfaceSamples = 0;
  TruthRays surfaceRays{};  ///< of each of them
};

/// A baked mesh, ready to be written: one transfer vector for each vertex of `mesh`.
struct BakedMesh {
  Mesh mesh;             ///< the input, with vertices split across creases appended, and with vertexNormals
  TransferSet transfer;  ///< as many points as mesh.positions
  std::vector<std::uint32_t> sourceVertex;  ///< the input's vertex behind each vertex; empty where they map 1:1
  TransferFacts facts;
  std::string albedoNote;             ///< what albedo was taken, for reports: "vertex colours, 8-bit sRGB decoded"
  std::optional<FitReport> fit;       ///< what the fit did and why; none where none was asked for
  std::vector<std::string> warnings;  ///< what the user should know, one sentence each
};

/// Bakes `mesh`. `blockers` occlude and reflect but get no points of their own in the result.
/// Throws Error: usage for options out of range, work for meshes without faces or too little memory, cancelled.
BakedMesh bakeMesh(Mesh mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& options,
                   const Parallel& parallel, Progress& progress);

/// The same where the lighting points are there: `scene` has what makeScenePoints() made of `mesh` and so many
/// blockers, with the same options. Where it is not kept for more (TracedPoints::keepForMore()), what has served is
/// freed on the way, and the scene is of no use afterwards.
BakedMesh bakeMesh(Mesh mesh, std::size_t blockers, TracedScene& scene, const BakeMeshOptions& options,
                   const Parallel& parallel, Progress& progress);

/// Throws a usage error for options out of range, a work error for a mesh without faces.
void validate(const Mesh& mesh, const BakeMeshOptions& options);

}  // namespace shbake
