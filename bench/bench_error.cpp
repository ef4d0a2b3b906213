// bench_error: is the stated error true? Bakes meshes at several ray counts and compares the stated standard error of
// each point with its distance from a high-ray reference.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "bake/baker.h"
#include "bake/stated_error.h"
#include "chart/methods/cpu_clock.h"
#include "reference.h"
#include "scenes.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake::bench {
namespace {

struct Options {
  std::vector<std::string> meshes;
  std::vector<int> rays{64, 256, 1024};
  int order = 4;
  int referenceRays = 65536;
  std::size_t points = 400;
  bool interreflected = false;
  double albedo = 0.8;
};

struct Agreement {
  double statedRms = 0, trueRms = 0;
  double beyond3 = 0;  // share of points whose true error exceeds three times the stated one
};

/// Compares coefficients of the chosen points with a reference of the same layout, weighting by area.
Agreement compare(const TransferSet& baked, const std::vector<double>& reference, double albedo,
                  const std::vector<std::uint32_t>& chosen, const std::vector<double>& areas) {
  const auto count = static_cast<std::size_t>(baked.coefficientsPerChannel());
  const double norm = sh::unshadowedNorm(baked.order) * albedo;
  double stated = 0, truth = 0, area = 0, beyond = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto t = baked.at(chosen[i], 0);
    double e2 = 0;
    for (std::size_t k = 0; k < count; ++k) e2 += std::pow(static_cast<double>(t[k]) - reference[i * count + k], 2);
    const double w = areas[chosen[i]], s = static_cast<double>(baked.error[chosen[i]]), e = std::sqrt(e2) / norm;
    stated += w * s * s;
    truth += w * e * e;
    area += w;
    beyond += e > 3 * s ? 1 : 0;
  }
  return {std::sqrt(stated / area), std::sqrt(truth / area), beyond / static_cast<double>(chosen.size())};
}

/// The reference: shadowed points from many rays each, interreflected ones from a bake of the whole mesh.
std::vector<double> makeReference(const LightingPoints& points, const std::vector<std::uint32_t>& chosen,
                                  const Options& o, const Parallel& parallel) {
  if (!o.interreflected) {
    auto reference = directReference(points, chosen, o.order, o.referenceRays, parallel);
    for (double& v : reference) v *= o.albedo;
    return reference;
  }
  BakeOptions bake;
  bake.order = o.order;
  bake.rays = o.referenceRays;
  bake.seed = 0x5EED;
  bake.tolerance = 1e-3;
  Progress progress;
  const PointBake baked = bakePoints(points, {}, bake, parallel, progress);
  std::vector<double> reference;
  for (const std::uint32_t p : chosen) {
    for (const float v : baked.transfer.at(p, 0)) reference.push_back(static_cast<double>(v));
  }
  return reference;
}

void measure(const std::string& name, const Options& o, const Parallel& parallel) {
  const auto albedo = static_cast<float>(o.albedo);
  const LightingPoints points = namedPoints(name, {albedo, albedo, albedo});
  Progress progress;
  const auto chosen = choosePoints(points, o.points);
  const auto areas = pointAreas(points);
  const auto reference = makeReference(points, chosen, o, parallel);
  const std::string label = labelOf(name);
  for (const int rays : o.rays) {
    BakeOptions bake;
    bake.kind = o.interreflected ? TransferKind::interreflected : TransferKind::shadowed;
    bake.order = o.order;
    bake.rays = rays;
    const PointBake baked = bakePoints(points, {}, bake, parallel, progress);
    const Agreement g = compare(baked.transfer, reference, o.albedo, chosen, areas);
    std::printf("%-26s %7zu %6d %9.3f %9.3f %7.2f %9.2f\n", label.c_str(), points.size(), rays, 100 * g.statedRms,
                100 * g.trueRms, g.statedRms / g.trueRms, 100 * g.beyond3);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Compares stated standard errors with true ones"};
  Options o;
  app.add_option("meshes", o.meshes, "files or generated meshes; default: all");
  app.add_option("--rays", o.rays, "ray counts to judge, separated by commas")->delimiter(',')->allow_extra_args(false);
  app.add_option("--order", o.order, "SH bands");
  app.add_option("--reference", o.referenceRays, "rays a point of the reference");
  app.add_option("--points", o.points, "points of each mesh that are compared");
  app.add_option("--albedo", o.albedo, "uniform albedo");
  app.add_flag("--interreflected", o.interreflected, "with all reflections instead of the sky alone");
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty()) o.meshes = defaultMeshes(SHBAKE_SHARED_DIR "/meshes");
  try {
    const shbake::Parallel parallel;
    std::printf("order %d, %s; errors in %% of the unshadowed transfer\n", o.order,
                o.interreflected ? "interreflected" : "shadowed");
    std::printf("%-26s %7s %6s %9s %9s %7s %9s\n", "mesh", "points", "rays", "stated", "true", "ratio", ">3x in %");
    for (const std::string& mesh : o.meshes) measure(mesh, o, parallel);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_error: %s\n", e.what());
    return 1;
  }
  return 0;
}
