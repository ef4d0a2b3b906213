// Patches of flat regions.
#include "mesh/flat_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/flat_geometry.h"

namespace shbake {
namespace {

constexpr std::uint32_t kNone = FlatPatches::kNone;

class PatchGrower {
 public:
  PatchGrower(const Mesh& mesh, const EdgeTable& edges, const FlatRegions& regions, Progress& progress)
      : mesh_(mesh),
        edges_(edges),
        regions_(regions),
        attributes_(mesh),
        progress_(progress),
        vertexOf_(edges.points),
        usedBy_(edges.points, kNone) {
    patches_.ofFace.assign(mesh.triangles.size(), kNone);
  }

  FlatPatches run() {
    // Areas 1, sorting 1, growing 1.
    Passes passes(progress_, "dividing regions into patches", mesh_.triangles.size(), "faces", 3);
    std::vector<std::pair<double, std::uint32_t>> seeds;
    passes.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
      if (regions_.ofFace[f] != FlatRegions::kNone) seeds.emplace_back(-FaceShape(mesh_, f).area(), f);
    });
    passes.sort(seeds.begin(), seeds.end(), [this](const auto& s, const auto& t) {
      return s.first != t.first ? s.first < t.first : precedes(s.second, t.second);
    });
    passes.forEach(seeds.size(), [&](std::size_t i) {
      if (patches_.ofFace[seeds[i].second] == kNone) growFrom(seeds[i].second);
    });
    passes.end();
    return std::move(patches_);
  }

 private:
  /// By their corners, whatever their numbers; faces with the same ones by number.
  bool precedes(std::uint32_t f, std::uint32_t g) const {
    const std::array<Vec3d, 3> p = FaceShape(mesh_, f).sortedCorners(), q = FaceShape(mesh_, g).sortedCorners();
    if (p == q) return f < g;
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end(), comesBefore);
  }

  void growFrom(std::uint32_t seed) {
    const auto patch = static_cast<std::uint32_t>(patches_.size());
    const FaceShape plane(mesh_, seed);
    const Vec3d normal = plane.normal();
    std::vector<std::uint32_t>& faces = patches_.faces;
    const auto take = [&](std::uint32_t face) {
      patches_.ofFace[face] = patch;
      faces.push_back(face);
      for (std::size_t k = 0; k < 3; ++k) {
        usedBy_[edges_.faces[face][k]] = patch;
        vertexOf_[edges_.faces[face][k]] = mesh_.triangles[face][k];
      }
    };
    const std::size_t begin = faces.size();
    take(seed);
    for (std::size_t next = begin; next < faces.size(); ++next) {
      if (next % kProgressBlock == 0) progress_.advance(0);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const FaceSide side{3 * faces[next] + c}, other{edges_.across(side)};
        if (other.side == kNone || patches_.ofFace[other.face()] != kNone) continue;
        if (regions_.ofFace[other.face()] != regions_.ofFace[seed]) continue;
        if (fits(other.face(), patch, plane, normal) && attributes_.goesOn(side, other)) take(other.face());
      }
    }
    patches_.ranges.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(faces.size())});
  }

  /// In the plane, facing the same way, and with no other vertex at a position of the patch.
  bool fits(std::uint32_t face, std::uint32_t patch, const FaceShape& plane, const Vec3d& normal) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = edges_.faces[face][k];
      if (usedBy_[point] == patch && vertexOf_[point] != mesh_.triangles[face][k]) return false;
    }
    const FaceShape shape(mesh_, face);
    const double most = kPlaneUlps * std::max(plane.ulp, shape.ulp);
    return dot(shape.areaVector, normal) > 0 &&
           std::all_of(shape.corners.begin(), shape.corners.end(),
                       [&](const Vec3d& p) { return std::abs(dot(normal, p - plane.corners[0])) <= most; });
  }

  const Mesh& mesh_;
  const EdgeTable& edges_;
  const FlatRegions& regions_;
  AttributeContinuity attributes_;
  Progress& progress_;
  FlatPatches patches_;
  std::vector<std::uint32_t> vertexOf_, usedBy_;  // of each point: the vertex and the patch that last took it
};

}  // namespace

FlatPatches findFlatPatches(const Mesh& mesh, const EdgeTable& edges, const FlatRegions& regions, Progress& progress) {
  return PatchGrower(mesh, edges, regions, progress).run();
}

bool isPatchBorder(const EdgeTable& edges, const FlatPatches& patches, const AttributeContinuity& attributes,
                   FaceSide side) {
  const FaceSide other{edges.across(side)};
  return other.side == EdgeTable::kNone || patches.ofFace[other.face()] != patches.ofFace[side.face()] ||
         !attributes.goesOn(side, other);
}

void separateFaces(FlatPatches& patches, std::uint32_t patch) {
  const auto [begin, end] = patches.ranges[patch];
  patches.ranges[patch].end = begin + 1;
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    patches.ofFace[patches.faces[i]] = static_cast<std::uint32_t>(patches.size());
    patches.ranges.push_back({i, i + 1});
  }
}

}  // namespace shbake
