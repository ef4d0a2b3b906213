// Estimates from sets of local directions.
#include "chart/methods/table_method.h"

#include <numbers>

#include "bake/direct_transfer.h"
#include "bake/flush_denormals.h"
#include "bake/point_tracer.h"
#include "base/hash.h"
#include "chart/methods/cpu_clock.h"
#include "sh/basis.h"
#include "sh/local_frame.h"

namespace shbake::chart {
namespace {

constexpr std::size_t kStretch = 64, kSets = 16;
constexpr std::size_t kCancelStep = 16;  // points between two looks at the progress

/// look(point, set, spin, sky) fills the masks of a point in the directions of a set.
template <class Look>
Estimate estimateBy(const TestBed& bed, const Task& task, Progress& progress, const std::vector<DirectionSet>& sets,
                    const Look& look) {
  const LightingPoints& points = bed.points();
  std::vector<DirectTransfer> direct;
  for (const DirectionSet& set : sets) direct.emplace_back(set);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  std::vector<std::uint16_t> sky(static_cast<std::size_t>(sets[0].groups()));
  Estimate result;
  result.transfer.resize(task.chosen.size() * count);
  const double cpu = timedOverPoints(task.chosen, progress, [&](std::uint32_t p, std::size_t i) {
    const std::size_t set = p / kStretch % sets.size();
    // The turn of PointTracer::spin().
    const double spin = 2 * std::numbers::pi * hashUnit(task.seed, p);
    look(p, set, spin, std::span(sky));
    direct[set].evaluate({sky, Vec3d(points.pointNormal[p]), spin}, {&result.transfer[i * count], count});
  });
  result.cpu = cpu * static_cast<double>(points.size()) / static_cast<double>(task.chosen.size());
  result.rays = sets[0].size();
  return result;
}

}  // namespace

double timedOverPoints(std::span<const std::uint32_t> chosen, Progress& progress,
                       const std::function<void(std::uint32_t point, std::size_t i)>& body) {
  const FlushDenormals flush;
  const double start = threadCpuSeconds();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    body(chosen[i], i);
    if ((i + 1) % kCancelStep == 0) progress.advance(kCancelStep);
  }
  progress.advance(static_cast<double>(chosen.size() % kCancelStep));
  return threadCpuSeconds() - start;
}

std::vector<DirectionSet> makeSets(const Task& task, const MakeSet& makeSet, Sets sets) {
  std::vector<DirectionSet> all;
  for (std::size_t i = 0; i < (sets == Sets::one ? 1 : kSets); ++i) {
    all.emplace_back(makeSet(task.rays, hashBits(task.seed, i)), task.order);
  }
  return all;
}

Estimate estimateExactly(const TestBed& bed, const Task& task, Progress& progress,
                         const std::vector<DirectionSet>& sets) {
  std::vector<PointTracer> tracers;
  for (const DirectionSet& set : sets) tracers.emplace_back(bed.points(), bed.exact(), set, task.seed, false);
  Estimate result = estimateBy(bed, task, progress, sets,
                               [&](std::uint32_t p, std::size_t set, double, auto sky) { tracers[set].look(p, sky); });
  result.cpu += bed.contactSeconds();
  return result;
}

Estimate estimatePlainly(const TestBed& bed, const Task& task, Progress& progress,
                         const std::vector<DirectionSet>& sets, PlainView& view) {
  return estimateBy(bed, task, progress, sets, [&](std::uint32_t p, std::size_t set, double spin, auto sky) {
    view.look(p, sets[set], sh::localFrame(Vec3d(bed.points().pointNormal[p]), spin), sky);
  });
}

}  // namespace shbake::chart
