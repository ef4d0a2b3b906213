// How much memory the bake of a large mesh takes, stage by stage, on the way of `shbake bake`: from file to file.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "chart/methods/cpu_clock.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "mesh/ply_writer.h"
#include "pipeline/bake_mesh.h"
#include "support/shapes.h"
#include "transfer/baked_ply.h"

namespace shbake::bench {
namespace {

struct Options {
  int level = 9, rays = 16, threads = 0;
  std::size_t memory = 0;  // MB; 0: the default of a bake
  bool shadowed = false, inward = false;
  std::string folder = std::filesystem::temp_directory_path().string();
};

/// A figure of /proc/self/status in bytes, such as VmRSS.
std::size_t statusOf(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::stoull(line.substr(name.size() + 1)) * 1024;
  }
  return 0;
}

/// Lets VmHWM, the peak, begin anew at what is resident now.
void restartPeak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

double megabytes(std::size_t bytes) {
  return static_cast<double>(bytes) / 1e6;
}

/// Prints the peak of each stage, and keeps the highest.
class StagePeaks {
 public:
  ProgressCallback callback() {
    return [this](const ProgressState& state) {
      if (state.stage != stage_) {
        finish();
        stage_ = state.stage;
      }
      return true;
    };
  }

  void finish() {
    const std::size_t peak = statusOf("VmHWM");
    if (!stage_.empty()) {
      const std::string name = stage_.substr(0, stage_.find(' ', stage_.find(' ') + 1));
      std::printf("  %-24.24s %8.0f %8.0f\n", name.c_str(), megabytes(peak), megabytes(statusOf("VmRSS")));
    }
    highest_ = std::max(highest_, peak);
    stage_.clear();
    restartPeak();
  }

  std::size_t highest() const { return highest_; }

 private:
  std::string stage_;
  std::size_t highest_ = 0;
};

template <class T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// What a bake hands over: all that its caller holds afterwards.
std::size_t outputBytes(const BakedMesh& baked) {
  const Mesh& m = baked.mesh;
  std::size_t bytes = bytesOf(m.positions) + bytesOf(m.triangles) + bytesOf(m.vertexNormals);
  for (const Property& p : m.vertexProperties) bytes += bytesOf(p.values) + bytesOf(p.listStarts);
  const TransferSet& t = baked.transfer;
  return bytes + bytesOf(t.coefficients) + bytesOf(t.error) + bytesOf(t.visibility) + bytesOf(baked.sourceVertex);
}

void writeSphere(const Options& o, const std::string& path) {
  Progress progress;
  writePly(path, o.inward ? shapes::inwardSphere(o.level) : shapes::icosphere(o.level), {}, progress);
}

void measure(const Options& o, const std::string& in, const std::string& out) {
  std::printf("  %-24s %8s %8s\n", "stage", "peak MB", "after MB");
  StagePeaks peaks;
  Progress progress(peaks.callback());
  const Parallel parallel(o.threads);
  restartPeak();
  const double start = chart::wallSeconds();
  Mesh mesh = readMesh(in, progress);
  const std::size_t faces = mesh.triangles.size();
  checkMesh(mesh, progress);
  BakeMeshOptions options;
  options.bake.kind = o.shadowed ? TransferKind::shadowed : TransferKind::interreflected;
  options.bake.rays = o.rays;
  options.bake.memory = o.memory * 1'000'000;
  const double bakeStart = chart::wallSeconds();
  const BakedMesh baked = bakeMesh(std::move(mesh), {}, options, parallel, progress);
  const double bakeSeconds = chart::wallSeconds() - bakeStart;
  writeBakedPly(out, baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, {}, progress);
  peaks.finish();
  const std::size_t output = outputBytes(baked);
  std::printf(
      "%zu triangles, %d rays, %s: output %.0f MB, peak %.0f MB, %.0f MB beyond the output; %.1f s, bake %.1f s\n",
      faces, o.rays, transferName(options.bake.kind), megabytes(output), megabytes(peaks.highest()),
      megabytes(peaks.highest() - output), chart::wallSeconds() - start, bakeSeconds);
  for (const std::string& warning : baked.warnings) std::printf("  %s\n", warning.c_str());
}

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Measures the memory that the bake of a sphere takes, stage by stage"};
  Options o;
  app.add_option("--level", o.level, "divisions of the sphere: 20 * 4^LEVEL triangles; 9: 5.2 million");
  app.add_option("--rays", o.rays, "rays a point");
  app.add_option("--threads", o.threads, "0: all cores");
  app.add_option("--memory", o.memory, "budget of the bake in MB; 0: its default");
  app.add_option("--folder", o.folder, "for two files of some hundred MB, removed afterwards");
  app.add_flag("--shadowed", o.shadowed, "without reflections");
  app.add_flag("--inward", o.inward, "the sphere seen from inside, where every ray hits");
  CLI11_PARSE(app, argc, argv);
  const std::string in = o.folder + "/shbake_bench_memory.ply", out = o.folder + "/shbake_bench_memory_out.ply";
  int code = 0;
  try {
    writeSphere(o, in);
    ::malloc_trim(0);  // what making the mesh has left behind is not the bake's
    measure(o, in, out);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_memory: %s\n", e.what());
    code = 1;
  }
  std::filesystem::remove(in);
  std::filesystem::remove(out);
  return code;
}
