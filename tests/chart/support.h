// What the tests of charts share: a mesh ready for all methods, and a folder of its own for files.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "chart/methods/method.h"
#include "support/shapes.h"

namespace shbake::testing {

inline LightingPoints pointsOf(const Mesh& mesh) {
  Progress progress;
  return makeLightingPoints(mesh, {}, {}, progress);
}

/// A mesh, its points, all of them chosen, and the scenes of all methods.
struct Bench {
  Progress progress;
  LightingPoints points;
  std::vector<std::uint32_t> all;
  chart::TestBed bed;

  explicit Bench(const Mesh& mesh) : points(pointsOf(mesh)), all(points.size()), bed(points, Parallel(1), progress) {
    std::iota(all.begin(), all.end(), 0u);
  }

  chart::Estimate run(const chart::Method& method, int order, int rays, std::uint64_t seed) {
    return method.estimate(bed, {all, order, rays, seed}, progress);
  }
};

/// A new folder that goes with all in it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "shbake-chart-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace shbake::testing
