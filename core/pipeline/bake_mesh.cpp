#include "pipeline/bake_mesh.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bake/baker.h"
#include "bake/surface_error.h"
#include "base/error.h"
#include "pipeline/scene_points.h"

namespace shbake {
namespace {

/// The output vertices that belong to the mesh itself, not to a blocker: indices into LightingPoints::outputPoint.
std::vector<std::uint32_t> ownOutputs(const LightingPoints& points, std::size_t ownVertices) {
  std::vector<std::uint32_t> own;
  for (std::size_t i = 0; i < points.outputPoint.size(); ++i) {
    if (points.outputSource[i] < ownVertices) own.push_back(static_cast<std::uint32_t>(i));
  }
  return own;
}

std::vector<std::uint8_t> wantedPoints(const LightingPoints& points, const std::vector<std::uint32_t>& outputs) {
  std::vector<std::uint8_t> wanted(points.size(), 0);
  for (const std::uint32_t i : outputs) {
    if (points.outputPoint[i] != LightingPoints::kNone) wanted[points.outputPoint[i]] = 1;
  }
  return wanted;
}

/// Repeats item `source` of a property for each appended vertex.
void splitProperty(Property& property, const std::vector<std::uint32_t>& appendedSources) {
  const std::size_t size = scalarSize(property.type);
  for (const std::uint32_t source : appendedSources) {
    const std::size_t first = property.isList ? property.listStarts[source] : source;
    const std::size_t last = property.isList ? property.listStarts[source + 1] : first + 1;
    const auto* data = property.values.data();
    const std::vector<std::byte> item(data + first * size, data + last * size);
    property.values.insert(property.values.end(), item.begin(), item.end());
    if (property.isList) property.listStarts.push_back(property.values.size() / size);
  }
}

/// Appends the vertices that were split off, with all that their source vertex carries, and points the faces at them.
void splitMesh(Mesh& mesh, const LightingPoints& points, const std::vector<std::uint32_t>& outputs) {
  const std::size_t vertices = mesh.positions.size();
  std::vector<std::uint32_t> sources;
  std::vector<std::uint32_t> renumbered(points.outputPoint.size(), LightingPoints::kNone);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    renumbered[outputs[i]] = static_cast<std::uint32_t>(i);
    if (i >= vertices) sources.push_back(points.outputSource[outputs[i]]);
  }
  for (const std::uint32_t v : sources) {
    mesh.positions.push_back(mesh.positions[v]);
    if (!mesh.vertexColors.empty()) mesh.vertexColors.push_back(mesh.vertexColors[v]);
  }
  for (Property& property : mesh.vertexProperties) splitProperty(property, sources);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) mesh.triangles[f][k] = renumbered[points.outputFaces[f][k]];
  }
}

/// Gives each output vertex the normal of its lighting point.
void setNormals(Mesh& mesh, const LightingPoints& points, const std::vector<std::uint32_t>& outputs) {
  mesh.cornerNormals.clear();
  mesh.vertexNormals.assign(outputs.size(), Vec3f());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::uint32_t p = points.outputPoint[outputs[i]];
    if (p != LightingPoints::kNone) mesh.vertexNormals[i] = points.pointNormal[p];
  }
}

/// One transfer vector for each output vertex. An isolated vertex gets zeros.
TransferSet expand(const TransferSet& baked, const LightingPoints& points, const std::vector<std::uint32_t>& outputs) {
  TransferSet out;
  out.order = baked.order;
  out.channels = baked.channels;
  const std::size_t stride = baked.stride();
  out.coefficients.resize(outputs.size() * stride);
  out.error.resize(outputs.size());
  out.visibility.resize(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::uint32_t p = points.outputPoint[outputs[i]];
    if (p == LightingPoints::kNone) continue;
    std::copy_n(&baked.coefficients[p * stride], stride, &out.coefficients[i * stride]);
    out.error[i] = baked.error[p];
    out.visibility[i] = baked.visibility[p];
  }
  return out;
}

AlbedoFacts describe(const Albedo& albedo, const AlbedoOptions& options) {
  AlbedoFacts facts;
  facts.origin = albedo.per == Albedo::Per::mesh     ? AlbedoOrigin::uniform
                 : albedo.per == Albedo::Per::vertex ? AlbedoOrigin::vertexColors
                                                     : AlbedoOrigin::faceColors;
  if (albedo.per == Albedo::Per::mesh) facts.uniform = albedo.values[0];
  facts.bytesAreLinear = options.bytesAreLinear;
  return facts;
}

TransferFacts describe(const PointBake& baked, const BakeOptions& options) {
  TransferFacts facts;
  facts.version = SHBAKE_VERSION;
  facts.kind = options.kind;
  facts.bounces = baked.bounces;
  facts.bouncesConverged =
      options.kind == TransferKind::interreflected && options.bounces == BakeOptions::kBouncesAuto && baked.converged;
  facts.rays = baked.rays;
  facts.seed = options.seed;
  facts.sampler = baked.rays > 0 ? "cosine-fibonacci" : "closed-form";
  facts.rmsError = baked.rmsError;
  facts.maxError = baked.maxError;
  facts.tolerance = options.rays == 0 ? options.tolerance : 0;
  facts.twoSided = options.twoSided;
  facts.maxDistance = options.maxDistance;
  return facts;
}

void warn(BakedMesh& result, const PointBake& baked, const LightingPoints& points,
          const std::vector<std::uint32_t>& outputs, const BakeOptions& options) {
  if (!baked.converged) {
    result.warnings.push_back("the reflections did not converge in " + std::to_string(baked.bounces) +
                              " steps: the mesh encloses light with an albedo too close to 1; lower the albedo");
  }
  if (baked.retracedPoints > 0) {
    result.warnings.push_back("the memory budget was short: " + std::to_string(baked.retracedPoints) +
                              " points were traced again for each reflection; with " +
                              std::to_string((baked.wantedMemory >> 20) + 1) + " MB none would be");
  }
  if (options.rays == 0 && baked.rmsError > options.tolerance) {
    result.warnings.push_back("the stated error is above the tolerance; ask for more rays");
  }
  const auto isolated = std::count_if(outputs.begin(), outputs.end(),
                                      [&](std::uint32_t i) { return points.outputPoint[i] == LightingPoints::kNone; });
  if (isolated > 0) {
    result.warnings.push_back(std::to_string(isolated) + " vertices belong to no face: their transfer is zero");
  }
}

}  // namespace

void validate(const Mesh& mesh, const BakeMeshOptions& options) {
  validate(options.bake);
  validate(options.fit);
  if (options.surfaceSamples > 0) validate(SurfaceErrorOptions{options.surfaceSamples});
  // Among blockers, nobody else would notice.
  if (mesh.triangles.empty()) {
    throw Error({.file = mesh.source, .cause = "the mesh has no faces", .remedy = "light is baked for surfaces only"});
  }
}

BakedMesh bakeMesh(Mesh mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& options,
                   const Parallel& parallel, Progress& progress) {
  validate(mesh, options);
  TracedScene scene(makeScenePoints(mesh, blockers, options.points, options.albedo, progress), parallel, progress);
  return bakeMesh(std::move(mesh), blockers.size(), scene, options, parallel, progress);
}

BakedMesh bakeMesh(Mesh mesh, std::size_t blockers, TracedScene& scene, const BakeMeshOptions& options,
                   const Parallel& parallel, Progress& progress) {
  validate(mesh, options);
  BakedMesh result;
  const std::size_t vertices = mesh.positions.size();
  LightingPoints& points = scene.points;
  TracedPoints& traced = scene.traced;
  result.albedoNote = scene.albedo.note;
  result.warnings = mesh.warnings;
  result.warnings.insert(result.warnings.end(), scene.albedo.warnings.begin(), scene.albedo.warnings.end());

  // The mesh's vertices in their order, then those that are split off; two copies of the faces are not needed.
  const std::vector<std::uint32_t> outputs = ownOutputs(points, vertices);
  splitMesh(mesh, points, outputs);
  const bool isLast = !traced.keepsForMore();
  if (isLast) points.outputFaces = std::vector<Triangle>();  // {} would keep the memory

  // Transfer of every lighting point.
  const std::vector<std::uint8_t> wanted = wantedPoints(points, outputs);
  const bool isMeasured = options.surfaceSamples > 0;
  traced.keepForMore(!isLast || isMeasured || options.fit.kind != FitKind::vertex);
  PointBake baked = bakePoints(traced, wanted, options.bake, parallel, progress);
  FitReport fit = fitToSurface(traced, wanted, baked, options.bake, options.fit, parallel, progress);
  if (isLast && !isMeasured) traced.free();

  // Back to the mesh.
  result.transfer = expand(baked.transfer, points, outputs);
  result.facts = describe(baked, options.bake);
  const FitFacts changed{fit.fittedPoints, fit.smoothedPoints, fit.before.rms, fit.after.rms};
  if (changed.any()) result.facts.fit = changed;
  if (options.fit.kind != FitKind::vertex) result.fit = std::move(fit);
  result.facts.albedo = describe(scene.albedo.albedo, options.albedo);
  result.facts.lightingPoints = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), 1));
  result.facts.sourceVertices = vertices;
  result.facts.blockers = blockers;
  result.facts.source = std::filesystem::path(mesh.source).filename().string();
  warn(result, baked, points, outputs, options.bake);
  setNormals(mesh, points, outputs);
  if (outputs.size() > vertices) {
    for (const std::uint32_t i : outputs) result.sourceVertex.push_back(points.outputSource[i]);
  }
  result.mesh = std::move(mesh);

  // What a viewer sees between the vertices.
  if (isMeasured) {
    BakeOptions done = options.bake;
    done.rays = baked.rays;
    const SurfaceErrorOptions surface{options.surfaceSamples, result.mesh.triangles.size(), options.surfaceRays};
    result.facts.surface = measureSurfaceError(traced, baked.transfer, done, surface, parallel, progress);
    if (result.facts.surface.samples == 0) {
      result.warnings.push_back("the surface error was not measured: no face has an area and reflects light");
    }
    if (isLast) traced.free();
  }
  return result;
}

}  // namespace shbake
