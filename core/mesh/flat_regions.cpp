// Region growing on planes, as in T. Rabbani, F. van den Heuvel, G. Vosselman, "Segmentation of point clouds using
// smoothness constraint", ISPRS 2006, with the largest face in place of the least curved point.
#include "mesh/flat_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
// More than the rounding of a chord's square, relative to it.
constexpr double kRounding = 1e-9;
// More than the rounding of a face's normal, and of distances from a plane, in units in the last place of a double.
constexpr double kWorkUlps = 256;
// Flags of faces.
constexpr std::uint8_t kThin = 1, kTaken = 2;

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
        twiceFlat_(chordSquaredOf(2 * options.flatDegrees) * (1 + kRounding)),
        flatSine_(std::sin(options.flatDegrees * std::numbers::pi / 180)),
        crease_(chordSquaredOf(options.creaseDegrees)),
        progress_(progress),
        passes_(progress, "finding flat regions", mesh.triangles.size(), "faces", kPasses) {}

  FlatRegions run() {
    measureFaces();
    linkFaces();
    findSeeds();
    grow();
    judge();
    number();
    passes_.end();
    return std::move(regions_);
  }

 private:
  // Coordinates 1, normals 1, links 1, seeds 1, growing 1, borders 1, inner points 1, numbers 1.
  static constexpr int kPasses = 8;

  // What growing looks at, side by side: regions begin anywhere, and each look at memory afar takes as long as all
  // else.
  struct Face {
    Vec3d normal;  // unit; zero: it has no plane
    double area = 0;
    std::array<std::uint32_t, 3> neighbours{kNone, kNone, kNone};  // across each side, where a region may grow
    std::uint32_t region = kNone;

    bool hasPlane() const { return !(normal == Vec3d()); }
  };

  // Areas to single precision order faces as well as those to double.
  struct Seed {
    float area;
    std::uint32_t face;
  };

  // What tells a flat region from a part of a curved one.
  struct Evidence {
    double area = 0, squares = 0;  // of its faces, and of the chords of their deviations weighted by it
    bool roundedBorder = false;
    bool innerPoint = false;
  };

  void measureFaces();
  void linkFaces();
  void findSeeds();
  void findSeedsLinkedTo(std::uint32_t face);
  void grow();
  void growFrom(std::uint32_t seed);
  bool liesIn(std::uint32_t face, std::uint32_t seed) const;
  bool isCloseTo(std::uint32_t face, std::uint32_t seed) const;
  void judge();
  void judgeEdge(std::span<const FaceSide> sides, std::vector<bool>& onBorder);
  bool areAlike(FaceSide s, FaceSide t) const;
  bool isRounded(FaceSide s, FaceSide t) const;
  bool normalsGoOn(FaceSide s, FaceSide t) const;
  Vec3f fileNormal(std::uint32_t corner) const;
  void number();

  const Mesh& mesh_;
  const EdgeTable& edges_;
  double flat_, twiceFlat_;  // squares of chords
  double flatSine_;
  double crease_;  // square of a chord
  Progress& progress_;
  Passes passes_;
  FlatRegions regions_;
  std::vector<Face> faces_;
  std::vector<std::uint8_t> flags_;  // of each face: kThin, kTaken
  double largest_ = 0;               // of the areas
  std::vector<Seed> seeds_;
  std::vector<Evidence> evidence_;
  std::vector<std::uint32_t> front_;
};

void RegionFinder::measureFaces() {
  double farthest = 0;
  passes_.forEach(mesh_.positions.size(),
                  [&](std::size_t v) { farthest = std::max(farthest, magnitudeOf(mesh_.positions[v])); });
  // A face lies no nearer to a plane than this where it is turned from it by so much that its normal tells.
  const double nearest =
      2 * kPlaneUlps * coordinateUlp(mesh_, farthest) + kWorkUlps * std::numeric_limits<double>::epsilon() * farthest;
  faces_.resize(mesh_.triangles.size());
  flags_.assign(mesh_.triangles.size(), 0);
  passes_.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
    const FaceShape shape(mesh_, f);
    faces_[f].area = shape.area();
    largest_ = std::max(largest_, faces_[f].area);
    if (shape.height * flatSine_ <= nearest) flags_[f] |= kThin;
    if (shape.hasPlane()) faces_[f].normal = shape.normal();
  });
}

/// Finds the sides of faces across which a region may grow. Both faces of such a side lie in the region, each within
/// the angle of the seed's normal and so within twice that of the other's: on most scans few do. Only faces so thin
/// that they may lie within rounding of a plane from which they are turned by more are joined to all others.
void RegionFinder::linkFaces() {
  passes_.forEach(edges_.size(), [&](std::size_t e) {
    const std::span<const FaceSide> sides = edges_[e];
    if (sides.size() != 2 || edges_.ascends(sides[0]) == edges_.ascends(sides[1])) return;
    const std::uint32_t f = sides[0].face(), g = sides[1].face();
    Face &one = faces_[f], &other = faces_[g];
    if (!one.hasPlane() || !other.hasPlane()) return;
    if (chordSquared(one.normal, other.normal) > twiceFlat_ && ((flags_[f] | flags_[g]) & kThin) == 0) return;
    one.neighbours[sides[0].side % 3] = g;
    other.neighbours[sides[1].side % 3] = f;
  });
}

/// Faces are sorted, the largest first, among those that links join to each other: few at a time, which lie near each
/// other in memory too.
void RegionFinder::findSeeds() {
  passes_.forEach<std::uint32_t>(mesh_.triangles.size(), [&](std::uint32_t f) {
    if (faces_[f].hasPlane() && (flags_[f] & kTaken) == 0) findSeedsLinkedTo(f);
  });
}

void RegionFinder::findSeedsLinkedTo(std::uint32_t face) {
  const std::size_t first = seeds_.size();
  const auto take = [this](std::uint32_t f) {
    flags_[f] |= kTaken;
    seeds_.push_back({static_cast<float>(faces_[f].area / largest_), f});
  };
  take(face);
  for (std::size_t i = first; i < seeds_.size(); ++i) {
    if (i % kProgressBlock == 0) progress_.advance(0);
    for (const std::uint32_t g : faces_[seeds_[i].face].neighbours) {
      if (g != kNone && (flags_[g] & kTaken) == 0) take(g);
    }
  }
  sortCounted(progress_, seeds_.begin() + static_cast<std::ptrdiff_t>(first), seeds_.end(), 0,
              [](const Seed& s, const Seed& t) { return s.area != t.area ? s.area > t.area : s.face < t.face; });
}

void RegionFinder::grow() {
  passes_.forEach(seeds_.size(), [&](std::size_t i) {
    if (faces_[seeds_[i].face].region == kNone) growFrom(seeds_[i].face);
  });
}

void RegionFinder::growFrom(std::uint32_t seed) {
  const auto region = static_cast<std::uint32_t>(evidence_.size());
  const Vec3d normal = faces_[seed].normal;
  Evidence evidence;
  faces_[seed].region = region;
  front_.assign(1, seed);
  for (std::size_t faces = 1; !front_.empty(); ++faces) {
    if (faces % kProgressBlock == 0) progress_.advance(0);
    const Face& f = faces_[front_.back()];
    front_.pop_back();
    evidence.area += f.area;
    evidence.squares += f.area * chordSquared(normal, f.normal);
    for (const std::uint32_t g : f.neighbours) {
      if (g == kNone || faces_[g].region != kNone || !liesIn(g, seed)) continue;
      faces_[g].region = region;
      front_.push_back(g);
    }
  }
  evidence_.push_back(evidence);
}

/// The face is within the angle of the seed's plane; or within rounding of it, which may turn thin faces by more.
bool RegionFinder::liesIn(std::uint32_t face, std::uint32_t seed) const {
  if (chordSquared(faces_[seed].normal, faces_[face].normal) <= flat_) return true;
  return (flags_[face] & kThin) != 0 && isCloseTo(face, seed);
}

bool RegionFinder::isCloseTo(std::uint32_t face, std::uint32_t seed) const {
  const Vec3d normal = faces_[seed].normal, origin = mesh_.positions[mesh_.triangles[seed][0]];
  if (dot(normal, faces_[face].normal) <= 0) return false;
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
    if (faces_[f].region == kNone) return;
    for (const std::uint32_t p : edges_.faces[f]) {
      if (!onBorder[p]) evidence_[faces_[f].region].innerPoint = true;
    }
  });
}

void RegionFinder::judgeEdge(std::span<const FaceSide> sides, std::vector<bool>& onBorder) {
  const auto regionOf = [this](FaceSide s) { return faces_[s.face()].region; };
  const bool inside = sides.size() == 2 && regionOf(sides[0]) != kNone && regionOf(sides[0]) == regionOf(sides[1]) &&
                      areAlike(sides[0], sides[1]);
  if (inside) return;
  onBorder[edges_.pointAt(sides[0].first())] = onBorder[edges_.pointAt(sides[0].second())] = true;
  if (sides.size() != 2 || !isRounded(sides[0], sides[1])) return;
  for (const FaceSide s : sides) evidence_[regionOf(s)].roundedBorder = true;
}

/// The faces of an edge's two sides are wound alike, as those are that a region may grow across.
bool RegionFinder::areAlike(FaceSide s, FaceSide t) const {
  return faces_[s.face()].neighbours[s.side % 3] == t.face() || edges_.ascends(s) != edges_.ascends(t);
}

/// The surface goes on from one region to another across this edge with a bend that shading hides.
bool RegionFinder::isRounded(FaceSide s, FaceSide t) const {
  const Face &one = faces_[s.face()], &other = faces_[t.face()];
  if (!one.hasPlane() || !other.hasPlane() || one.region == other.region) return false;
  const bool alike = areAlike(s, t);
  const double bend = chordSquared(one.normal, alike ? other.normal : -other.normal);
  return bend <= crease_ && (alike || bend > flat_) && normalsGoOn(s, t);
}

bool RegionFinder::normalsGoOn(FaceSide s, FaceSide t) const {
  if (mesh_.vertexNormals.empty() && mesh_.cornerNormals.empty()) return true;
  const bool alike = areAlike(s, t);
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
  regions_.ofFace.reserve(faces_.size());
  passes_.forEach(faces_.size(), [&](std::size_t f) {
    const std::uint32_t region = faces_[f].region;
    if (region != kNone && flat[region] && numbers[region] == kNone) {
      numbers[region] = static_cast<std::uint32_t>(regions_.count++);
    }
    regions_.ofFace.push_back(region == kNone ? kNone : numbers[region]);
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
