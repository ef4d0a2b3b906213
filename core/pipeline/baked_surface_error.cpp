// The surface error of a baked file: its lighting points and its bake, made again from the file.
#include "pipeline/baked_surface_error.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bake/surface_error.h"
#include "base/error.h"
#include "transfer/baked_albedo.h"

namespace shbake {
namespace {

[[noreturn]] void fail(const BakedPly& baked, std::string cause, std::string remedy) {
  throw Error({.file = baked.mesh.source, .cause = std::move(cause), .remedy = std::move(remedy)});
}

/// The options of the bake that the facts state.
BakeOptions optionsOf(const BakedPly& baked) {
  const TransferFacts& facts = baked.facts;
  const bool traced = facts.kind != TransferKind::unshadowed;
  const char* const sampler = traced ? "cosine-fibonacci" : "closed-form";
  BakeOptions options;
  options.kind = facts.kind;
  options.order = baked.transfer.order;
  options.rays = facts.rays;
  options.bounces = facts.bouncesConverged ? BakeOptions::kBouncesAuto : facts.bounces;
  options.twoSided = facts.twoSided;
  options.maxDistance = facts.maxDistance;
  options.seed = facts.seed;
  if (!baked.stated || facts.sampler != sampler || (traced && facts.rays == 0)) {
    fail(baked, "does not tell how it was baked, so that its transfer cannot be traced between the vertices",
         "bake the mesh with shbake bake --surface-error");
  }
  try {
    validate(options);
  } catch (const Error& error) {
    fail(baked, "cannot have been baked as it states: " + error.parts().cause, "correct the comments of its header");
  }
  return options;
}

std::vector<Rgb> albedoOf(const BakedPly& baked) {
  const bool left = !baked.facts.albedo.included && baked.facts.kind == TransferKind::interreflected;
  const std::optional<std::vector<Rgb>> albedo = bakedAlbedo(baked);
  if (left || !albedo) {
    fail(baked, "does not tell the albedo that it was baked with", "bake the mesh with shbake bake --surface-error");
  }
  return *albedo;
}

/// The transfer of each lighting point: that of a vertex which became it.
TransferSet transferOf(const LightingPoints& points, const TransferSet& vertices) {
  TransferSet set;
  set.order = vertices.order;
  set.channels = vertices.channels;
  set.coefficients.resize(points.size() * vertices.stride());
  for (std::size_t i = 0; i < points.outputPoint.size(); ++i) {
    if (points.outputPoint[i] == LightingPoints::kNone) continue;
    std::copy_n(&vertices.coefficients[points.outputSource[i] * vertices.stride()], vertices.stride(),
                &set.coefficients[points.outputPoint[i] * vertices.stride()]);
  }
  return set;
}

}  // namespace

SurfaceError measureSurfaceError(const BakedPly& baked, std::size_t samples, const Parallel& parallel,
                                 Progress& progress) {
  validate(SurfaceErrorOptions{samples});
  const BakeOptions options = optionsOf(baked);
  if (baked.facts.blockers > 0) {
    fail(baked, "was baked beside " + std::to_string(baked.facts.blockers) + " blockers, which it does not hold",
         "measure while baking: shbake bake --blockers ... --surface-error");
  }
  Albedo albedo;
  albedo.per = Albedo::Per::vertex;
  albedo.values = albedoOf(baked);
  LightingPoints points = makeLightingPoints(baked.mesh, {}, albedo, progress);
  const bool hasColor = std::any_of(points.pointAlbedo.begin(), points.pointAlbedo.end(), isColored);
  if (baked.transfer.channels != (hasColor ? 3 : 1)) {
    fail(baked, hasColor ? "has one channel, but colours as albedo" : "has three channels, but grey albedo",
         "bake the mesh with shbake bake --surface-error");
  }
  const TransferSet transfer = transferOf(points, baked.transfer);
  TracedPoints traced(points, parallel, progress);
  traced.keepForMore(true);
  return measureSurfaceError(traced, transfer, options, {samples}, parallel, progress);
}

}  // namespace shbake
