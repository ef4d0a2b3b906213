// Our directions as a set like those of the other methods: without the control variate, and with other exclusions.
#include "bake/direction_set.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {
namespace {

/// The diagonal's share that rays start off by, as renderers often choose it.
constexpr float kEpsilon = 1e-4f;

std::vector<WeightedDirection> fibonacci(int rays, std::uint64_t) {
  const DirectionSet set(rays, 1);
  std::vector<WeightedDirection> all;
  for (int i = 0; i < set.size(); ++i) {
    all.push_back({{double(set.x()[i]), double(set.y()[i]), double(set.z()[i])}, 1.0 / set.size()});
  }
  return all;
}

Estimate estimateFrom(const TestBed& bed, const Task& task, Progress& progress, const EmbreeScene& scene,
                      const PlainStart& start) {
  PlainView view(bed.points(), scene, start);
  return estimatePlainly(bed, task, progress, makeSets(task, fibonacci, Sets::one), view);
}

}  // namespace

Estimate estimatePlainFibonacci(const TestBed& bed, const Task& task, Progress& progress) {
  return estimateExactly(bed, task, progress, makeSets(task, fibonacci, Sets::one));
}

Estimate estimateNearEpsilon(const TestBed& bed, const Task& task, Progress& progress) {
  const EmbreeScene& scene = bed.bare();
  return estimateFrom(bed, task, progress, scene, {.near = kEpsilon * scene.diagonal()});
}

Estimate estimateNormalOffset(const TestBed& bed, const Task& task, Progress& progress) {
  const EmbreeScene& scene = bed.bare();
  return estimateFrom(bed, task, progress, scene, {.offset = kEpsilon * scene.diagonal()});
}

Estimate estimateNeighboursOut(const TestBed& bed, const Task& task, Progress& progress) {
  const EmbreeScene& scene = bed.neighboursOut();
  return estimateFrom(bed, task, progress, scene, {.near = scene.nearDistance()});
}

}  // namespace shbake::chart
