// The error between the vertices against their number: bakes of one mesh, refined in two ways, with and without a fit.
#include "chart/sweep/surface_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bake/baker.h"
#include "bake/surface_error.h"
#include "bake/surface_fit.h"
#include "chart/methods/cpu_clock.h"
#include "mesh/refine.h"
#include "pipeline/auto_refine.h"
#include "pipeline/scene_points.h"

namespace shbake::chart {
namespace {

/// Errors of interpolation to which flat parts are divided where the light changes.
constexpr std::array kTargets{0.16, 0.08, 0.04, 0.02, 0.01, 0.005};
/// A mesh whose flat parts have a smaller share of its area is none that refinement changes.
constexpr double kLeastFlat = 0.01;
/// The first mesh of even edges has about this many times the vertices of the mesh as it is, or kLeastVertices if that
/// is more; each further one has four times as many.
constexpr double kFirstGrowth = 2, kGrowth = 4, kLeastVertices = 256;
/// Meshes that grew by less are not another place in the chart.
constexpr double kLeastGrowth = 1.02;
/// A bake, its fit and the measurement of both take about this many times the bake alone.
constexpr double kCostOverBake = 5;
/// Each place that judges traces two sets of four times the rays.
constexpr double kRaysOfSample = 8;
/// Refinement where the light changes judges this many meshes or fewer before the last, each with pilot rays.
constexpr double kCostOfJudging = 2;

class SurfaceStudier {
 public:
  SurfaceStudier(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                 const Parallel& parallel, Progress& progress, ChartData& data)
      : mesh_(mesh),
        options_(options),
        deadline_(deadline),
        parallel_(parallel),
        progress_(progress),
        polled_([this](const ProgressState&) { return progress_.tryAdvance(0); }),
        data_(data) {
    bake_.kind = TransferKind::shadowed;
    bake_.order = options.order;
    bake_.rays = options.rays;
  }

  void run() {
    if (foreseen(static_cast<double>(data_.points)) > deadline_.left()) {
      data_.notes.push_back("the error between the vertices was left out: it would not fit the budget");
      return;
    }
    progress_.begin("surface", 0, "bakes");
    data_.surface.rays = options_.rays;
    judge(mesh_, SurfaceRefinement::none, 0, 0);
    refine();
    progress_.end();
  }

 private:
  /// Seconds by the wall clock for all that is done with a mesh of so many points.
  double foreseen(double points) const {
    const double judging = 2 * kRaysOfSample * static_cast<double>(options_.samples);
    const double cpu = (kCostOverBake * points + judging) * options_.rays * options_.secondsPerPointRay;
    return std::max(cpu / parallel_.threads(), points * secondsPerPoint_);
  }

  RefinedMesh divided(double length, std::size_t maxVertices) {
    RefineOptions refine;
    refine.maxVertices = maxVertices;
    return refineFlatRegions(
        mesh_, refine, [length](std::uint32_t, const Vec3d&) { return length; }, parallel_, polled_);
  }

  void refine() {
    const RefineReport flat = divided(std::numeric_limits<double>::max(), kMostVertices).report;
    if (flat.flatArea < kLeastFlat * flat.area[0]) {
      data_.notes.push_back(
          "no part of the mesh is flat, and none but flat parts are refined: the error between the vertices was "
          "measured with and without a fit only");
      return;
    }
    double vertices = std::max(kFirstGrowth * static_cast<double>(mesh_.positions.size()), kLeastVertices);
    bool evenGoesOn = true, automaticGoesOn = true;
    for (const double target : kTargets) {
      automaticGoesOn = automaticGoesOn && divideWhereLightChanges(target);
      evenGoesOn = evenGoesOn && divideEvenly(flat.flatArea, vertices);
      vertices *= kGrowth;
    }
  }

  /// Each returns whether a finer mesh is worth a try.
  bool divideEvenly(double flatArea, double vertices) {
    if (foreseen(vertices) > deadline_.left()) return false;
    // Triangles with equal sides of length a: sqrt(3)/2 a^2 of area for each vertex.
    const double length = std::sqrt(flatArea / (std::sqrt(3.0) / 2 * vertices));
    const double start = cpuSeconds();
    const RefinedMesh refined = divided(length, kMostVertices);
    const double cpu = cpuSeconds() - start;
    if (grew(refined.mesh, SurfaceRefinement::even)) judge(refined.mesh, SurfaceRefinement::even, length, cpu);
    return true;
  }

  bool divideWhereLightChanges(double target) {
    const double most = deadline_.left() / (kCostOfJudging * foreseen(1e6) / 1e6);
    if (most < kLeastGrowth * static_cast<double>(mesh_.positions.size())) return false;
    AutoRefineOptions refine;
    refine.target = target;
    refine.maxVertices = static_cast<std::size_t>(std::min(most, double(kMostVertices)));
    const double start = cpuSeconds();
    const ScenePoints scene = makeScenePoints(mesh_, {}, {}, {}, polled_);
    const AutoRefinement made = refineWhereLightChanges(mesh_, {}, scene, {}, {}, bake_, refine, parallel_, polled_);
    const double cpu = cpuSeconds() - start;
    if (made.end == RefineEnd::budget) return false;
    if (grew(made.refined.mesh, SurfaceRefinement::automatic)) {
      judge(made.refined.mesh, SurfaceRefinement::automatic, target, cpu);
    }
    return made.end == RefineEnd::met;
  }

  /// Whether a mesh has more vertices than the mesh as it is and the last of its kind.
  bool grew(const Mesh& mesh, SurfaceRefinement kind) const {
    std::size_t last = mesh_.positions.size();
    for (const SurfacePoint& p : data_.surface.points) {
      if (p.refinement == kind) last = std::max(last, p.vertices);
    }
    return static_cast<double>(mesh.positions.size()) > kLeastGrowth * static_cast<double>(last);
  }

  void judge(const Mesh& mesh, SurfaceRefinement refinement, double asked, double refineCpu) {
    const double wall = deadline_.passed();
    const LightingPoints points = makeScenePoints(mesh, {}, {}, {}, polled_).points;
    const double start = cpuSeconds();
    PointBake baked = bakePoints(points, {}, bake_, parallel_, polled_);
    SurfacePoint point{refinement, asked, false, mesh.positions.size(), refineCpu + cpuSeconds() - start, {}};
    add(point, points, baked);
    const double beforeFit = cpuSeconds();
    const SurfaceFitOptions fit{.kind = FitKind::automatic};
    const FitReport report = fitToSurface(points, {}, baked, bake_, fit, parallel_, polled_);
    point.cpu += cpuSeconds() - beforeFit;
    point.fitted = true;
    if (report.fittedPoints + report.smoothedPoints > 0) {
      add(point, points, baked);
    } else if (data_.surface.points.back().error.samples > 0) {
      // Nothing was changed: the same error for the time that it took to find out.
      point.error = data_.surface.points.back().error;
      data_.surface.points.push_back(point);
    }
    secondsPerPoint_ = std::max(secondsPerPoint_, (deadline_.passed() - wall) / static_cast<double>(points.size()));
  }

  void add(SurfacePoint& point, const LightingPoints& points, const PointBake& baked) {
    BakeOptions done = bake_;
    done.rays = baked.rays;
    point.error = measureSurfaceError(points, baked.transfer, done, {.samples = options_.samples}, parallel_, polled_);
    if (point.error.samples > 0) data_.surface.points.push_back(point);
    progress_.advance(1);
  }

  static constexpr std::size_t kMostVertices = 2'000'000;

  const Mesh& mesh_;
  const SurfaceStudyOptions& options_;
  const Deadline& deadline_;
  const Parallel& parallel_;
  Progress& progress_;
  Progress polled_;
  ChartData& data_;
  BakeOptions bake_;
  double secondsPerPoint_ = 0;
};

}  // namespace

void studySurface(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data) {
  SurfaceStudier(mesh, options, deadline, parallel, progress, data).run();
}

}  // namespace shbake::chart
