// Region growing on planes, as in T. Rabbani, F. van den Heuvel, G. Vosselman, "Segmentation of point clouds using
// smoothness constraint", ISPRS 2006, with the largest face in place of the least curved point.
#include "mesh/flat_regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "mesh/flat_geometry.h"

namespace shbake {
namespace {

constexpr std::uint32_t kNone = FlatRegions::kNone;
// Of faces spread evenly over a cone of half-angle a about a normal, the mean square deviation is a^2 / 2; of those of
// a cylinder, a^2 / 3.
constexpr double kFlatShare = 0.25;

// Angles between unit vectors are compared by the squares of their chords: exact for small ones, and without a root.
double chordSquared(const Vec3d& a, const Vec3d& b) {
  const Vec3d d = a - b;
  return dot(d, d);
}
double chordSquaredOf(double degrees) {
  const double chord = 2 * std::sin(degrees * std::numbers::pi / 360);
  return chord * chord;
}

class RegionFinder {
 public:
  RegionFinder(const Mesh& mesh, const EdgeTable& edges, const FlatOptions& options, Progress& progress)
      : mesh_(mesh),
        edges_(edges),
        flat_(chordSquaredOf(options.flatDegrees)),
        crease_(chordSquaredOf(options.creaseDegrees)),
        progress_(progress),
        passes_(progress, "finding flat regions", mesh.triangles.size(), "faces", kPasses) {}

  FlatRegions run() {
    measureFaces();
    grow();
    judge();
    number();
    passes_.end();
    return std::move(regions_);
  }

 private:
  // Normals 1, sorting 1, growing 1, borders 1, inner points 1, numbers 1.
  static constexpr int kPasses = 6;

  // What tells a flat region from a part of a curved one.
  struct Evidence {
    double area = 0, squares = 0;  // of its faces, and of the chords of their deviations weighted by it
    bool roundedBorder = false;
    bool innerPoint = false;
  };

  void measureFaces();
  void grow();
  void growFrom(std::uint32_t seed);
  bool liesIn(std::uint32_t face, std::uint32_t seed, const Vec3d& normal, const Vec3d& origin) const;
  void judge();
  void judgeEdge(std::span<const FaceSide> sides, std::vector<bool>& onBorder);
  bool isRounded(FaceSide s, FaceSide t) const;
  bool normalsGoOn(FaceSide s, FaceSide t) const;
  Vec3f fileNormal(std::uint32_t corner) const;
  void number();

  bool hasPlane(std::uint32_t face) const { return !(normals_[face] == Vec3d()); }

  const Mesh& mesh_;
  const EdgeTable& edges_;
  double flat_, crease_;  // squares of chords
  Progress& progress_;
  Passes passes_;
  FlatRegions regions_;
  std::vector<Vec3d> normals_;  // unit; zero for faces without a plane
  std::vector<double> areas_;
  double largest_ = 0;  // of the areas
  std::vector<Evidence> evidence_;
  std::vector<std::uint32_t> front_;
};

void RegionFinder::measureFaces() {
  normals_.resize(mesh_.triangles.size());
  areas_.resize(mesh_.triangles.size());
  passes_.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
    const FaceShape shape(mesh_, f);
    areas_[f] = length(shape.areaVector) / 2;
    largest_ = std::max(largest_, areas_[f]);
    if (shape.hasPlane()) normals_[f] = shape.normal();
  });
}

void RegionFinder::grow() {
  regions_.ofFace.assign(mesh_.triangles.size(), kNone);
  // Areas to single precision order them as well, and are sorted in half the time where they stand beside the numbers.
  struct Seed {
    float area;
    std::uint32_t face;
  };
  std::vector<Seed> seeds;
  for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
    if (hasPlane(f)) seeds.push_back({static_cast<float>(areas_[f] / largest_), f});
  }
  passes_.sort(seeds.begin(), seeds.end(),
               [](const Seed& s, const Seed& t) { return s.area != t.area ? s.area > t.area : s.face < t.face; });
  passes_.forEach(seeds.size(), [&](std::size_t i) {
    if (regions_.ofFace[seeds[i].face] == kNone) growFrom(seeds[i].face);
  });
}

void RegionFinder::growFrom(std::uint32_t seed) {
  const auto region = static_cast<std::uint32_t>(evidence_.size());
  const Vec3d normal = normals_[seed], origin = mesh_.positions[mesh_.triangles[seed][0]];
  Evidence evidence;
  regions_.ofFace[seed] = region;
  front_.assign(1, seed);
  for (std::size_t faces = 1; !front_.empty(); ++faces) {
    if (faces % kProgressBlock == 0) progress_.advance(0);
    const std::uint32_t f = front_.back();
    front_.pop_back();
    evidence.area += areas_[f];
    evidence.squares += areas_[f] * chordSquared(normal, normals_[f]);
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t side = edges_.across({3 * f + c});
      if (side == kNone || regions_.ofFace[side / 3] != kNone) continue;
      if (!liesIn(side / 3, seed, normal, origin)) continue;
      regions_.ofFace[side / 3] = region;
      front_.push_back(side / 3);
    }
  }
  evidence_.push_back(evidence);
}

/// The face is within the angle of the seed's plane; or within rounding of it, which may turn thin faces by more.
bool RegionFinder::liesIn(std::uint32_t face, std::uint32_t seed, const Vec3d& normal, const Vec3d& origin) const {
  if (!hasPlane(face)) return false;
  if (chordSquared(normal, normals_[face]) <= flat_) return true;
  if (dot(normal, normals_[face]) <= 0) return false;
  double magnitude = 0, farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& p = mesh_.positions[mesh_.triangles[face][k]];
    magnitude = std::max({magnitude, magnitudeOf(p), magnitudeOf(mesh_.positions[mesh_.triangles[seed][k]])});
    farthest = std::max(farthest, std::abs(dot(normal, p - origin)));
  }
  return farthest <= kPlaneUlps * coordinateUlp(mesh_, magnitude);
}

void RegionFinder::judge() {
  std::vector<bool> onBorder(edges_.points);
  passes_.forEach(edges_.size(), [&](std::size_t e) { judgeEdge(edges_[e], onBorder); });
  passes_.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
    if (regions_.ofFace[f] == kNone) return;
    for (const std::uint32_t p : edges_.faces[f]) {
      if (!onBorder[p]) evidence_[regions_.ofFace[f]].innerPoint = true;
    }
  });
}

void RegionFinder::judgeEdge(std::span<const FaceSide> sides, std::vector<bool>& onBorder) {
  const auto regionOf = [this](FaceSide s) { return regions_.ofFace[s.face()]; };
  const bool inside = sides.size() == 2 && regionOf(sides[0]) != kNone && regionOf(sides[0]) == regionOf(sides[1]) &&
                      edges_.ascends(sides[0]) != edges_.ascends(sides[1]);
  if (inside) return;
  onBorder[edges_.pointAt(sides[0].first())] = onBorder[edges_.pointAt(sides[0].second())] = true;
  if (sides.size() != 2 || !isRounded(sides[0], sides[1])) return;
  for (const FaceSide s : sides) evidence_[regionOf(s)].roundedBorder = true;
}

/// The surface goes on from one region to another across this edge with a bend that shading hides.
bool RegionFinder::isRounded(FaceSide s, FaceSide t) const {
  if (!hasPlane(s.face()) || !hasPlane(t.face()) || regions_.ofFace[s.face()] == regions_.ofFace[t.face()])
    return false;
  const bool alike = edges_.ascends(s) != edges_.ascends(t);
  const double bend = chordSquared(normals_[s.face()], alike ? normals_[t.face()] : -normals_[t.face()]);
  return bend <= crease_ && (alike || bend > flat_) && normalsGoOn(s, t);
}

bool RegionFinder::normalsGoOn(FaceSide s, FaceSide t) const {
  if (mesh_.vertexNormals.empty() && mesh_.cornerNormals.empty()) return true;
  const bool alike = edges_.ascends(s) != edges_.ascends(t);
  const std::uint32_t first = alike ? t.second() : t.first(), second = alike ? t.first() : t.second();
  const auto agree = [&](std::uint32_t a, std::uint32_t b) {
    return chordSquared(normalized(Vec3d(fileNormal(a))), normalized(Vec3d(fileNormal(b)))) <= flat_;
  };
  return agree(s.first(), first) && agree(s.second(), second);
}

Vec3f RegionFinder::fileNormal(std::uint32_t corner) const {
  if (!mesh_.cornerNormals.empty()) return mesh_.cornerNormals[corner];
  return mesh_.vertexNormals[mesh_.triangles[corner / 3][corner % 3]];
}

void RegionFinder::number() {
  std::vector<std::uint32_t> numbers(evidence_.size(), kNone);
  std::vector<bool> flat(evidence_.size());
  for (std::size_t r = 0; r < evidence_.size(); ++r) {
    const Evidence& e = evidence_[r];
    flat[r] = !e.roundedBorder || (e.innerPoint && e.squares <= kFlatShare * kFlatShare * flat_ * e.area);
  }
  passes_.forEach(mesh_.triangles.size(), [&](std::size_t f) {
    std::uint32_t& region = regions_.ofFace[f];
    if (region == kNone) return;
    if (flat[region] && numbers[region] == kNone) numbers[region] = static_cast<std::uint32_t>(regions_.count++);
    region = numbers[region];
  });
}

void checkAngles(const FlatOptions& options) {
  if (!(options.flatDegrees >= 0 && options.flatDegrees <= 45)) {
    throw usageError("flat faces are to deviate by " + std::to_string(options.flatDegrees) + " degrees",
                     "give an angle from 0 to 45");
  }
  if (!(options.creaseDegrees >= 0 && options.creaseDegrees <= 180)) {
    throw usageError("the crease angle is " + std::to_string(options.creaseDegrees) + " degrees",
                     "give an angle from 0 to 180");
  }
}

}  // namespace

FlatRegions findFlatRegions(const Mesh& mesh, const EdgeTable& edges, const FlatOptions& options, Progress& progress) {
  checkAngles(options);
  return RegionFinder(mesh, edges, options, progress).run();
}

}  // namespace shbake
