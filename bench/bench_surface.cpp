// bench_surface: whether refinement, fit and `--tolerance` hold what they promise, as places between the vertices judge
// that no bake has seen. One table has the errors of the methods beside those of point sampling in the same CPU time,
// RMS over several seeds; another has what bakes to a tolerance reached, what they took, and what settings found by a
// sweep would have taken; the third what a fit leaves of what interpolation misses and of the noise of the vertices.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

#include "bake/surface_error.h"
#include "chart/methods/cpu_clock.h"
#include "equal_time.h"
#include "pipeline/auto_bake.h"
#include "pipeline/baked_surface_error.h"
#include "scenes.h"
#include "support/shapes.h"

namespace shbake::bench {
namespace {

struct Options {
  std::vector<std::string> meshes;
  std::vector<double> tolerances{0.1, 0.05, 0.02};
  std::vector<std::string> transfers{"shadowed", "interreflected"};
  std::vector<std::string> tables{"methods", "tolerances"};
  std::vector<std::string> methods{"fit", "refined", "auto"};
  double methodShare = 0.3;  // of the error of point sampling: the tolerance of the methods that have one
  int methodRays = 256;      // of that point sampling, and of the fit
  int seeds = 1;             // bakes of each method, over which errors are RMS
  int order = 4;
  std::size_t samples = 16384, sweepSamples = 4096;
  int truthRays = 256;  // each of the two sets of a sample has four times as many
  bool sweep = false;
  double reach = 2;  // how far beyond the cost of the bake to a tolerance settings are tried
  int threads = 0;
};

/// The seed of what judges; no bake here has it. Those of the bakes begin at the default.
constexpr std::uint64_t kJudge = 0x5EED, kFirstSeed = 1;
constexpr int kLeastRays = 16, kMostRays = 4096;
/// Methods are told no lower tolerance: below, all that counts on smooth meshes is the number of rays.
constexpr double kLeastTolerance = 0.003;
/// Rays whose noise does not count beside what interpolation misses.
constexpr int kPlentyOfRays = 8192;
/// Twice the rays that lower the error by less than this share: what is left lies between the vertices.
constexpr double kFlatOut = 0.03;

/// A bake, what it took, and how far it is from the truth.
struct Trial {
  AutoBake bake;
  double seconds = 0;  // CPU time
  double rays = 0;     // traced in all
  SurfaceError error;

  /// The rays of the vertices and of what their values are fitted to; not those that chose the setting or judged it.
  double cost() const {
    const double vertices = static_cast<double>(bake.baked.transfer.size()) * bake.baked.facts.rays;
    return vertices + (bake.baked.fit ? bake.baked.fit->fittedRays : 0);
  }
};

/// A setting made by hand: edges of one length, rays and fit.
struct Setting {
  double length = 0;
  int rays = 0;
  FitKind fit = FitKind::vertex;
  double cost = std::numeric_limits<double>::infinity(), seconds = cost;
  double error = 0;
};

/// The least cost and the least CPU time at which a setting meets a tolerance.
struct Best {
  Setting byCost, bySeconds;
};

Mesh meshOf(const std::string& name) {
  return name == "corner" ? shapes::corner() : namedMesh(name);
}

double extentOf(const Mesh& mesh) {
  Vec3d low = mesh.positions.at(0), high = low;
  for (const Vec3d& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

class SurfaceBench {
 public:
  SurfaceBench(const std::string& name, TransferKind kind, const Options& options)
      : options_(options), label_(labelOf(name)), mesh_(meshOf(name)), kind_(kind), parallel_(options.threads) {}

  void methodsRow() {
    const EqualTime equalTime([&](int rays) { bakeOnce(byHand(0, rays, FitKind::vertex)); }, options_.methodRays);
    const auto errorOfPoints = [&](int rays) { return errorOverSeeds(byHand(0, rays, FitKind::vertex)); };
    const double tolerance = std::max(kLeastTolerance, options_.methodShare * errorOfPoints(options_.methodRays));
    std::printf("%-24s %-14s %8zu %6.2f |", label_.c_str(), transferName(kind_), mesh_.positions.size(),
                100 * tolerance);
    for (const std::string& method : options_.methods) {
      const Bake bake = method == "fit"
                            ? byHand(0, options_.methodRays, FitKind::automatic)
                            : toTolerance(tolerance, method == "refined" ? FitKind::vertex : FitKind::automatic);
      EqualTime::Cost cost;
      const double error = errorOverSeeds(bake, [&] {
        const EqualTime::Cost ofSeed = equalTime.of([&] { bakeOnce(bake); });
        cost.seconds += ofSeed.seconds / options_.seeds;
        cost.rays += ofSeed.rays / options_.seeds;
      });
      const double points = errorBetweenGroups(cost.rays, errorOfPoints);
      std::printf(" %7.3f %7.3f %8.3fs %5.2f |", 100 * points, 100 * error, cost.seconds, error / points);
    }
    std::printf("\n");
    std::fflush(stdout);
  }

  /// E^2 = (a I)^2 + b sigma^2, maths.md (33): I of point sampling with plenty of rays, a of the fit with as many, and
  /// b where the vertices' noise is nearest to I.
  void leftRow() {
    const double missed = missedOf(timed(byHand(0, kPlentyOfRays, FitKind::vertex), options_.samples), 0.5);
    const double left = missedOf(timed(byHand(0, kPlentyOfRays, FitKind::automatic), options_.samples), 0.4);
    Trial few;
    double nearest = std::numeric_limits<double>::infinity();
    for (int rays = kLeastRays; rays <= kMostRays; rays *= 2) {
      Trial t = timed(byHand(0, rays, FitKind::automatic), options_.samples);
      const double distance = std::abs(std::log(t.bake.baked.facts.rmsError / missed));
      if (distance < nearest) {
        nearest = distance;
        few = std::move(t);
      }
    }
    const TransferFacts& facts = few.bake.baked.facts;
    const double ofNoise = (few.error.rms * few.error.rms - left * left) / (facts.rmsError * facts.rmsError);
    std::printf("%-24s %-14s %7.3f %5.2f | %6d %7.3f %5.2f |\n", label_.c_str(), transferName(kind_), 100 * missed,
                left / missed, facts.rays, 100 * facts.rmsError, ofNoise);
    std::fflush(stdout);
  }

  void toleranceRow(double tolerance) {
    const Trial t = timed(toTolerance(tolerance, FitKind::automatic), options_.samples);
    const TransferFacts& facts = t.bake.baked.facts;
    std::printf("%-24s %-14s %5.1f | %6.2f +-%4.2f %5.2f %-3s | %8zu %5d %8.2fM %7.2fs |", label_.c_str(),
                transferName(kind_), 100 * tolerance, 100 * t.error.rms, 50 * (t.error.high - t.error.low),
                t.error.rms / tolerance, t.bake.met ? "yes" : "no", t.bake.baked.transfer.size(), facts.rays,
                t.rays / 1e6, t.seconds);
    if (options_.sweep && t.bake.met) printBest(sweep(tolerance, t), t);
    if (!t.bake.met && !t.bake.baked.warnings.empty()) std::printf(" %s", t.bake.baked.warnings.back().c_str());
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  /// What a bake errs beside the noise of its vertices, `noise` of whose variance is left between them.
  static double missedOf(const Trial& t, double noise) {
    const double sigma = t.bake.baked.facts.rmsError;
    return std::sqrt(std::max(0.0, t.error.rms * t.error.rms - noise * sigma * sigma));
  }

  BakeMeshOptions bakeOptions(int rays, FitKind fit) const {
    BakeMeshOptions options;
    options.bake.kind = kind_;
    options.bake.order = options_.order;
    options.bake.rays = rays;
    options.bake.seed = seed_;
    options.fit.kind = fit;
    return options;
  }

  /// A way to bake, with the seed of the moment.
  using Bake = std::function<AutoBake(Progress&)>;

  Bake toTolerance(double tolerance, FitKind fit) {
    AutoBakeOptions choose;
    choose.tolerance = tolerance;
    choose.refinement.kind = RefinementOptions::Kind::automatic;
    return
        [=, this](Progress& progress) { return autoBake(mesh_, {}, bakeOptions(0, fit), choose, parallel_, progress); };
  }

  /// Edges of `length`, or the mesh as it is where that is 0.
  Bake byHand(double length, int rays, FitKind fit) {
    AutoBakeOptions choose;
    if (length > 0) {
      choose.refinement.kind = RefinementOptions::Kind::length;
      choose.refinement.length = length;
    }
    return [=, this](Progress& progress) {
      return autoBake(mesh_, {}, bakeOptions(rays, fit), choose, parallel_, progress);
    };
  }

  static void bakeOnce(const Bake& bake) {
    Progress silent;
    bake(silent);
  }

  /// The RMS over the seeds; `visit` is called with each of them.
  double errorOverSeeds(
      const Bake& bake, const std::function<void()>& visit = [] {}) {
    double squares = 0;
    for (int i = 0; i < options_.seeds; ++i) {
      seed_ = kFirstSeed + static_cast<std::uint64_t>(i);
      squares += std::pow(timed(bake, options_.samples).error.rms, 2) / options_.seeds;
      visit();
    }
    seed_ = kFirstSeed;
    return std::sqrt(squares);
  }

  /// Bakes and takes the time, then judges.
  Trial timed(const Bake& bake, std::size_t samples) {
    Trial trial;
    bool counted = false;  // the rays of this stage, whose end may be told twice
    Progress progress([&](const ProgressState& state) {
      if (state.done < state.total) counted = false;
      if (counted || state.unit != "rays" || state.done < state.total) return true;
      trial.rays += state.total;
      return counted = true;
    });
    const double start = chart::cpuSeconds();
    trial.bake = bake(progress);
    trial.seconds = chart::cpuSeconds() - start;
    trial.error = judge(trial.bake.baked, samples);
    return trial;
  }

  SurfaceError judge(const BakedMesh& baked, std::size_t samples) {
    BakedPly held{baked.mesh, baked.transfer, baked.facts, true, {}, {}};
    held.facts.seed = kJudge;
    if (held.facts.rays > 0) held.facts.rays = options_.truthRays;
    Progress progress;
    return measureSurfaceError(held, samples, parallel_, progress);
  }

  /// Tries edges from none on down, rays from few on up, with and without a fit, as far as the cost stays within reach
  /// of what `t` cost.
  Best sweep(double tolerance, const Trial& t) {
    Best best;
    const double most = options_.reach * t.cost();
    std::size_t last = 0;
    for (int level = 0;; ++level) {
      const std::size_t vertices = settingAt(level, kLeastRays, FitKind::vertex).second;
      if (static_cast<double>(vertices) * kLeastRays > most || vertices == last) return best;
      last = vertices;
      for (const FitKind fit : {FitKind::vertex, FitKind::surface}) {
        double before = std::numeric_limits<double>::infinity();
        for (int rays = kLeastRays; rays <= kMostRays && static_cast<double>(vertices) * rays <= most; rays *= 2) {
          const Setting& s = settingAt(level, rays, fit).first;
          if (s.error <= tolerance) {
            if (s.cost < best.byCost.cost) best.byCost = s;
            if (s.seconds < best.bySeconds.seconds) best.bySeconds = s;
            break;
          }
          if (s.error > (1 - kFlatOut) * before) break;
          before = s.error;
        }
      }
    }
  }

  /// A setting of the sweep and the vertices that it has; each is baked once.
  const std::pair<Setting, std::size_t>& settingAt(int level, int rays, FitKind fit) {
    const auto key = std::make_tuple(level, rays, fit);
    const auto known = settings_.find(key);
    if (known != settings_.end()) return known->second;
    Setting s;
    s.length = level == 0 ? 0 : extentOf(mesh_) / (2 * std::pow(2, 0.5 * level));
    s.rays = rays;
    s.fit = fit;
    const Trial t = timed(byHand(s.length, rays, fit), options_.sweepSamples);
    s.cost = t.cost();
    s.seconds = t.seconds;
    s.error = t.error.rms;
    return settings_.emplace(key, std::make_pair(s, t.bake.baked.transfer.size())).first->second;
  }

  void printBest(const Best& best, const Trial& t) const {
    if (best.byCost.rays == 0) {
      std::printf(" none within %g times the cost", options_.reach);
      return;
    }
    std::printf(" %8.4g %4d %-7s %5.2f | %5.2f %6.2f", best.byCost.length, best.byCost.rays,
                best.byCost.fit == FitKind::vertex ? "vertex" : "surface", 100 * best.byCost.error,
                t.cost() / best.byCost.cost, t.seconds / best.bySeconds.seconds);
  }

  const Options& options_;
  std::string label_;
  Mesh mesh_;
  TransferKind kind_;
  Parallel parallel_;
  std::uint64_t seed_ = kFirstSeed;
  std::map<std::tuple<int, int, FitKind>, std::pair<Setting, std::size_t>> settings_;
};

/// The project's own scenes, a corner of three squares, and scans and models where the folder has them.
std::vector<std::string> allMeshes() {
  std::vector<std::string> names{"corner"};
  for (const char* file : {"city.obj", "room.obj", "columns.obj", "bowl.ply"}) {
    names.push_back(SHBAKE_SCENES_DIR "/" + std::string(file));
  }
  for (const std::string& name : defaultMeshes(SHBAKE_SHARED_DIR "/meshes")) {
    if (name.find('/') != std::string::npos) names.push_back(name);
  }
  return names;
}

void run(const Options& o) {
  const auto has = [&](const char* table) {
    return std::find(o.tables.begin(), o.tables.end(), table) != o.tables.end();
  };
  const auto each = [&](const auto& visit) {
    for (const std::string& transfer : o.transfers) {
      for (const std::string& mesh : o.meshes) {
        SurfaceBench bench(mesh, transferKindOf(transfer).value(), o);
        visit(bench);
      }
    }
  };
  if (has("methods")) {
    std::printf(
        "order %d; error in %% between the vertices of point sampling and of the method in the same CPU time, "
        "that time, and their ratio\nfit: auto at %d rays; refined, auto: to a tolerance E of %g of the error of "
        "points "
        "with as many\n",
        o.order, o.methodRays, o.methodShare);
    std::printf("%-24s %-14s %8s %6s |", "mesh", "transfer", "vertices", "E %");
    for (const std::string& method : o.methods) std::printf(" %-31s |", method.c_str());
    std::printf("\n");
    each([](SurfaceBench& bench) { bench.methodsRow(); });
  }
  if (has("tolerances")) {
    std::printf(
        "order %d; tolerance, error with its 95 %% interval and its share of the tolerance, whether met; vertices, "
        "rays a vertex, all "
        "rays and CPU time%s\n",
        o.order, o.sweep ? "; the best setting by hand and the ratios of cost and time to the best" : "");
    each([&](SurfaceBench& bench) {
      for (const double tolerance : o.tolerances) bench.toleranceRow(tolerance);
    });
  }
  if (has("left")) {
    std::printf(
        "order %d; I: what interpolation misses, in %%, and a, what an automatic fit leaves of it; b, what it leaves "
        "of the "
        "variance of the vertices' noise sigma at these rays\n%-24s %-14s %7s %5s | %6s %7s %5s |\n",
        o.order, "mesh", "transfer", "I %", "a", "rays", "sigma %", "b");
    each([](SurfaceBench& bench) { bench.leftRow(); });
  }
}

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Compares refinement, fit and bakes to a tolerance with point sampling and settings by hand"};
  Options o;
  const auto list = [](CLI::Option* option) { option->delimiter(',')->allow_extra_args(false); };
  app.add_option("meshes", o.meshes, "files or generated meshes; default: all");
  list(app.add_option("--tables", o.tables, "methods, tolerances, left")
           ->check(CLI::IsMember({"methods", "tolerances", "left"})));
  list(app.add_option("--methods", o.methods, "columns of the table of methods: fit, refined, auto")
           ->check(CLI::IsMember({"fit", "refined", "auto"})));
  list(app.add_option("--transfers", o.transfers, "shadowed, interreflected")
           ->check(CLI::IsMember({"shadowed", "interreflected"})));
  list(app.add_option("--tolerances", o.tolerances, "surface errors to reach"));
  app.add_option("--method-share", o.methodShare,
                 "tolerance of the methods that are told one, as a share of the error of point sampling");
  app.add_option("--method-rays", o.methodRays, "rays a vertex of the fit");
  app.add_option("--seeds", o.seeds, "bakes of each method, over which errors are RMS and times means")
      ->check(CLI::Range(1, 1000));
  app.add_option("--order", o.order, "SH bands");
  app.add_option("--samples", o.samples, "places where errors are measured, an even number");
  app.add_option("--sweep-samples", o.sweepSamples, "places where errors of settings by hand are measured");
  app.add_option("--truth", o.truthRays, "a quarter of the rays of each of the two sets that measure there");
  app.add_flag("--sweep", o.sweep, "look for the best setting by hand: edge length, rays and fit");
  app.add_option("--reach", o.reach, "try settings up to this many times the cost");
  app.add_option("--threads", o.threads, "threads; 0: all");
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty()) o.meshes = allMeshes();
  try {
    run(o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_surface: %s\n", e.what());
    return 1;
  }
  return 0;
}
