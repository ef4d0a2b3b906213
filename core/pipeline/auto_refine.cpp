#include "pipeline/auto_refine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "bake/interpolation_error.h"
#include "bake/surface_places.h"
#include "base/error.h"
#include "base/hash.h"
#include "pipeline/length_field.h"

namespace shbake {
namespace {

constexpr int kMostRounds = 24;
/// Rays of a probe. Their noise cancels in the mean; they only have to tell strong errors from none.
constexpr int kCoarseRays = 32, kFineRays = 64;
constexpr double kFineTarget = 0.01;
/// The estimate of the squared error scatters by this share.
constexpr double kScatter = 0.05;
/// Places that find an error of 1 on a share target^2 of the surface this often, which is as much as may be left.
constexpr double kFinds = 16;
constexpr double kLeastPlaces = 4096, kMostPlaces = 65536;
/// Places on each face that the last round divided and on others that are divided, and all of them together at most.
constexpr double kPlacesOnYoung = 2, kPlacesOnOld = 0.5, kMostExtraPlaces = 131072;
/// Where the square of the error is this many times the target's, edges are quartered instead of halved: at the edge of
/// a shadow it falls with the edges' length.
constexpr double kQuarterFrom = 6;
/// Curved faces are not divided. What flat ones add to their squared error may be this much of it: the whole is then 5
/// % above what vertices on flat faces cannot lower.
constexpr double kBesideCurved = 0.1;
/// A round asks for no more than this share of the squared error, so that its places can tell what the next has to do,
/// and for no less than that, so that the last rounds do not creep.
constexpr double kMostShare = 0.9, kLeastShare = 0.2;
/// The share of a cell's squared error that finer edges take away at least: halved ones half of it at the edge of a
/// shadow, which wins over what is gained elsewhere.
constexpr double kGain = 0.4;
/// A round that lowers the squared error by less than this share has gained nothing,
constexpr double kLeastGain = 0.1;
/// and after this many such rounds there is nothing to gain.
constexpr int kPatience = 3;

/// Flat regions below this share of the surface are first judged by themselves, at this many places,
constexpr double kFewFlat = 0.05;
constexpr std::size_t kGlancePlaces = 512;
/// and left as they are where they have no more than this share of the squared error that may be left.
constexpr double kGlanceShare = 0.1;

/// The streams of random numbers that the next round's seed and that of a glance are taken from.
constexpr std::uint64_t kNextRound = 1, kGlance = 2;

/// What interpolation misses at a place of a flat face.
struct Miss {
  std::uint32_t region;
  std::uint32_t level;  // of the edges there
  Vec3d position;
  double share;  // of the mesh's squared error; as likely too low as too high
};

double longestEdge(const Mesh& mesh, std::uint32_t face) {
  const Triangle& t = mesh.triangles[face];
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, length(mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]));
  }
  return longest;
}

double areaOf(const Mesh& mesh, std::uint32_t face) {
  const Triangle& t = mesh.triangles[face];
  const Vec3d& a = mesh.positions[t[0]];
  return length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2;
}

Vec3d middleOf(const Mesh& mesh, std::uint32_t face) {
  const Triangle& t = mesh.triangles[face];
  return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.0 / 3);
}

/// A place in file units.
Vec3d placeOn(const LightingPoints& points, const SurfacePlace& place) {
  Vec3d sum;
  for (std::size_t k = 0; k < 3; ++k) sum += Vec3d(points.positions[points.faces[place.face][k]]) * place.weights[k];
  return points.frame.toFile(sum);
}

LengthField fieldAround(const Mesh& mesh) {
  Vec3d low = mesh.positions[mesh.triangles[0][0]], high = low;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      const Vec3d& p = mesh.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  const Vec3d extent = high - low;
  const double size = std::max({extent.x, extent.y, extent.z});
  return LengthField(low, size > 0 ? size : 1);
}

class AutoRefiner {
 public:
  AutoRefiner(const Mesh& mesh, const std::vector<Mesh>& blockers, TracedScene& scene,
              const LightingPointOptions& points, const AlbedoOptions& albedo, const BakeOptions& bake,
              const AutoRefineOptions& options, const Parallel& parallel, Progress& progress)
      : mesh_(mesh),
        blockers_(blockers),
        scene_(scene),
        pointOptions_(points),
        albedo_(albedo),
        probe_(bake),
        options_(options),
        parallel_(parallel),
        progress_(progress),
        field_(fieldAround(mesh)),
        before_(field_) {
    probe_.rays = options.target < kFineTarget ? kFineRays : kCoarseRays;
    // Senders that have all reflections, so that places receive as many as vertices.
    if (probe_.bounces > 0) probe_.bounces = BakeOptions::kBouncesAuto;
  }

  AutoRefinement run() {
    result_.refined = unrefined();
    parts_ = findFlatParts(mesh_, {options_.flatDegrees, pointOptions_.creaseDegrees}, progress_);
    if (parts_.regions.count == 0) {
      result_.end = RefineEnd::noFlat;
      return std::move(result_);
    }
    if (!flatPartsMatter()) {
      result_.end = RefineEnd::flatFine;
      return std::move(result_);
    }
    addPatches(parts_, mesh_, progress_);
    int idle = 0;
    double last = 0;
    for (;;) {
      probe();
      const double square = flat_ + curved_;
      result_.after = std::sqrt(std::max(0.0, square));
      result_.curved = std::sqrt(std::max(0.0, curved_));
      if (result_.rounds++ == 0) result_.before = result_.after;
      const double target = options_.target * options_.target;
      // What flat regions may leave: the rest of the target, but where curved faces have taken that already, as much as
      // their share of the surface, and where these alone err more, as hardly shows beside that.
      const double curved = std::max(0.0, curved_);
      const double beside = curved > (1 + kScatter) * target ? kBesideCurved * curved : 0;
      const double flatTarget = std::max({target - curved, target * flatShare_, beside});
      if (flat_ <= (1 + kScatter) * flatTarget) {
        result_.end = square <= (1 + kScatter) * target ? RefineEnd::met : RefineEnd::flatDone;
        break;
      }
      idle = result_.rounds > 1 && flat_ > (1 - kLeastGain) * last ? idle + 1 : 0;
      last = flat_;
      if (idle == kPatience || result_.rounds == kMostRounds) {
        result_.end = RefineEnd::noProgress;
        break;
      }
      if (!refine(flatTarget)) break;
    }
    return std::move(result_);
  }

 private:
  RefinedMesh unrefined() const {
    RefinedMesh same;
    same.mesh = mesh_;
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) same.sourceFace.push_back(f);
    return same;
  }

  std::uint32_t regionOf(std::uint32_t face) const { return parts_.regions.ofFace[result_.refined.sourceFace[face]]; }

  /// A scan has some faces that happen to be flat. Places on them alone need the light of their corners alone, as long
  /// as reflections are left out: that costs next to nothing where judging the whole mesh costs half a bake.
  bool flatPartsMatter() {
    double flat = 0, area = 0;
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
      const double own = areaOf(mesh_, f);
      area += own;
      if (parts_.regions.ofFace[f] != FlatRegions::kNone) flat += own;
    }
    if (flat > kFewFlat * area) return true;
    // Transfer is between nothing and all: no place misses more than all of it.
    const double most = kGlanceShare * options_.target * options_.target;
    if (flat <= most * area) return false;
    const LightingPoints& points = scene_.points;
    std::vector<double> areas = areaWeights(points, mesh_.triangles.size());
    for (std::uint32_t f = 0; f < areas.size(); ++f) {
      if (parts_.regions.ofFace[f] == FlatRegions::kNone) areas[f] = 0;
    }
    if (std::accumulate(areas.begin(), areas.end(), 0.0) == 0) return false;
    BakeOptions direct = probe_;
    direct.kind = TransferKind::shadowed;
    const std::vector<SurfacePlace> places =
        drawPlaces(points, areas, kGlancePlaces, hashBits(probe_.seed, kGlance), progress_);
    const std::vector<double> squares = interpolationSquares(scene_.traced, places, direct, parallel_, progress_);
    const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size());
    return flat / area * mean > most;
  }

  /// How many places each face shall have, on average.
  std::vector<double> placesWanted(const std::vector<double>& areas) const {
    const double aim = std::max(options_.target, result_.after / 4);
    const double even = std::clamp(kFinds / (aim * aim), kLeastPlaces, kMostPlaces);
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<double> wanted(areas.size());
    for (std::size_t f = 0; f < areas.size(); ++f) wanted[f] = area > 0 ? even * areas[f] / area : 0;
    // Errors hide in the small faces of the last rounds, which places by area seldom meet.
    const Mesh& mesh = result_.refined.mesh;
    std::vector<double> extra(areas.size(), 0);
    for (std::uint32_t f = 0; f < mesh.triangles.size() && result_.rounds > 0; ++f) {
      const std::uint32_t region = regionOf(f);
      if (region == FlatRegions::kNone || areas[f] == 0) continue;
      const Vec3d middle = middleOf(mesh, f);
      const std::uint32_t level = field_.levelAt(region, middle);
      if (level > 0) extra[f] = level > before_.levelAt(region, middle) ? kPlacesOnYoung : kPlacesOnOld;
    }
    const double all = std::accumulate(extra.begin(), extra.end(), 0.0);
    const double share = std::min(1.0, kMostExtraPlaces / std::max(all, 1.0));
    for (std::size_t f = 0; f < areas.size(); ++f) wanted[f] += share * extra[f];
    return wanted;
  }

  TracedScene& sceneOfRefined() {
    result_.scene.reset();
    result_.scene = std::make_unique<TracedScene>(
        makeScenePoints(result_.refined.mesh, blockers_, pointOptions_, albedo_, progress_), parallel_, progress_);
    result_.scene->traced.keepForMore(true);
    return *result_.scene;
  }

  /// Measures the error of interpolation on the present mesh: its flat and curved part, and where the flat one is.
  void probe() {
    const Mesh& mesh = result_.refined.mesh;
    TracedScene& scene = result_.rounds == 0 ? scene_ : sceneOfRefined();
    const LightingPoints& points = scene.points;
    const std::vector<double> areas = areaWeights(points, mesh.triangles.size());
    const std::vector<double> wanted = placesWanted(areas);
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    const double count = std::accumulate(wanted.begin(), wanted.end(), 0.0);
    const std::size_t even = 2 * static_cast<std::size_t>(std::ceil(count / 2));
    probe_.seed = hashBits(probe_.seed, kNextRound);
    const std::vector<SurfacePlace> places = drawPlaces(points, wanted, even, probe_.seed, progress_);
    std::vector<Vec3d> positions;
    for (const SurfacePlace& place : places) positions.push_back(placeOn(points, place));
    const std::vector<double> squares = interpolationSquares(scene.traced, places, probe_, parallel_, progress_);

    flat_ = curved_ = flatShare_ = 0;
    for (std::uint32_t f = 0; f < areas.size(); ++f) {
      if (regionOf(f) != FlatRegions::kNone) flatShare_ += areas[f] / area;
    }
    misses_.clear();
    for (std::size_t s = 0; s < places.size(); ++s) {
      const std::uint32_t face = places[s].face, region = regionOf(face);
      const double share = squares[s] * areas[face] / area * count / (wanted[face] * static_cast<double>(even));
      if (region == FlatRegions::kNone) {
        curved_ += share;
        continue;
      }
      flat_ += share;
      const std::uint32_t wantedLevel = field_.levelAt(region, positions[s]);
      misses_.push_back({region, std::max(wantedLevel, field_.levelOf(longestEdge(mesh, face))), positions[s], share});
    }
  }

  /// Asks for finer edges where most is missed, and refines. False: that cannot be had.
  bool refine(double flatTarget) {
    // Where something stands on a region, rows of vertices along its foot come first, among edges as they are.
    const bool rowsFirst = result_.rounds == 1;
    const std::vector<bool> inContact = parts_.regionsInContact();
    const std::uint32_t step = flat_ > kQuarterFrom * flatTarget ? 2 : 1;
    std::map<LengthField::Cell, double> missed;
    for (const Miss& miss : misses_) {
      const std::uint32_t finer = rowsFirst && inContact[miss.region] ? 0 : step;
      const std::uint32_t level = std::min<std::uint32_t>(miss.level + finer, LengthField::kMostLevels);
      missed[field_.cellAt(miss.region, miss.position, level)] += miss.share;
    }
    std::vector<std::pair<double, LengthField::Cell>> worst;
    for (const auto& [cell, share] : missed) worst.emplace_back(share, cell);
    std::sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a > b; });
    const double enough = std::clamp((flat_ - flatTarget) / kGain, kLeastShare * flat_, kMostShare * flat_);
    before_ = field_;
    double share = 0;
    for (const auto& [square, cell] : worst) {
      if (share >= enough || square <= 0) break;
      share += square;
      field_.want(cell);
      finest_ = std::max(finest_, cell.level);
    }
    // What has been judged is of no more use, unless nothing finer can be had: the bake builds it again then.
    (result_.scene ? *result_.scene : scene_).traced.free();
    std::optional<RefinedMesh> next = refineAsWanted();
    if (!next) {
      result_.end = RefineEnd::budget;
      return false;
    }
    result_.refined = std::move(*next);
    result_.shortest = field_.lengthOf(finest_);
    return true;
  }

  /// Nothing where that takes more vertices than allowed.
  std::optional<RefinedMesh> refineAsWanted() const {
    const auto wanted = [this](std::uint32_t face, const Vec3d& place) {
      const std::uint32_t level = field_.levelAt(parts_.regions.ofFace[face], place);
      return level == 0 ? std::numeric_limits<double>::infinity() : field_.lengthOf(level);
    };
    try {
      return refineFlatParts(mesh_, parts_, options_.maxVertices, wanted, parallel_, progress_);
    } catch (const TooManyVertices&) {
      return std::nullopt;
    }
  }

  const Mesh& mesh_;
  const std::vector<Mesh>& blockers_;
  TracedScene& scene_;
  const LightingPointOptions& pointOptions_;
  const AlbedoOptions& albedo_;
  BakeOptions probe_;
  const AutoRefineOptions& options_;
  const Parallel& parallel_;
  Progress& progress_;
  FlatParts parts_;             // of the mesh as it was
  LengthField field_, before_;  // what is wanted, and what was before the last round
  std::uint32_t finest_ = 0;    // level wanted
  AutoRefinement result_;
  double flat_ = 0, curved_ = 0;  // squared errors of interpolation on flat and curved faces
  double flatShare_ = 0;          // of the area
  std::vector<Miss> misses_;      // on flat faces
};

}  // namespace

AutoRefinement refineWhereLightChanges(const Mesh& mesh, const std::vector<Mesh>& blockers, TracedScene& scene,
                                       const LightingPointOptions& points, const AlbedoOptions& albedo,
                                       const BakeOptions& bake, const AutoRefineOptions& options,
                                       const Parallel& parallel, Progress& progress) {
  if (!(options.target >= 1e-4 && options.target <= 1)) {
    throw usageError("the surface error to refine to, " + std::to_string(options.target) + ", is out of range",
                     "use 0.0001 to 1");
  }
  validate(bake);
  return AutoRefiner(mesh, blockers, scene, points, albedo, bake, options, parallel, progress).run();
}

}  // namespace shbake
