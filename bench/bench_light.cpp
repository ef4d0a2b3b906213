// How fast environment maps become light: pixels per second and core for each layout and order, from rows made on
// demand; with --huge FOLDER also a 16384 x 8192 file written there (512 MB, removed afterwards), with the peak of
// memory.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/hash.h"
#include "base/memory.h"
#include "chart/methods/cpu_clock.h"
#include "light/environment_map.h"

namespace {

using namespace shbake;
using namespace shbake::chart;

/// A map of noise whose rows repeat after `kPeriod`, so that making them costs next to nothing beside their projection.
MapRows noiseRows(int width, int height) {
  constexpr int kPeriod = 64;
  std::vector<Rgb> noise(static_cast<std::size_t>(width) * kPeriod);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const auto value = [&](std::uint64_t channel) { return static_cast<float>(hashUnit(channel, i)); };
    noise[i] = {value(0), value(1), value(2)};
  }
  MapRows rows;
  rows.name = "noise";
  rows.width = width;
  rows.height = height;
  rows.read = [width, noise = std::move(noise)](int begin, int end, std::span<Rgb> out) {
    for (int y = begin; y < end; ++y) {
      const auto from = noise.begin() + static_cast<std::ptrdiff_t>(y % kPeriod) * width;
      std::copy(from, from + width, out.begin() + static_cast<std::ptrdiff_t>(y - begin) * width);
    }
  };
  return rows;
}

void measureLayout(MapLayout layout, int width, int height) {
  std::printf("%-17s %5d x %5d", layoutName(layout), width, height);
  const MapRows rows = noiseRows(width, height);
  EnvironmentMapOptions options;
  options.layout = layout;
  const Parallel parallel(1);
  for (const int order : {2, 3, 4, 8, 16}) {
    std::vector<double> seconds;
    double all = 0;
    // The first runs of small maps, with cold caches, are soon few among many.
    while (seconds.size() < 3 || all < 0.1) {
      Progress progress;
      const double start = chart::cpuSeconds();
      projectEnvironmentMap(rows, order, options, parallel, progress);
      seconds.push_back(chart::cpuSeconds() - start);
      all += seconds.back();
    }
    std::printf(" %8.1f", static_cast<double>(width) * height / chart::median(seconds) / 1e6);
  }
  std::printf("\n");
}

/// A Radiance file of `width` x `height` pixels without run-length coding.
void writeRadiance(const std::string& path, int width, int height) {
  std::ofstream out(path, std::ios::binary);
  out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << height << " +X " << width << "\n";
  std::vector<char> row(static_cast<std::size_t>(width) * 4);
  for (int y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      // Mantissas of 128..255 and an exponent for values of 0.5..1.
      row[i] = static_cast<char>(i % 4 == 3 ? 128 : 128 + hashBits(static_cast<std::uint64_t>(y), i) % 128);
    }
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  out.flush();
  if (!out) throw Error({.file = path, .cause = "cannot be written", .remedy = "name a folder with 600 MB free"});
}

void measureHuge(const std::string& folder) {
  const int width = 16384, height = 8192;
  const std::string path = folder + "/shbake_bench_light.hdr";
  writeRadiance(path, width, height);
  const Parallel parallel;
  Progress progress;
  const double cpu = chart::cpuSeconds(), wall = chart::wallSeconds();
  projectEnvironmentMap(path, 4, {}, parallel, progress);
  std::printf("%d x %d Radiance file, order 4: %.2f s CPU, %.2f s on %d threads, peak memory of the process %.0f MB\n",
              width, height, chart::cpuSeconds() - cpu, chart::wallSeconds() - wall, parallel.threads(),
              static_cast<double>(peakMemory()) / 1e6);
  std::filesystem::remove(path);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How fast environment maps become light");
  std::string huge;
  app.add_option("--huge", huge, "folder for a map of 16384 x 8192 pixels to measure too");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!huge.empty()) measureHuge(huge);
    std::printf("million pixels per second and core, by order        2        3        4        8       16\n");
    measureLayout(MapLayout::latLong, 4096, 2048);
    measureLayout(MapLayout::latLong, 1024, 512);
    measureLayout(MapLayout::angular, 2048, 2048);
    measureLayout(MapLayout::angular, 512, 512);
    measureLayout(MapLayout::angular, 256, 256);
    measureLayout(MapLayout::stripHorizontal, 6144, 1024);
    measureLayout(MapLayout::stripHorizontal, 1536, 256);
    measureLayout(MapLayout::crossVertical, 768, 1024);
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_light: %s\n", error.what());
    return 1;
  }
}
