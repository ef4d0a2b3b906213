// bench_speed: how close a bake comes to the tracing limit, how it scales, and how it compares with Green's loop at
// equal error. Everything that a ratio compares is measured in this one run, in CPU time, as the median of several
// repetitions.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "bake/baker.h"
#include "bake/stated_error.h"
#include "chart/methods/cpu_clock.h"
#include "chart/methods/method.h"
#include "raw_tracing.h"
#include "reference.h"
#include "scenes.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake::bench {
namespace {

struct Options {
  std::vector<std::string> meshes;
  int repetitions = 5;
  bool skipGreen = false;
};

/// CPU seconds of a bake's stages, without the BVH. The search for contacts counts as tracing: raw rays go without;
/// turning masks into transfer, where that waits for the end of tracing, as reflecting.
struct BakeTime {
  double tracing = 0, reflecting = 0, wall = 0;
  double alone = 0;  // CPU seconds of all stages that run on one thread, the BVH of a small mesh among them
};

double tracingSeconds(const chart::StageClock& clock) {
  return clock.seconds("searching contacts") + clock.seconds("tracing");
}

BakeTime timeBake(const LightingPoints& points, const BakeOptions& options, int threads) {
  chart::StageClock clock;
  Progress progress(clock.callback());
  const Parallel parallel(threads);
  const double wall = chart::wallSeconds(), cpu = chart::cpuSeconds();
  bakePoints(points, {}, options, parallel, progress);
  clock.finish();
  const double tracing = tracingSeconds(clock);
  const double reflecting = clock.seconds("evaluating") + clock.seconds("reflecting");
  return {tracing, reflecting, chart::wallSeconds() - wall, chart::cpuSeconds() - cpu - tracing - reflecting};
}

void overRaw(const std::string& label, const LightingPoints& points, int rays, int repetitions) {
  BakeOptions options;
  options.kind = TransferKind::shadowed;
  options.order = 5;
  options.rays = rays;
  const DirectionSet directions(rays, options.order);
  std::vector<double> overFiltered, overBare, rate;
  for (int i = 0; i < repetitions; ++i) {
    const double filtered = rawTracing(points, directions, options.seed, true);
    const double bake = timeBake(points, options, 1).tracing;
    const double bare = rawTracing(points, directions, options.seed, false);
    overFiltered.push_back(bake / filtered);
    overBare.push_back(bake / bare);
    rate.push_back(static_cast<double>(points.size()) * rays / bake / 1e6);
  }
  std::printf("%-24s %7zu %5d %8.2f %10.3f %10.3f\n", label.c_str(), points.size(), rays, chart::median(rate),
              chart::median(overFiltered), chart::median(overBare));
  std::fflush(stdout);
}

void scaling(const std::string& label, const LightingPoints& points, int repetitions) {
  BakeOptions shadowed;
  shadowed.kind = TransferKind::shadowed;
  shadowed.rays = 256;
  BakeOptions reflected = shadowed;
  reflected.kind = TransferKind::interreflected;
  reflected.bounces = 3;
  std::vector<double> threads, bound, bounces;
  for (int i = 0; i < repetitions; ++i) {
    const BakeTime one = timeBake(points, shadowed, 1), two = timeBake(points, shadowed, 2),
                   three = timeBake(points, reflected, 1);
    threads.push_back(one.wall / two.wall);
    // Amdahl's law: what two threads can gain at most.
    bound.push_back((one.alone + one.tracing) / (one.alone + one.tracing / 2));
    bounces.push_back((three.tracing + three.reflecting) / one.tracing);
  }
  std::printf("%-24s %14.2f %10.2f %22.2f\n", label.c_str(), chart::median(threads), chart::median(bound),
              chart::median(bounces));
  std::fflush(stdout);
}

double relativeError(const std::vector<double>& reference, const std::vector<double>& estimate, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) sum += std::pow(estimate[i] - reference[i], 2);
  const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
  return std::sqrt(sum / static_cast<double>(reference.size() / count)) / sh::unshadowedNorm(order);
}

/// CPU time against error of our bake at several ray counts; interpolated between them as a power law.
struct Curve {
  std::vector<double> error, cpu;

  double cpuAt(double e) const {
    std::size_t i = 1;
    while (i + 1 < error.size() && error[i] > e) ++i;
    const double t = std::log(e / error[i - 1]) / std::log(error[i] / error[i - 1]);
    return cpu[i - 1] * std::pow(cpu[i] / cpu[i - 1], t);
  }
};

Curve ourCurve(const LightingPoints& points, const std::vector<std::uint32_t>& chosen,
               const std::vector<double>& reference, std::size_t count, int repetitions) {
  Curve curve;
  for (const int rays : {16, 32, 64, 128, 256, 512, 1024}) {
    std::vector<double> errors, times;
    for (int i = 0; i < repetitions; ++i) {
      BakeOptions options;
      options.kind = TransferKind::shadowed;
      options.order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
      options.rays = rays;
      options.seed = static_cast<std::uint64_t>(i + 1);
      chart::StageClock clock;
      Progress progress(clock.callback());
      const PointBake baked = bakePoints(points, {}, options, Parallel(1), progress);
      clock.finish();
      std::vector<double> estimate;
      for (const std::uint32_t p : chosen) {
        for (const float v : baked.transfer.at(p, 0)) estimate.push_back(static_cast<double>(v));
      }
      errors.push_back(relativeError(reference, estimate, count));
      times.push_back(tracingSeconds(clock));
    }
    curve.error.push_back(chart::median(errors));
    curve.cpu.push_back(chart::median(times));
  }
  return curve;
}

void againstGreen(const std::string& label, const LightingPoints& points, int repetitions) {
  constexpr int kOrder = 4;
  const auto count = static_cast<std::size_t>(sh::coefficientCount(kOrder));
  const auto chosen = choosePoints(points, 400);
  const auto timed = choosePoints(points, 4000);
  const auto reference = directReference(points, chosen, kOrder, 65536, Parallel(1));
  const Curve ours = ourCurve(points, chosen, reference, count, std::min(repetitions, 3));
  Progress progress;
  const chart::TestBed bed(points, Parallel(1), progress);
  for (const int samples : {256, 576, 1024, 2304}) {
    std::vector<double> errors, times;
    for (int i = 0; i < repetitions; ++i) {
      const auto seed = static_cast<std::uint64_t>(i + 1);
      const chart::Estimate judged = chart::estimateGreen(bed, {chosen, kOrder, samples, seed}, progress);
      errors.push_back(relativeError(reference, {judged.transfer.begin(), judged.transfer.end()}, count));
      times.push_back(chart::estimateGreen(bed, {timed, kOrder, samples, seed}, progress).cpu);
    }
    const double error = chart::median(errors), green = chart::median(times), own = ours.cpuAt(error);
    std::printf("%-24s %8d %8.3f %10.3f %10.3f %10.2f\n", label.c_str(), samples, 100 * error, green, own, green / own);
    std::fflush(stdout);
  }
}

void run(const Options& o) {
  std::printf("Shadowed bake, order 5, 3 channels, one thread: CPU time over Embree's alone for the same rays\n");
  std::printf("%-24s %7s %5s %8s %10s %10s\n", "mesh", "points", "rays", "Mray/s", "filtered", "unfiltered");
  for (const std::string& name : o.meshes) {
    const LightingPoints points = namedPoints(name, {0.3f, 0.5f, 0.7f});
    for (const int rays : {64, 256, 1024}) overRaw(labelOf(name), points, rays, o.repetitions);
  }
  std::printf(
      "\nOrder 4, 1 channel, 256 rays: wall time of one thread over two, and what it can be by the CPU time of the "
      "stages that run on one; CPU time of 3 bounces over none\n");
  std::printf("%-24s %14s %10s %22s\n", "mesh", "1 / 2 threads", "at most", "3 bounces / shadowed");
  for (const std::string& name : o.meshes) scaling(labelOf(name), namedPoints(name, {0.8f, 0.8f, 0.8f}), o.repetitions);
  if (o.skipGreen) return;
  std::printf(
      "\nGreen's loop and this bake (order 4, 1 channel) at his error: CPU seconds for all points, without the BVH\n");
  std::printf("%-24s %8s %8s %10s %10s %10s\n", "mesh", "samples", "error %", "Green", "shbake", "ratio");
  for (const std::string& name : o.meshes) againstGreen(labelOf(name), namedPoints(name, {1, 1, 1}), o.repetitions);
}

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Compares a bake with the tracing limit, with one thread and with Green's loop"};
  Options o;
  app.add_option("meshes", o.meshes, "files or generated meshes; default: all");
  app.add_option("--repetitions", o.repetitions, "measurements of which the median counts");
  app.add_flag("--skip-green", o.skipGreen, "leave out the comparison with Green's loop");
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty()) o.meshes = defaultMeshes(SHBAKE_SHARED_DIR "/meshes");
  try {
    run(o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_speed: %s\n", e.what());
    return 1;
  }
  return 0;
}
