// bench_fit: what fitting to the surface gains against more rays for the vertices. For each mesh and number of rays,
// the error of interpolated transfer at places that no bake has seen, for point sampling, the fit that is chosen by
// measurement, the fit everywhere, and point sampling with as many rays as take the time of each.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bake/surface_fit.h"
#include "bake/surface_fit_choice.h"
#include "bake/surface_fit_samples.h"
#include "equal_time.h"
#include "scenes.h"

namespace shbake::bench {
namespace {

struct Options {
  std::vector<std::string> meshes;
  std::vector<int> rays{32, 256, 1024};
  int order = 4;
  std::size_t samples = 16384;
  int referenceRays = 1024;
  bool interreflected = false;
  double albedo = 0.8;
  SurfaceFitOptions fit;
};

/// One way to bake: its result and what became of the fit.
struct Trial {
  PointBake baked;
  FitReport fit;
};

class MeshBench {
 public:
  MeshBench(const std::string& name, const Options& options)
      : options_(options),
        label_(labelOf(name)),
        points_(namedPoints(name, Rgb(1, 1, 1) * static_cast<float>(options.albedo))) {}

  void run() {
    for (const int rays : options_.rays) row(rays);
  }

 private:
  BakeOptions bakeOptions(int rays) const {
    BakeOptions bake;
    bake.kind = options_.interreflected ? TransferKind::interreflected : TransferKind::shadowed;
    bake.order = options_.order;
    bake.rays = rays;
    bake.tolerance = 1e-3;
    return bake;
  }

  Trial bake(int rays, FitKind kind) {
    const BakeOptions options = bakeOptions(rays);
    SurfaceFitOptions fit = options_.fit;
    fit.kind = kind;
    Trial trial;
    TracedPoints traced(points_, parallel_, progress_);
    traced.keepForMore(kind != FitKind::vertex);
    trial.baked = bakePoints(traced, {}, options, parallel_, progress_);
    trial.fit = fitToSurface(traced, {}, trial.baked, options, fit, parallel_, progress_);
    return trial;
  }

  /// Held-out places of a seed of their own, with the light that `senders` send them.
  HeldOutSamples truth(const TransferSet& senders) {
    const BakeOptions options = bakeOptions(options_.referenceRays);
    TracedPoints traced(points_, parallel_, progress_);
    PlaceTracer tracer(traced, senders, options_.interreflected ? &senders : nullptr, options, parallel_, progress_);
    std::vector<SurfacePlace> places =
        drawPlaces(points_, areaWeights(points_, points_.faces.size()), options_.samples, 0x5EED, progress_);
    PlaceTransfers truth = tracer.trace(places, options_.referenceRays, std::array<std::uint64_t, 2>{0x5EED1, 0x5EED2});
    return HeldOutSamples(points_, std::move(places), std::move(truth), senders.stride());
  }

  void row(int rays) {
    const EqualTime equalTime([&](int n) { bake(n, FitKind::vertex); }, rays);
    const Trial point = bake(rays, FitKind::vertex), chosen = bake(rays, FitKind::automatic),
                fitted = bake(rays, FitKind::surface);
    const HeldOutSamples held = truth(point.baked.transfer);
    const auto error = [&](const Trial& t) {
      return 100 * std::sqrt(std::max(0.0, held.squaredError(t.baked.transfer.coefficients).mean));
    };
    const double ofPoints = error(point);
    std::printf("%-24s %7zu %5d | %7.3f", label_.c_str(), points_.size(), rays, ofPoints);
    for (const auto& [kind, trial] : {std::pair(FitKind::automatic, &chosen), std::pair(FitKind::surface, &fitted)}) {
      const EqualTime::Cost cost = equalTime.of([&, kind = kind] { bake(rays, kind); });
      const double e = error(*trial);
      const double like = errorBetweenGroups(cost.rays, [&](int n) { return error(bake(n, FitKind::vertex)); });
      std::printf(" | %7.3f %8.3fs %5.2f %5.2f", e, cost.seconds, e / ofPoints, e / like);
    }
    std::printf(" | %zu+%zu %s\n", chosen.fit.smoothedPoints, chosen.fit.fittedPoints, chosen.fit.reason.c_str());
    std::fflush(stdout);
  }

  const Options& options_;
  std::string label_;
  Parallel parallel_;
  Progress progress_;
  LightingPoints points_;
};

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Compares fitting to the surface with more rays for the vertices"};
  Options o;
  app.add_option("meshes", o.meshes, "files or generated meshes; default: all");
  app.add_option("--rays", o.rays, "ray counts of the vertices, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--order", o.order, "SH bands");
  app.add_option("--samples", o.samples, "places where errors are measured, an even number");
  app.add_option("--reference", o.referenceRays, "rays of each of the two sets that measure there");
  app.add_option("--albedo", o.albedo, "uniform albedo");
  app.add_option("--fit-samples", o.fit.samplesPerPoint, "places a point that are fitted to");
  app.add_option("--fit-rays", o.fit.raysPerSample, "rays from each of them; 0: by the bake's");
  app.add_flag("--interreflected", o.interreflected, "with all reflections instead of the sky alone");
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty()) o.meshes = defaultMeshes(SHBAKE_SHARED_DIR "/meshes");
  try {
    std::printf(
        "order %d, %s; errors in %% between the vertices, CPU time, error over that of points with the same "
        "rays and over that of points in the same time; points smoothed + fitted\n",
        o.order, o.interreflected ? "interreflected" : "shadowed");
    std::printf("%-24s %7s %5s | %7s | %29s | %29s |\n", "mesh", "points", "rays", "points", "chosen", "fitted");
    for (const std::string& mesh : o.meshes) MeshBench(mesh, o).run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_fit: %s\n", e.what());
    return 1;
  }
  return 0;
}
