// How fast baked meshes are relit: coefficient multiply-adds per second and core, by order and channels; under a rig of
// local lights, too. One multiply-add is a coefficient of the transfer times one of the light, for one channel of the
// result: order^2 x 3 a point.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "chart/methods/cpu_clock.h"
#include "view/relight.h"

namespace {

using namespace shbake;
using namespace shbake::chart;

constexpr int kRuns = 9;

float signedNoise(std::uint64_t seed, std::uint64_t i) {
  return static_cast<float>(2 * hashUnit(seed, i) - 1);
}

TransferSet noiseTransfer(int order, int channels, std::size_t points) {
  TransferSet set;
  set.order = order;
  set.channels = channels;
  set.coefficients.resize(points * set.stride());
  for (std::size_t i = 0; i < set.coefficients.size(); ++i) set.coefficients[i] = signedNoise(1, i);
  return set;
}

Light noiseLight(int order, std::uint64_t seed) {
  Light light(order);
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
    light.coefficients[i] = {signedNoise(seed, 3 * i), signedNoise(seed, 3 * i + 1), signedNoise(seed, 3 * i + 2)};
  }
  return light;
}

/// The median CPU time of `work` in seconds.
template <class Work>
double medianSeconds(Work&& work) {
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const double start = chart::cpuSeconds();
    work();
    seconds.push_back(chart::cpuSeconds() - start);
  }
  return chart::median(seconds);
}

void printRate(const char* name, const TransferSet& set, double seconds) {
  const double products = 3.0 * set.coefficientsPerChannel() * static_cast<double>(set.size());
  std::printf("%-28s %2d x %d %9zu points %8.2f ms %8.2f G multiply-adds/s\n", name, set.coefficientsPerChannel(),
              set.channels, set.size(), 1e3 * seconds, products / seconds / 1e9);
}

void measureDistant(int order, int channels, std::size_t points) {
  const TransferSet set = noiseTransfer(order, channels, points);
  const Light light = noiseLight(order, 2);
  const Parallel parallel(1);
  printRate("one light", set, medianSeconds([&] { relight(set, light, {}, parallel); }));
}

void measureRig(RigMethod method, std::size_t points) {
  const TransferSet set = noiseTransfer(5, 3, points);
  const auto place = [](std::uint64_t seed, std::uint64_t i) {
    return Vec3d{hashUnit(seed, 3 * i), hashUnit(seed, 3 * i + 1), hashUnit(seed, 3 * i + 2)};
  };
  std::vector<LightSample> samples;
  for (std::uint64_t i = 0; i < 8; ++i) samples.push_back({place(3, i), noiseLight(5, 10 + i)});
  std::vector<Vec3d> places;
  for (std::uint64_t p = 0; p < points; ++p) places.push_back(place(4, p));
  const LightRig rig(std::move(samples), {method});
  const Parallel parallel(1);
  printRate(method == RigMethod::barycentric ? "8 local lights, barycentric" : "8 local lights, distances", set,
            medianSeconds([&] { relight(set, places, rig, {}, parallel); }));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How fast baked meshes are relit, on one core");
  std::size_t points = 100000;
  app.add_option("--points", points, "points of the mesh (default 100000)")->check(CLI::Range(1000, 10000000));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const int order : {2, 3, 4, 5, 8}) {
      for (const int channels : {1, 3}) measureDistant(order, channels, points);
    }
    measureRig(RigMethod::inverseDistance, points);
    measureRig(RigMethod::barycentric, points);
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_relight: %s\n", error.what());
    return 1;
  }
}
