#include "mesh/flat_parts.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/flat_geometry.h"
#include "mesh/work_frame.h"

namespace shbake {
namespace {

// What rows keep from the lines they run along: this share of half the mesh's largest extent, too little to be seen,
// and no less than so many units in the last place, which rays and contacts tell apart.
constexpr double kRowOffset = 0x1p-12, kRowUlps = 1024;

void checkIndices(const Mesh& mesh, Passes& passes) {
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (v < mesh.positions.size()) continue;
      throw Error({.file = mesh.source,
                   .place = "triangle " + std::to_string(f),
                   .cause = "vertex " + std::to_string(v) + " does not exist",
                   .remedy = "repair the mesh"});
    }
  });
  passes.forEach(mesh.positions.size(), [&](std::size_t v) {
    if (isFinite(mesh.positions[v])) return;
    throw Error({.file = mesh.source,
                 .place = "vertex " + std::to_string(v),
                 .cause = "it is not at a finite position",
                 .remedy = "repair the mesh"});
  });
}

double rowOffsetOf(const Mesh& mesh, Progress& progress) {
  Passes passes(progress, "measuring", mesh.triangles.size(), "faces", 1);
  const WorkFrame frame = workFrameOf(mesh, passes);
  passes.end();
  const double farthest = magnitudeOf(frame.centre) + 1 / frame.scale;
  return std::max(kRowOffset / frame.scale, kRowUlps * coordinateUlp(mesh, farthest));
}

}  // namespace

std::vector<bool> FlatParts::regionsInContact() const {
  std::vector<bool> inContact(regions.count, false);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!contacts[p].empty()) inContact[regions.ofFace[patches[p][0]]] = true;
  }
  return inContact;
}

FlatParts findFlatParts(const Mesh& mesh, const FlatOptions& options, Progress& progress) {
  // Indices 1, positions 1.
  Passes passes(progress, "edges", mesh.triangles.size(), "faces", 2 + kEdgeTablePasses);
  checkIndices(mesh, passes);
  FlatParts parts;
  parts.edges = edgeTableOf(mesh, passes);
  passes.end();
  parts.regions = findFlatRegions(mesh, parts.edges, options, progress);
  return parts;
}

void addPatches(FlatParts& parts, const Mesh& mesh, Progress& progress) {
  if (parts.regions.count == 0) return;
  parts.patches = findFlatPatches(mesh, parts.edges, parts.regions, progress);
  parts.contacts = findContactLines(mesh, parts.edges, parts.patches, progress);
  parts.rowOffset = rowOffsetOf(mesh, progress);
}

}  // namespace shbake
