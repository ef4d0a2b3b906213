// The error between the vertices against time: bakes of one mesh by rays, by fits, refined in two ways, and to
// tolerances.
#include "chart/sweep/surface_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bake/baker.h"
#include "base/error.h"
#include "chart/methods/cpu_clock.h"
#include "chart/sweep/surface_judge.h"
#include "mesh/refine.h"
#include "pipeline/auto_bake.h"
#include "pipeline/auto_refine.h"
#include "pipeline/traced_scene.h"

namespace shbake::chart {
namespace {

/// Rays of the mesh as it is, beside the default.
constexpr std::array kRays{16, 64, 256, 1024, 4096};
/// Errors to which flat parts are divided where the light changes, and surface errors to reach.
constexpr std::array kTargets{0.16, 0.08, 0.04, 0.02, 0.01, 0.005};
/// A mesh whose flat parts have a smaller share of its area is none that refinement changes.
constexpr double kLeastFlat = 0.01;
/// The first mesh of even edges has about this many times the vertices of the mesh as it is, or kLeastVertices if that
/// is more; each further one has four times as many.
constexpr double kFirstGrowth = 2, kGrowth = 4, kLeastVertices = 256;
constexpr std::size_t kMostVertices = 2'000'000;
/// Meshes that grew by less are not another place in the chart.
constexpr double kLeastGrowth = 1.02;
/// A fit takes about this many times as long as the bake before it.
constexpr double kCostOfFit = 1.2;
/// Refinement where the light changes judges this many meshes or fewer before the last, each with pilot rays.
constexpr double kCostOfJudging = 2;
/// A bake to a tolerance may refine, bake and judge itself up to three times; the next one, to half the error, takes
/// at most so many times as long.
constexpr double kCostOfTolerance = 6, kNextTolerance = 4;
/// The part of the time that goes to tracing the places that judge.
constexpr double kJudgeShare = 0.25;
/// Times of quick work scatter: it is done up to three times, and the least counts.
constexpr int kRuns = 3;
constexpr double kQuickSeconds = 0.3;

/// CPU seconds of `work`, which does the same each time.
template <class Work>
double leastCpu(const Work& work) {
  double least = std::numeric_limits<double>::infinity(), all = 0;
  for (int run = 0; run < kRuns && all < kQuickSeconds; ++run) {
    const double start = cpuSeconds();
    work();
    const double taken = cpuSeconds() - start;
    least = std::min(least, taken);
    all += taken;
  }
  return least;
}

class SurfaceStudier {
 public:
  SurfaceStudier(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                 const Parallel& parallel, Progress& progress, ChartData& data)
      : mesh_(mesh),
        options_(options),
        deadline_(deadline),
        parallel_(parallel),
        progress_(progress),
        polled_([this](const ProgressState&) { return progress_.tryAdvance(0) && !deadline_.isOver(); }),
        data_(data) {
    bake_.kind = TransferKind::shadowed;
    bake_.order = options.order;
  }

  void run() {
    const double pointRays = static_cast<double>(data_.points) * options_.rays;
    if (foreseen(pointRays, 0) > (1 - kJudgeShare) * deadline_.left()) {
      data_.notes.push_back("the error between the vertices was left out: it would not fit the budget");
      return;
    }
    if (!attempt([&] { return findPlaces(); })) return;
    data_.surface.rays = options_.rays;
    progress_.begin("surface", 0, "bakes");
    if (attempt([&] { return bakeAsItIs(options_.rays); })) attempt([&] { return goThrough(); });
    progress_.end();
    if (leftOut_ > 0) {
      data_.notes.push_back("the time was short: of the error between the vertices, " + std::to_string(leftOut_) +
                            " steps of rays, refinement or tolerance were left out");
    }
  }

 private:
  /// Seconds by the wall clock for a bake of so many rays in all and fits as costly as `fits` bakes.
  double foreseen(double pointRays, double fits) const {
    return slowness_ * (1 + fits) * pointRays * options_.secondsPerPointRay / parallel_.threads();
  }

  /// Does a step that returns whether the next of its kind is worth a try. False too where the deadline stopped it.
  template <class Step>
  bool attempt(const Step& step) {
    try {
      return step();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::cancelled) throw;
      progress_.advance(0);  // throws where it was the user who stopped
      return leaveOut();
    }
  }
  bool leaveOut() {
    ++leftOut_;
    return false;
  }

  /// Returns whether there are any.
  bool findPlaces() {
    scene_ = makeScenePoints(mesh_, {}, {}, {}, polled_);
    judge_.emplace(scene_.points,
                   SurfaceJudgeOptions{.order = options_.order, .places = options_.places, .cache = options_.cache},
                   Deadline(kJudgeShare * deadline_.left()), parallel_, progress_);
    data_.surface.cache = judge_->cache();
    return judge_->places() > 0;
  }

  /// From the cheapest settings of each kind to the dearest.
  bool goThrough() {
    const RefineReport flat = divided(std::numeric_limits<double>::max()).report;
    const bool isFlat = flat.flatArea >= kLeastFlat * flat.area[0];
    if (!isFlat) {
      data_.notes.push_back(
          "no part of the mesh is flat, and none but flat parts are refined: the error between the vertices was "
          "measured by rays and fits only");
    }
    double vertices = std::max(kFirstGrowth * static_cast<double>(mesh_.positions.size()), kLeastVertices);
    bool rays = true, even = isFlat, automatic = isFlat, tolerance = true;
    for (std::size_t i = 0; i < kTargets.size(); ++i) {
      rays = rays && i < kRays.size() && attempt([&] { return bakeAsItIs(kRays[i]); });
      even = even && attempt([&] { return divideEvenly(flat.flatArea, vertices); });
      automatic = automatic && attempt([&] { return divideWhereLightChanges(kTargets[i]); });
      tolerance = tolerance && attempt([&] { return bakeToTolerance(kTargets[i]); });
      vertices *= kGrowth;
    }
    return true;
  }

  RefinedMesh divided(double length) {
    RefineOptions refine;
    refine.maxVertices = kMostVertices;
    return refineFlatRegions(
        mesh_, refine, [length](std::uint32_t, const Vec3d&) { return length; }, parallel_, polled_);
  }

  bool bakeAsItIs(int rays) {
    const bool isDone = std::any_of(data_.surface.points.begin(), data_.surface.points.end(), [&](const auto& p) {
      return p.refinement == SurfaceRefinement::none && p.rays == rays;
    });
    if (isDone) return true;
    if (foreseen(static_cast<double>(data_.points) * rays, 2 * kCostOfFit) > deadline_.left()) return leaveOut();
    SurfacePoint point;
    point.rays = rays;
    point.vertices = mesh_.positions.size();
    bakeAndJudge(point, scene_.points, {FitKind::automatic, FitKind::surface});
    return true;
  }

  bool divideEvenly(double flatArea, double vertices) {
    if (foreseen(vertices * options_.rays, kCostOfFit) > deadline_.left()) return leaveOut();
    // Triangles with equal sides of length a: sqrt(3)/2 a^2 of area for each vertex.
    const double length = std::sqrt(flatArea / (std::sqrt(3.0) / 2 * vertices));
    RefinedMesh refined;
    const double cpu = leastCpu([&] { refined = divided(length); });
    addRefined(refined.mesh, SurfaceRefinement::even, length, cpu);
    return true;
  }

  bool divideWhereLightChanges(double target) {
    const double most = deadline_.left() / foreseen(options_.rays, kCostOfFit + kCostOfJudging);
    if (most < kLeastGrowth * static_cast<double>(mesh_.positions.size())) return leaveOut();
    AutoRefineOptions refine;
    refine.target = target;
    refine.maxVertices = static_cast<std::size_t>(std::min(most, double(kMostVertices)));
    BakeOptions bake = bake_;
    bake.rays = options_.rays;
    AutoRefinement made;
    const double cpu = leastCpu([&] {
      TracedScene scene(scene_, parallel_, polled_);
      made = refineWhereLightChanges(mesh_, {}, scene, {}, {}, bake, refine, parallel_, polled_);
    });
    if (made.end == RefineEnd::budget) return leaveOut();
    addRefined(made.refined.mesh, SurfaceRefinement::automatic, target, cpu);
    return made.end == RefineEnd::met;
  }

  /// Bakes and judges a refined mesh where it has more vertices than the mesh as it is and the last of its kind.
  void addRefined(const Mesh& mesh, SurfaceRefinement refinement, double asked, double cpu) {
    std::size_t last = mesh_.positions.size();
    for (const SurfacePoint& p : data_.surface.points) {
      if (p.refinement == refinement) last = std::max(last, p.vertices);
    }
    if (static_cast<double>(mesh.positions.size()) <= kLeastGrowth * static_cast<double>(last)) return;
    SurfacePoint point;
    point.refinement = refinement;
    point.asked = asked;
    point.rays = options_.rays;
    point.vertices = mesh.positions.size();
    point.cpu = cpu;
    bakeAndJudge(point, makeScenePoints(mesh, {}, {}, {}, polled_).points, {FitKind::automatic});
  }

  /// Adds `point` with the transfer of the vertices and with each fit; its `cpu` is what was spent before.
  void bakeAndJudge(SurfacePoint point, const LightingPoints& points, std::initializer_list<FitKind> fits) {
    const double wall = deadline_.passed();
    BakeOptions bake = bake_;
    bake.rays = point.rays;
    const PointSurface surface = judge_->surfaceOf(points);
    PointBake baked, fitted;
    point.cpu += leastCpu([&] { baked = bakePoints(points, {}, bake, parallel_, polled_); });
    add(point, surface, baked.transfer);
    const double bakeCpu = point.cpu;
    for (const FitKind kind : fits) {
      const double fitCpu = leastCpu([&] {
        fitted = baked;
        fitToSurface(points, {}, fitted, bake, {.kind = kind}, parallel_, polled_);
      });
      point.fit = kind;
      point.cpu = bakeCpu + fitCpu;
      add(point, surface, fitted.transfer);
    }
    // What is quick is done again, and has more about it than rays.
    const double taken = deadline_.passed() - wall;
    if (taken < kRuns * kQuickSeconds) return;
    const double expected =
        foreseen(static_cast<double>(points.size()) * point.rays, kCostOfFit * static_cast<double>(fits.size()));
    slowness_ = std::max(1.0, slowness_ * taken / expected);
  }

  bool bakeToTolerance(double tolerance) {
    const double pointRays = static_cast<double>(data_.points) * options_.rays;
    const double expected =
        lastTolerance_ > 0 ? kNextTolerance * lastTolerance_ : foreseen(pointRays, kCostOfTolerance) / kNextTolerance;
    if (expected > deadline_.left()) return leaveOut();
    BakeMeshOptions options;
    options.bake = bake_;
    options.fit.kind = FitKind::automatic;
    AutoBakeOptions choose;
    choose.tolerance = tolerance;
    choose.refinement.kind = RefinementOptions::Kind::automatic;
    choose.refinement.maxVertices = kMostVertices;
    const double wall = deadline_.passed();
    AutoBake made;
    SurfacePoint point;
    point.cpu = leastCpu([&] { made = autoBake(mesh_, {}, options, choose, parallel_, polled_); });
    lastTolerance_ = deadline_.passed() - wall;
    point.refinement = SurfaceRefinement::chosen;
    point.asked = tolerance;
    point.fit = FitKind::automatic;
    point.rays = made.baked.facts.rays;
    point.vertices = made.baked.mesh.positions.size();
    add(point, judge_->surfaceOf(made.baked.mesh), made.baked.transfer);
    return made.met;
  }

  void add(SurfacePoint& point, const PointSurface& surface, const TransferSet& baked) {
    point.error = judge_->errorOf(surface, baked);
    data_.surface.points.push_back(point);
    progress_.advance(1);
  }

  const Mesh& mesh_;
  const SurfaceStudyOptions& options_;
  const Deadline& deadline_;
  const Parallel& parallel_;
  Progress& progress_;
  Progress polled_;  // stops work where the user does, or where the time is over
  ChartData& data_;
  BakeOptions bake_;
  ScenePoints scene_;
  std::optional<SurfaceJudge> judge_;
  double slowness_ = 1;  // how many times as long as foreseen from the rays the last bakes took
  double lastTolerance_ = 0;
  int leftOut_ = 0;
};

}  // namespace

void studySurface(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data) {
  SurfaceStudier(mesh, options, deadline, parallel, progress, data).run();
}

}  // namespace shbake::chart
