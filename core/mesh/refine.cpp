// Refinement of flat regions. Edges are divided first, each by itself, so that the faces on it agree; then each patch
// is triangulated between its divided edges. A patch that fails falls back to its single faces, and these to what they
// were; the edges concerned go back with them, until all agrees.
#include "mesh/refine.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/passes.h"
#include "mesh/flat_geometry.h"
#include "mesh/refine_attributes.h"
#include "mesh/refine_budget.h"
#include "mesh/refine_edges.h"
#include "mesh/refine_patch.h"

namespace shbake {
namespace {

class Refiner {
 public:
  Refiner(const Mesh& mesh, const FlatParts& parts, std::size_t maxVertices, const EdgeLength& length,
          const Parallel& parallel, Progress& progress)
      : mesh_(mesh),
        parts_(parts),
        edges_(parts.edges),
        regions_(parts.regions),
        length_(length),
        parallel_(parallel),
        progress_(progress),
        attributes_(mesh),
        budget_(mesh.source, mesh.positions.size(), maxVertices),
        patches_(parts.patches) {}

  RefinedMesh run() {
    if (regions_.count > 0) {
      divisions_.emplace(mesh_, edges_, patches_, length_);
      std::vector<std::uint32_t> work = patchesToMesh();
      progress_.begin("refining", 2 * budget_.expected(), "points");
      while (!work.empty()) {
        divideEdges(work);
        meshPatches(work);
        work = settleFailures(work);
      }
      progress_.end();
    }
    return assemble();
  }

 private:
  std::vector<std::uint32_t> patchesToMesh();
  void divideEdges(const std::vector<std::uint32_t>& work);
  void meshPatches(const std::vector<std::uint32_t>& work);
  std::vector<std::uint32_t> settleFailures(const std::vector<std::uint32_t>& work);
  void leave(std::uint32_t patch, std::vector<std::uint32_t>& again);
  RefinedMesh assemble();
  void appendPoints(RefinedMesh& out);
  std::uint32_t edgePoint(const PatchMesh::EdgePoint& point, std::vector<Blend>& blends, std::vector<Vec3d>& positions);
  void replaceFaces(RefinedMesh& out);
  void report(RefinedMesh& out) const;

  std::uint32_t vertexAt(std::uint32_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

  const Mesh& mesh_;
  const FlatParts& parts_;
  const EdgeTable& edges_;
  const FlatRegions& regions_;
  const EdgeLength& length_;
  const Parallel& parallel_;
  Progress& progress_;
  AttributeContinuity attributes_;
  RefineBudget budget_;
  FlatPatches patches_;       // taken apart where needed
  std::vector<bool> isFine_;  // patches whose edges are all short enough
  std::optional<EdgeDivisions> divisions_;
  std::vector<std::optional<PatchMesh>> results_;                 // of each patch; with faces where it is refined
  std::vector<std::uint32_t> left_;                               // faces that could not be refined
  std::unordered_map<std::uint32_t, std::uint32_t> firstOnSide_;  // new vertices on sides of faces: the first one
  std::vector<std::vector<std::uint32_t>> numbers_;               // of each patch's points, as vertices of the output
};

/// The patches with an edge that is too long, or with contact lines, in ascending order.
std::vector<std::uint32_t> Refiner::patchesToMesh() {
  // Faces 1, edges 1.
  Passes passes(progress_, "measuring edges", mesh_.triangles.size(), "faces", 2);
  passes.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
    if (regions_.ofFace[f] == FlatRegions::kNone) return;
    const FaceShape shape(mesh_, f);
    const Vec3d centre = (shape.corners[0] + shape.corners[1] + shape.corners[2]) * (1.0 / 3);
    double border = 0;
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (!isPatchBorder(edges_, patches_, attributes_, {3 * f + c})) continue;
      border += length(shape.corners[(c + 1) % 3] - shape.corners[c]);
    }
    budget_.expect(shape.area(), border, edgeLengthAt(mesh_, length_, f, centre));
  });
  budget_.checkExpected();
  isFine_.assign(patches_.size(), true);
  passes.forEach<std::uint32_t>(edges_.size(), [&](std::uint32_t e) {
    const auto inPatch = [this](FaceSide s) { return patches_.ofFace[s.face()] != FlatPatches::kNone; };
    const std::span<const FaceSide> sides = edges_[e];
    if (std::none_of(sides.begin(), sides.end(), inPatch) || !divisions_->isTooLong(e)) return;
    for (const FaceSide s : sides) {
      if (inPatch(s)) isFine_[patches_.ofFace[s.face()]] = false;
    }
  });
  passes.end();
  std::vector<std::uint32_t> work;
  for (std::uint32_t p = 0; p < patches_.size(); ++p) {
    if (!isFine_[p] || !parts_.contacts[p].empty()) work.push_back(p);
  }
  return work;
}

void Refiner::divideEdges(const std::vector<std::uint32_t>& work) {
  for (const std::uint32_t patch : work) {
    for (const std::uint32_t f : patches_[patch]) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        if (!isPatchBorder(edges_, patches_, attributes_, {3 * f + c})) continue;
        budget_.count(divisions_->divide(edges_.ofSide[3 * f + c], budget_.most()));
      }
    }
    progress_.advance(0);
  }
}

void Refiner::meshPatches(const std::vector<std::uint32_t>& work) {
  results_.resize(patches_.size());
  const PatchSource source{.mesh = mesh_,
                           .edges = edges_,
                           .patches = patches_,
                           .attributes = attributes_,
                           .divisions = *divisions_,
                           .length = length_,
                           .contacts = parts_.contacts,
                           .rowOffset = parts_.rowOffset,
                           .countNew =
                               [this](std::size_t points) {
                                 budget_.count(points);
                                 progress_.advance(static_cast<double>(points));
                               },
                           .countDone = [this](std::size_t points) { progress_.advance(static_cast<double>(points)); }};
  parallel_.forBlocks(work.size(), 1, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      // Faces that were one patch with others are made anew to agree with their neighbours.
      const bool rowsAlone = work[i] < isFine_.size() && isFine_[work[i]];
      results_[work[i]] = meshPatch(source, work[i], rowsAlone);
    }
    progress_.advance(0);
  });
}

/// Takes patches that failed apart, or leaves them. Returns the patches that must be meshed for it, or again.
std::vector<std::uint32_t> Refiner::settleFailures(const std::vector<std::uint32_t>& work) {
  std::vector<std::uint32_t> again;
  for (const std::uint32_t patch : work) {
    if (results_[patch]) continue;
    if (patches_[patch].size() == 1) {
      leave(patch, again);
      continue;
    }
    again.push_back(patch);
    for (std::size_t p = patches_.size(), end = p + patches_[patch].size() - 1; p < end; ++p) {
      again.push_back(static_cast<std::uint32_t>(p));
    }
    separateFaces(patches_, patch);
  }
  std::sort(again.begin(), again.end());
  again.erase(std::unique(again.begin(), again.end()), again.end());
  std::erase_if(again, [this](std::uint32_t patch) { return patches_.ofFace[patches_[patch][0]] != patch; });
  return again;
}

/// Keeps the only face of a patch and its edges as they are, and has the patches on these meshed again.
void Refiner::leave(std::uint32_t patch, std::vector<std::uint32_t>& again) {
  const std::uint32_t face = patches_[patch][0];
  patches_.ofFace[face] = FlatPatches::kNone;
  left_.push_back(face);
  for (std::uint32_t c = 0; c < 3; ++c) {
    const std::uint32_t edge = edges_.ofSide[3 * face + c];
    divisions_->keepWhole(edge);
    for (const FaceSide s : edges_[edge]) {
      const std::uint32_t other = patches_.ofFace[s.face()];
      if (other != FlatPatches::kNone) again.push_back(other);
    }
  }
}

RefinedMesh Refiner::assemble() {
  RefinedMesh out{mesh_, {}, {}};
  appendPoints(out);
  replaceFaces(out);
  report(out);
  return out;
}

/// Gives the new points of all patches their numbers, in the order of the patches: points on an edge once for each pair
/// of vertices that faces have at its ends.
void Refiner::appendPoints(RefinedMesh& out) {
  std::vector<Blend> blends;
  std::vector<Vec3d> positions;
  numbers_.resize(results_.size());
  for (std::size_t p = 0; p < results_.size(); ++p) {
    if (!results_[p] || results_[p]->faces.empty()) continue;
    const PatchMesh& patch = *results_[p];
    std::vector<std::uint32_t>& numbers = numbers_[p];
    numbers = patch.vertices;
    for (const PatchMesh::EdgePoint& point : patch.edgePoints) numbers.push_back(edgePoint(point, blends, positions));
    for (std::size_t i = 0; i < patch.innerBlends.size(); ++i) {
      numbers.push_back(static_cast<std::uint32_t>(mesh_.positions.size() + positions.size()));
      blends.push_back(patch.innerBlends[i]);
      positions.push_back(patch.innerPositions[i]);
    }
    progress_.advance(0);
  }
  budget_.check(mesh_.positions.size() + positions.size());
  appendVertices(out.mesh, blends, positions);
}

std::uint32_t Refiner::edgePoint(const PatchMesh::EdgePoint& point, std::vector<Blend>& blends,
                                 std::vector<Vec3d>& positions) {
  const FaceSide side{point.side};
  const std::uint32_t edge = edges_.ofSide[point.side];
  const auto [own, isNew] = firstOnSide_.try_emplace(point.side, 0);
  if (!isNew) return own->second + point.index;
  const auto endsOf = [this](FaceSide s) {
    const bool ascends = edges_.ascends(s);
    return std::array{vertexAt(ascends ? s.first() : s.second()), vertexAt(ascends ? s.second() : s.first())};
  };
  const auto [low, high] = endsOf(side);
  for (const FaceSide other : edges_[edge]) {
    if (other.side == side.side || endsOf(other) != std::array{low, high}) continue;
    const auto made = firstOnSide_.find(other.side);
    if (made != firstOnSide_.end()) return (own->second = made->second) + point.index;
  }
  own->second = static_cast<std::uint32_t>(mesh_.positions.size() + positions.size());
  for (const double share : divisions_->of(edge)) {
    blends.push_back({.a = low, .b = high, .c = low, .weightB = share});
    positions.push_back(divisions_->position(edge, share));
  }
  return own->second + point.index;
}

/// Puts new faces in the places of those that they come from.
void Refiner::replaceFaces(RefinedMesh& out) {
  const std::size_t faces = mesh_.triangles.size();
  std::vector<std::uint32_t> starts(faces + 1, 0);
  const auto refined = [this](std::size_t p) {
    return p < results_.size() && results_[p] && !results_[p]->faces.empty();
  };
  const auto isKept = [&](std::size_t f) {
    return patches_.ofFace.empty() || patches_.ofFace[f] == FlatPatches::kNone || !refined(patches_.ofFace[f]);
  };
  for (std::size_t f = 0; f < faces; ++f) starts[f + 1] = isKept(f);
  for (std::size_t p = 0; p < results_.size(); ++p) {
    if (!refined(p)) continue;
    for (const std::uint32_t f : results_[p]->sourceFace) ++starts[f + 1];
  }
  for (std::size_t f = 0; f < faces; ++f) starts[f + 1] += starts[f];
  std::vector<Triangle> triangles(starts[faces]);
  out.sourceFace.resize(starts[faces]);
  const auto place = [&](std::uint32_t source, const Triangle& t) {
    out.sourceFace[starts[source]] = source;
    triangles[starts[source]++] = t;
  };
  for (std::uint32_t f = 0; f < faces; ++f) {
    if (isKept(f)) place(f, mesh_.triangles[f]);
  }
  for (std::size_t p = 0; p < results_.size(); ++p) {
    if (!refined(p)) continue;
    const PatchMesh& patch = *results_[p];
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const auto& [a, b, c] = patch.faces[i];
      place(patch.sourceFace[i], {numbers_[p][a], numbers_[p][b], numbers_[p][c]});
    }
  }
  setFaces(out.mesh, mesh_, std::move(triangles), out.sourceFace);
}

void Refiner::report(RefinedMesh& out) const {
  RefineReport& r = out.report;
  r.regions = regions_.count;
  r.vertices = {mesh_.positions.size(), out.mesh.positions.size()};
  r.faces = {mesh_.triangles.size(), out.mesh.triangles.size()};
  std::vector<bool> isRefined(regions_.count);
  std::vector<UnrefinedRegion> unrefined(regions_.count);
  for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
    const double area = FaceShape(mesh_, f).area();
    r.area[0] += area;
    if (regions_.ofFace[f] == FlatRegions::kNone) continue;
    r.flatArea += area;
    ++r.flatFaces;
  }
  for (std::uint32_t f = 0; f < out.mesh.triangles.size(); ++f) r.area[1] += FaceShape(out.mesh, f).area();
  for (const std::optional<PatchMesh>& patch : results_) {
    if (patch && !patch->faces.empty()) isRefined[regions_.ofFace[patch->sourceFace[0]]] = true;
  }
  r.refined = static_cast<std::size_t>(std::count(isRefined.begin(), isRefined.end(), true));
  for (const std::uint32_t f : left_) {
    UnrefinedRegion& region = unrefined[regions_.ofFace[f]];
    region.firstFace = region.faces == 0 ? f : std::min(f, region.firstFace);
    ++region.faces;
  }
  for (UnrefinedRegion& region : unrefined) {
    if (region.faces == 0) continue;
    region.reason = "rounding new vertices to the precision of the file would turn triangles over";
    r.left.push_back(std::move(region));
  }
}

}  // namespace

RefinedMesh refineFlatParts(const Mesh& mesh, const FlatParts& parts, std::size_t maxVertices, const EdgeLength& length,
                            const Parallel& parallel, Progress& progress) {
  return Refiner(mesh, parts, maxVertices, length, parallel, progress).run();
}

RefinedMesh refineFlatRegions(const Mesh& mesh, const RefineOptions& options, const EdgeLength& length,
                              const Parallel& parallel, Progress& progress) {
  FlatParts parts = findFlatParts(mesh, {options.flatDegrees, options.creaseDegrees}, progress);
  addPatches(parts, mesh, progress);
  return refineFlatParts(mesh, parts, options.maxVertices, length, parallel, progress);
}

}  // namespace shbake
