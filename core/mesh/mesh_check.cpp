#include "mesh/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/disjoint_sets.h"
#include "mesh/edge_groups.h"
#include "mesh/position_welder.h"

namespace shbake {

template <class Item>
void Finding<Item>::add(const Item& item) {
  ++count;
  if (examples.size() == kExamples && !(item < examples.back())) return;
  examples.insert(std::upper_bound(examples.begin(), examples.end(), item), item);
  if (examples.size() > kExamples) examples.pop_back();
}

template struct Finding<std::uint32_t>;
template struct Finding<std::array<std::uint32_t, 2>>;

namespace {

class Checker {
 public:
  Checker(const Mesh& mesh, Progress& progress)
      : mesh_(mesh), passes_(progress, "checking", mesh.triangles.size(), "faces", kPasses) {
    check_.vertices = mesh.positions.size();
    check_.faces = mesh.triangles.size();
  }

  MeshCheck run() {
    weld();
    checkFaces();
    checkDuplicateFaces();
    checkNormals();
    checkTopology();
    passes_.end();
    return std::move(check_);
  }

 private:
  // Weld 3, faces 1, duplicates 3, normals 2, edges 4 and 1, fans 1, parts 3.
  static constexpr int kPasses = 18;

  void weld();
  void checkFaces();
  void checkDuplicateFaces();
  void checkNormals();
  void checkTopology();
  void checkEdge(const EdgeGroups& edges, std::span<const FaceSide> sides);
  void checkFans(DisjointSets& fans);
  void checkParts(const EdgeGroups& edges, DisjointSets& parts);

  const Vec3d& position(std::uint32_t corner) const { return mesh_.positions[mesh_.triangles[corner / 3][corner % 3]]; }
  Vec3d areaVector(std::uint32_t face) const {
    const Vec3d& a = position(3 * face);
    return cross(position(3 * face + 1) - a, position(3 * face + 2) - a);
  }
  bool hasNoArea(std::uint32_t face) const;

  const Mesh& mesh_;
  Passes passes_;
  MeshCheck check_;
  std::vector<Triangle> faces_;  // of position numbers
};

void Checker::weld() {
  std::vector<bool> used(mesh_.positions.size());
  passes_.forEach(mesh_.triangles.size(), [&](std::size_t f) {
    for (const std::uint32_t v : mesh_.triangles[f]) used[v] = true;
  });
  std::vector<std::uint32_t> number;
  number.reserve(mesh_.positions.size());
  PositionWelder welder(mesh_.positions.size());
  passes_.forEach<std::uint32_t>(mesh_.positions.size(), [&](std::uint32_t v) {
    const std::size_t before = welder.positions().size();
    number.push_back(welder.add(mesh_.positions[v]));
    if (welder.positions().size() == before) check_.duplicatePositions.add(v);
    if (!used[v]) check_.isolatedVertices.add(v);
  });
  check_.positions = welder.positions().size();
  faces_.reserve(mesh_.triangles.size());
  passes_.forEach(mesh_.triangles.size(), [&](std::size_t f) {
    const Triangle& t = mesh_.triangles[f];
    faces_.push_back({number[t[0]], number[t[1]], number[t[2]]});
  });
}

/// The height over the longest side is no more than rounding the coordinates to double can make.
bool Checker::hasNoArea(std::uint32_t face) const {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  double longest = 0, largest = 0;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Vec3d &a = position(3 * face + c), &b = position(3 * face + (c + 1) % 3);
    longest = std::max(longest, length(b - a));
    largest = std::max({largest, std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  }
  return length(areaVector(face)) <= kRounding * largest * longest;
}

void Checker::checkFaces() {
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    if (repeatsPoint(faces_[f]) || hasNoArea(f)) check_.degenerateFaces.add(f);
  });
}

void Checker::checkDuplicateFaces() {
  struct Key {
    Triangle sorted;
    std::uint32_t face;
  };
  std::vector<Key> keys;
  keys.reserve(faces_.size());
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    if (repeatsPoint(faces_[f])) return;
    keys.push_back({faces_[f], f});
    std::sort(keys.back().sorted.begin(), keys.back().sorted.end());
  });
  passes_.sort(keys.begin(), keys.end(),
               [](const Key& a, const Key& b) { return a.sorted != b.sorted ? a.sorted < b.sorted : a.face < b.face; });
  passes_.forEach(keys.size(), [&](std::size_t i) {
    if (i > 0 && keys[i].sorted == keys[i - 1].sorted) check_.duplicateFaces.add(keys[i].face);
  });
}

void Checker::checkNormals() {
  check_.cornerNormals = !mesh_.cornerNormals.empty();
  const std::vector<Vec3f>& normals = check_.cornerNormals ? mesh_.cornerNormals : mesh_.vertexNormals;
  passes_.forEach<std::uint32_t>(normals.size(), [&](std::uint32_t i) {
    constexpr double kUnitTolerance = 0.01;  // normals kept in bytes are off by half a step of 1/127
    const double l = length(Vec3d(normals[i]));
    if (!(l > 0) || !std::isfinite(l)) {
      check_.zeroNormals.add(i);
    } else if (std::abs(l - 1) > kUnitTolerance) {
      check_.nonUnitNormals.add(i);
    }
  });
  if (normals.empty()) return;
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    Vec3d sum;
    for (std::uint32_t c = 0; c < 3; ++c) {
      sum += normalized(Vec3d(normals[check_.cornerNormals ? 3 * f + c : mesh_.triangles[f][c]]));
    }
    if (dot(sum, areaVector(f)) < 0) check_.opposingNormals.add(f);
  });
}

void Checker::checkTopology() {
  const EdgeGroups edges(faces_, check_.positions, passes_);
  DisjointSets fans(3 * faces_.size()), parts(faces_.size());
  edges.forEach(passes_, [&](std::span<const FaceSide> sides) {
    checkEdge(edges, sides);
    const bool up = edges.ascends(sides[0]);
    const std::uint32_t low = up ? sides[0].first() : sides[0].second();
    const std::uint32_t high = up ? sides[0].second() : sides[0].first();
    for (const FaceSide& s : sides.subspan(1)) {
      const bool sUp = edges.ascends(s);
      fans.unite(low, sUp ? s.first() : s.second());
      fans.unite(high, sUp ? s.second() : s.first());
      parts.unite(sides[0].face(), s.face());
    }
  });
  checkFans(fans);
  checkParts(edges, parts);
}

void Checker::checkEdge(const EdgeGroups& edges, std::span<const FaceSide> sides) {
  ++check_.edges;
  const auto vertex = [&](std::uint32_t corner) { return mesh_.triangles[corner / 3][corner % 3]; };
  const auto [a, b] = std::minmax({vertex(sides[0].first()), vertex(sides[0].second())});
  if (sides.size() == 1) check_.boundaryEdges.add({a, b});
  if (sides.size() > 2) check_.nonManifoldEdges.add({a, b});
  if (sides.size() == 2 && edges.ascends(sides[0]) == edges.ascends(sides[1])) check_.flippedEdges.add({a, b});
}

/// Each set of corners is one fan of faces around a position; the Euler characteristic falls out of the same count.
void Checker::checkFans(DisjointSets& fans) {
  std::vector<std::uint8_t> fansAt(check_.positions, 0);  // 0, 1, or 2 for more
  std::int64_t used = 0, counted = 0;
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    if (repeatsPoint(faces_[f])) return;
    ++counted;
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (fans.find(3 * f + c) != 3 * f + c) continue;
      std::uint8_t& n = fansAt[faces_[f][c]];
      used += n == 0;
      if (n == 1) check_.nonManifoldVertices.add(mesh_.triangles[f][c]);
      n = static_cast<std::uint8_t>(std::min(n + 1, 2));
    }
  });
  if (counted > 0 && check_.nonManifoldEdges.count == 0 && check_.nonManifoldVertices.count == 0) {
    check_.eulerCharacteristic = used - static_cast<std::int64_t>(check_.edges) + counted;
  }
}

void Checker::checkParts(const EdgeGroups& edges, DisjointSets& parts) {
  constexpr std::uint8_t kOpen = 1, kTurned = 2;
  std::vector<std::uint8_t> flags(faces_.size(), 0);
  edges.forEach(passes_, [&](std::span<const FaceSide> sides) {
    std::int64_t turns = 0;
    for (const FaceSide& s : sides) turns += edges.ascends(s) ? 1 : -1;
    std::uint8_t& flag = flags[parts.find(sides[0].face())];
    if (sides.size() % 2 != 0) flag |= kOpen;
    if (turns != 0) flag |= kTurned;
  });
  struct Volume {
    double sum = 0, magnitude = 0;  // six times the volume, and the sum of what its terms could be
  };
  std::vector<Volume> volumes(faces_.size());
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    const std::uint32_t part = parts.find(f);
    const Vec3d fromPart = position(3 * f) - position(3 * part), area = areaVector(f);
    volumes[part].sum += dot(fromPart, area);
    volumes[part].magnitude += length(fromPart) * length(area);
  });
  constexpr double kNoVolume = 1e-12;  // of the magnitude: a sheet folded onto itself has only rounding for a volume
  passes_.forEach<std::uint32_t>(faces_.size(), [&](std::uint32_t f) {
    if (parts.find(f) != f || repeatsPoint(faces_[f])) return;
    ++check_.parts;
    if (flags[f] & kOpen) return;
    ++check_.closedParts;
    check_.insideOutParts += !(flags[f] & kTurned) && volumes[f].sum < -kNoVolume * volumes[f].magnitude;
  });
}

}  // namespace

MeshCheck checkMesh(const Mesh& mesh, Progress& progress) {
  constexpr std::size_t kMostFaces = 1'400'000'000;
  if (mesh.triangles.size() > kMostFaces) {
    throw Error({.file = mesh.source,
                 .cause = "has " + std::to_string(mesh.triangles.size()) + " faces, more than can be checked",
                 .remedy = "split the mesh into parts"});
  }
  return Checker(mesh, progress).run();
}

}  // namespace shbake
