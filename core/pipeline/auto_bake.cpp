#include "pipeline/auto_bake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <utility>

#include "bake/fit_prospect.h"
#include "bake/interpolation_error.h"
#include "bake/surface_places.h"
#include "base/error.h"
#include "base/hash.h"
#include "mesh/convexity.h"
#include "pipeline/auto_refine.h"
#include "pipeline/light_order.h"
#include "pipeline/traced_scene.h"

namespace shbake {
namespace {

/// The part of the tolerance that is aimed at: what is left covers the scatter of the estimates.
constexpr double kAim = 0.94;
/// The part of the aim that interpolation may take where vertices can be added; the noise of the vertices takes the
/// rest. Fewer vertices with more rays each cost about the same between 0.7 and 0.9.
constexpr double kInterpolationShare = 0.8;
/// What is left between the vertices of what interpolation misses, by expectation and at best, and of the variance of
/// their noise: the mean square of three weights by area.
struct Left {
  double missed, leastMissed, noise;
};
constexpr Left kPlainLeft{1, 1, 0.5};
/// The same where values are fitted or smoothed as samples tell; `bench_surface --tables left` measures 0.63 to 0.89
/// and 0.06 to 0.55 on its scenes: near the upper ends, for a second bake costs more than the vertices that it saves.
constexpr Left kFittedLeft{FitProspect::kUsuallyLeft, 0.63, 0.4};
/// The error that the vertices may always have, in tolerances, however little interpolation leaves to them.
constexpr double kLeastNoise = 0.45;
/// A bake that may fail is worth trying where it takes this many times fewer rays than one that is not expected to.
constexpr double kFewerRays = 2;
/// Places that find an error of 1 on a share tolerance^2 of the surface this often.
constexpr double kFinds = 4;
constexpr double kLeastSamples = 2048, kMostSamples = 16384;
/// Rays of each set of such a place. So many places need few: even where vertices have all of the tolerance as noise,
/// that of one place is no more than the tolerance.
constexpr TruthRays kJudgeRays{1, 64};
/// Places and rays that tell what interpolation misses where no refinement has measured it. Their noise cancels.
constexpr std::size_t kGlancePlaces = 512;
constexpr int kGlanceRays = 32;
/// The stream of random numbers of that glance.
constexpr std::uint64_t kGlance = 32;
/// Bakes until the tolerance is met, each aiming lower than the last by what that missed.
constexpr int kMostBakes = 3;

std::string percent(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %%", digits, 100 * value);
  return text;
}

std::string percent(double value) {
  return percent(value, value < 0.01 ? 2 : 1);
}

/// "2.04 %, above the tolerance of 2.00 %": with digits enough to tell them apart.
std::string aboveTolerance(double error, double tolerance) {
  int digits = tolerance < 0.01 ? 2 : 1;
  while (digits < 4 && percent(error, digits) == percent(tolerance, digits)) ++digits;
  return percent(error, digits) + ", above the tolerance of " + percent(tolerance, digits);
}

std::string count(std::size_t n) {
  return std::to_string(n);
}

class AutoBaker {
 public:
  AutoBaker(const Mesh& mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& options,
            const AutoBakeOptions& choose, const Parallel& parallel, Progress& progress)
      : mesh_(mesh),
        blockers_(blockers),
        options_(options),
        choose_(choose),
        parallel_(parallel),
        progress_(progress),
        openRays_(options.bake.rays == 0) {}

  AutoBake run() {
    chooseForScene();
    if (!choose_.tolerance) {
      bakeOnce(kAim * tolerance());
    } else {
      bakeToTolerance();
    }
    if (refined_) nameNewVertices();
    tellAll();
    return std::move(result_);
  }

 private:
  void tell(std::string what, std::string value, std::string reason) {
    result_.choices.push_back({std::move(what), std::move(value), std::move(reason)});
  }

  /// What the scene as a whole decides: the kind of transfer, and the order under the light that was named.
  void chooseForScene() {
    if (choose_.transfer) chooseTransfer(scene().points);
    if (choose_.light) chooseBands();
  }

  std::unique_ptr<TracedScene> makeScene(const Mesh& mesh) {
    auto scene = std::make_unique<TracedScene>(
        makeScenePoints(mesh, blockers_, options_.points, options_.albedo, progress_), parallel_, progress_);
    scene->traced.keepForMore(true);
    return scene;
  }

  /// The lighting points of the mesh as it was given.
  TracedScene& scene() {
    if (!scene_) scene_ = makeScene(mesh_);
    return *scene_;
  }

  /// Those of the mesh that is baked.
  TracedScene& sceneToBake() {
    if (isAsGiven()) return scene();
    scene_.reset();
    if (!refined_->scene) refined_->scene = makeScene(refined_->refined.mesh);
    return *refined_->scene;
  }
  const Mesh& meshToBake() const { return isAsGiven() ? mesh_ : refined_->refined.mesh; }

  void chooseTransfer(const LightingPoints& points) {
    BakeOptions& bake = options_.bake;
    if (bake.kind == TransferKind::unshadowed) return;
    if (blockers_.empty() && isConvexSolid(points, progress_)) {
      bake.kind = TransferKind::unshadowed;
      return tell("transfer", "unshadowed", "the mesh is closed and convex, so nothing hides the sky: no rays");
    }
    if (bake.kind != TransferKind::interreflected) return;
    const bool black =
        std::all_of(points.pointAlbedo.begin(), points.pointAlbedo.end(), [](const Rgb& a) { return a == Rgb(); });
    if (black) {
      bake.kind = TransferKind::shadowed;
      return tell("transfer", "shadowed", "the albedo is 0, so nothing is reflected: no hits are stored");
    }
    tell("transfer", "interreflected", "the mesh is not convex and reflects");
  }

  void chooseBands() {
    const LightOrder chosen =
        chooseOrder(scene().traced, {}, options_.bake, *choose_.light, tolerance(), parallel_, progress_);
    options_.bake.order = chosen.order;
    const auto left = [&](int order) { return percent(chosen.left[static_cast<std::size_t>(order - 1)]); };
    std::string reason = "the bands above change pictures under this light by " + left(chosen.order);
    if (chosen.order > 1) reason += ", with one band less by " + left(chosen.order - 1);
    reason += "; " + count(static_cast<std::size_t>(chosen.order * chosen.order)) + " coefficients a channel";
    tell("order", std::to_string(chosen.order), reason);
  }

  double tolerance() const { return choose_.tolerance.value_or(AutoBakeOptions::kDefaultTolerance); }

  void bakeToTolerance() {
    if (options_.surfaceSamples == 0) {
      const double finds = kFinds / (tolerance() * tolerance());
      options_.surfaceSamples = static_cast<std::size_t>(std::clamp(finds, kLeastSamples, kMostSamples));
    }
    options_.surfaceRays = kJudgeRays;
    options_.fit.enough = tolerance();
    double aim = kAim * tolerance();
    for (int bake = 1;; ++bake) {
      bakeOnce(aim);
      result_.baked.facts.tolerance = tolerance();
      const SurfaceError& surface = result_.baked.facts.surface;
      result_.met = surface.samples == 0 || surface.rms <= tolerance();
      if (result_.met || bake == kMostBakes || !openRays_) break;
      options_.fit.enough = 0;
      if (refined_ && refined_->end == RefineEnd::met && refined_->rounds > 0) {
        aim *= kAim * tolerance() / surface.rms;
        continue;
      }
      // More vertices cannot be had; more rays help where there is room for noise, or the last bake had more of it.
      missed_ = missedByJudge();
      if (*missed_ >= aim && options_.bake.tolerance <= kLeastNoise * aim) break;
    }
  }

  /// What the surface error is beside the noise of the vertices.
  double missedByJudge() const {
    const TransferFacts& facts = result_.baked.facts;
    const double square = facts.surface.rms * facts.surface.rms - left().noise * facts.rmsError * facts.rmsError;
    return std::sqrt(std::max(0.0, square));
  }

  Left left() const { return options_.fit.kind == FitKind::automatic ? kFittedLeft : kPlainLeft; }

  void bakeOnce(double aim) {
    refine(aim);
    if (choose_.tolerance) chooseNoise(aim);
    TracedScene& scene = sceneToBake();
    // A bake that misses its tolerance is followed by another.
    scene.traced.keepForMore(choose_.tolerance && openRays_);
    result_.baked = bakeMesh(meshToBake(), blockers_.size(), scene, options_, parallel_, progress_);
  }

  bool isAsGiven() const { return !refined_ || refined_->refined.mesh.positions.size() == mesh_.positions.size(); }

  void refine(double aim) {
    const RefinementOptions& refinement = choose_.refinement;
    if (refinement.kind == RefinementOptions::Kind::length) {
      const RefineOptions refine{refinement.flatDegrees, options_.points.creaseDegrees, refinement.maxVertices};
      const auto length = [&](std::uint32_t, const Vec3d&) { return refinement.length; };
      if (!refined_) refined_.emplace().refined = refineFlatRegions(mesh_, refine, length, parallel_, progress_);
    }
    if (refinement.kind != RefinementOptions::Kind::automatic) return;
    if (options_.bake.kind == TransferKind::unshadowed) return;
    AutoRefineOptions refine;
    refine.target = std::clamp(kInterpolationShare * aim / left().missed, 1e-4, 1.0);
    refine.flatDegrees = refinement.flatDegrees;
    refine.maxVertices = refinement.maxVertices;
    if (refined_) refined_->scene.reset();
    refined_ = refineWhereLightChanges(mesh_, blockers_, scene(), options_.points, options_.albedo, options_.bake,
                                       refine, parallel_, progress_);
  }

  /// The error that vertices may have, beside what interpolation misses. Where little room is expected for it, all
  /// depends on how well values can be fitted, which differs from mesh to mesh: that is found out by few rays, enough
  /// where a fit does as well as anywhere. Where that fails, the judge has told what this mesh needs.
  void chooseNoise(double aim) {
    if (!openRays_ || options_.bake.kind == TransferKind::unshadowed) return;
    double noise = 0;
    if (missed_) {
      noise = noiseBeside(*missed_, aim);
    } else {
      const double missed = isProbed() ? refined_->after : glance();
      noise = noiseBeside(left().missed * missed, aim);
      const double hoped = noiseBeside(left().leastMissed * missed, aim);
      // The error falls as rays^(-3/4).
      if (std::pow(hoped / noise, 4.0 / 3) > kFewerRays) noise = hoped;
    }
    options_.bake.tolerance = std::min(noise, 1.0);
  }

  /// The error of the vertices that adds up to `aim` with what interpolation misses, or the least that they may have.
  double noiseBeside(double missed, double aim) const {
    const double noise = std::sqrt(std::max(0.0, aim * aim - missed * missed) / left().noise);
    return std::max(noise, kLeastNoise * aim);
  }

  bool isProbed() const { return refined_ && refined_->rounds > 0; }

  /// What interpolation misses on the mesh that is baked, but for reflections, which change more slowly.
  double glance() {
    if (glanced_) return *glanced_;
    TracedPoints& traced = sceneToBake().traced;
    BakeOptions probe = options_.bake;
    probe.kind = TransferKind::shadowed;
    probe.rays = kGlanceRays;
    probe.seed = hashBits(probe.seed, kGlance);
    const std::vector<double> areas = areaWeights(traced.points(), meshToBake().triangles.size());
    const std::vector<SurfacePlace> places = drawPlaces(traced.points(), areas, kGlancePlaces, probe.seed, progress_);
    const std::vector<double> squares = interpolationSquares(traced, places, probe, parallel_, progress_);
    const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
    glanced_ = std::sqrt(std::max(0.0, sum) / static_cast<double>(std::max<std::size_t>(1, squares.size())));
    return *glanced_;
  }

  void nameNewVertices() {
    std::vector<std::uint32_t>& source = result_.baked.sourceVertex;
    if (source.empty() && result_.baked.transfer.size() > mesh_.positions.size()) {
      source.resize(result_.baked.transfer.size());
      std::iota(source.begin(), source.end(), 0u);
    }
    for (std::uint32_t& v : source) {
      if (v >= mesh_.positions.size()) v = kNewVertex;
    }
    result_.baked.facts.sourceVertices = mesh_.positions.size();
  }

  void tellAll() {
    const BakedMesh& baked = result_.baked;
    const TransferFacts& facts = baked.facts;
    if (refined_) tellRefinement();
    if (choose_.tolerance) {
      tellChannels();
      if (facts.rays > 0 && openRays_) {
        tell("rays", count(static_cast<std::size_t>(facts.rays)),
             "the points err by " + percent(facts.rmsError) + ", which leaves about " +
                 percent(std::sqrt(left().noise) * facts.rmsError) + " between them");
      }
      if (facts.kind == TransferKind::interreflected && facts.bouncesConverged) {
        tell("bounces", "all", "in " + std::to_string(facts.bounces) + " steps, to a tenth of the error of the points");
      }
    }
    if (const auto& fit = baked.fit) {
      tell("fit", fit->fittedPoints > 0 ? "surface" : fit->smoothedPoints > 0 ? "smoothed" : "vertex", fit->reason);
    }
    if (!result_.met) result_.baked.warnings.push_back(whyNot());
  }

  void tellChannels() {
    if (result_.baked.transfer.channels == 3) return tell("channels", "3", "the albedo has colour");
    tell("channels", "1", "the albedo is grey: a third of the storage");
  }

  void tellRefinement() {
    const RefineReport& report = refined_->refined.report;
    const std::string vertices =
        count(mesh_.positions.size()) + " -> " + count(refined_->refined.mesh.positions.size()) + " vertices";
    if (refined_->rounds == 0 && refined_->end == RefineEnd::met) {
      return tell("refine", vertices, count(report.refined) + " of " + count(report.regions) + " flat regions");
    }
    const std::string missed = percent(refined_->after);
    if (refined_->end == RefineEnd::noFlat) return tell("refine", "no", "no part of the mesh is flat");
    if (refined_->end == RefineEnd::flatFine)
      return tell("refine", "no", "few parts are flat, and miss too little there");
    if (refined_->rounds == 1) return tell("refine", "no", "interpolation misses " + missed + " as it is");
    std::string reason = "interpolation missed " + percent(refined_->before) + " and now " + missed;
    const double even = report.flatArea / (std::sqrt(3.0) / 2 * refined_->shortest * refined_->shortest);
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", even);
    reason += std::string("; even edges as short as the shortest would take ") + text + " vertices";
    tell("refine", vertices, reason);
  }

  /// Why the tolerance was not met, as a warning.
  std::string whyNot() const {
    const SurfaceError& surface = result_.baked.facts.surface;
    std::string text = "the surface error is " + aboveTolerance(surface.rms, tolerance()) + ": ";
    const double noise = left().noise * result_.baked.facts.rmsError * result_.baked.facts.rmsError;
    if (!openRays_ && noise > surface.rms * surface.rms / 2) return text + "the rays were given; allow more of them";
    if (options_.bake.kind == TransferKind::unshadowed)
      return text + "it lies between the vertices; subdivide the mesh";
    if (!refined_) return text + "the mesh was to stay as it is; allow it to be refined";
    if (choose_.refinement.kind == RefinementOptions::Kind::length) {
      return text + "edges have the length that was given; give a shorter one, or auto";
    }
    switch (refined_->end) {
      case RefineEnd::noFlat:
      case RefineEnd::flatFine:
        return text + "it lies between the vertices of curved parts, which are not divided; subdivide them";
      case RefineEnd::flatDone:
        // A fit takes off some of what interpolation misses.
        return text + (refined_->curved < surface.rms ? percent(refined_->curved) + " lie" : "it lies") +
               " between the vertices of curved parts, which are not divided; subdivide them";
      case RefineEnd::budget:
        return text + "no more than " + count(choose_.refinement.maxVertices) + " vertices were allowed";
      case RefineEnd::noProgress:
        return text + "more vertices in flat parts no longer lower it";
      case RefineEnd::met:
        break;
    }
    return text + "samples of the surface judged it better than it is; ask for less";
  }

  const Mesh& mesh_;
  const std::vector<Mesh>& blockers_;
  BakeMeshOptions options_;
  const AutoBakeOptions& choose_;
  const Parallel& parallel_;
  Progress& progress_;
  bool openRays_;
  std::unique_ptr<TracedScene> scene_;  // see scene()
  std::optional<AutoRefinement> refined_;
  std::optional<double> glanced_;  // see glance()
  std::optional<double> missed_;   // what a bake with too few rays left beside their noise
  AutoBake result_;
};

}  // namespace

AutoBake autoBake(Mesh mesh, const std::vector<Mesh>& blockers, const BakeMeshOptions& options,
                  const AutoBakeOptions& choose, const Parallel& parallel, Progress& progress) {
  if (choose.tolerance && !(*choose.tolerance >= 1e-4 && *choose.tolerance <= 1)) {
    throw usageError("the surface error to reach, " + std::to_string(*choose.tolerance) + ", is out of range",
                     "use 0.0001 to 1");
  }
  validate(mesh, options);
  return AutoBaker(mesh, blockers, options, choose, parallel, progress).run();
}

}  // namespace shbake
