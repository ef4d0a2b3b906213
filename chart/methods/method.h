// The ways to bake shadowed transfer that are charted against each other, behind one interface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/ray_scene.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "chart/methods/embree_scene.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// A mesh made ready for all methods. `points` must outlive it.
class TestBed {
 public:
  /// Builds the scenes and searches for contacts on the threads of `parallel`.
  TestBed(const LightingPoints& points, const Parallel& parallel, Progress& progress);

  const LightingPoints& points() const { return points_; }
  /// What shbake traces: neighbours and contacts left out exactly (bake/ray_scene.h).
  const RayScene& exact() const { return *exact_; }
  /// Nothing left out.
  const EmbreeScene& bare() const { return bare_; }
  /// Faces that touch the ray's own position left out, and nothing put in their place: Green's rule.
  const EmbreeScene& neighboursOut() const { return neighboursOut_; }
  /// CPU seconds that all of `exact` takes beyond its BVH: the search for contacts.
  double contactSeconds() const { return contactSeconds_; }
  /// CPU seconds that its BVH takes, which every method needs.
  double buildSeconds() const { return buildSeconds_; }

 private:
  const LightingPoints& points_;
  double contactSeconds_ = 0, buildSeconds_ = 0;
  std::unique_ptr<RayScene> exact_;
  EmbreeScene bare_, neighboursOut_;
};

/// What a method is asked for.
struct Task {
  std::span<const std::uint32_t> chosen;  ///< lighting points, in the order in which they are baked
  int order = 4;                          ///< SH bands
  int rays = 256;                         ///< the method's own measure of effort
  std::uint64_t seed = 1;                 ///< another seed, another sample of the same expectation
};

/// What it answers.
struct Estimate {
  std::vector<float> transfer;  ///< of albedo 1: chosen points x order^2
  double cpu = 0;  ///< CPU seconds for all points of the mesh, scaled up from the chosen ones: tracing, summing and the
                   ///< search for contacts where the method needs it, without the BVH and the tables of directions
  double rays = 0;  ///< rays traced a point, on average
};

/// Works on the calling thread. `progress` counts chosen points and cancels.
using EstimateFunction = Estimate (*)(const TestBed& bed, const Task& task, Progress& progress);

/// What a method is there to show.
enum class MethodGroup {
  ours,        ///< what `shbake bake` does
  directions,  ///< other directions, all else as ours
  exclusion,   ///< other ways to leave out what a ray starts from, all else as ours
  programs,    ///< loops of other programs
};

inline constexpr std::array kAllGroups{MethodGroup::ours, MethodGroup::directions, MethodGroup::exclusion,
                                       MethodGroup::programs};

struct Method {
  const char* id;      ///< in files: "cosine-jittered"
  const char* title;   ///< in legends: "cosine, jittered"
  const char* detail;  ///< a line for tables
  MethodGroup group;
  /// Whether its error tends to zero with the rays on every mesh.
  bool consistent;
  EstimateFunction estimate;
};

/// All of them, ours first.
std::span<const Method> allMethods();
/// The one of this name; throws a usage error that lists the names.
const Method& methodNamed(std::string_view id);

// One file each.
Estimate estimateShbake(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimatePlainFibonacci(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateCosineRandom(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateCosineJittered(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateCosineSobol(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateCosineHammersley(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateGaussProduct(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateNearEpsilon(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateNormalOffset(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateNeighboursOut(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateGreen(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateLibigl(const TestBed& bed, const Task& task, Progress& progress);
Estimate estimateMeshLab(const TestBed& bed, const Task& task, Progress& progress);

}  // namespace shbake::chart
