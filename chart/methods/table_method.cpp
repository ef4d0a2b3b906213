// Estimates from tables of local directions.
#include "chart/methods/table_method.h"

#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "chart/methods/cpu_clock.h"
#include "sh/basis.h"
#include "sh/local_frame.h"

namespace shbake::chart {
namespace {

constexpr std::size_t kStretch = 64, kTables = 16;
constexpr std::size_t kCancelStep = 16;  // points between two looks at the progress

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

Estimate estimateByTable(const TestBed& bed, const Task& task, Progress& progress, const MakeSet& makeSet,
                         Tables tables, PointView& view) {
  const LightingPoints& points = bed.points();
  std::vector<DirectionTable> bank;
  for (std::size_t t = 0; t < (tables == Tables::one ? 1 : kTables); ++t) {
    bank.emplace_back(makeSet(task.rays, hashBits(task.seed, t)), task.order);
  }
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  const sh::FrameRotation rotation(task.order);
  std::vector<std::uint16_t> sky(static_cast<std::size_t>(bank[0].groups()));
  std::vector<double> local(count), world(count);
  Estimate result;
  result.transfer.resize(task.chosen.size() * count);
  const double cpu = timedOverPoints(task.chosen, progress, [&](std::uint32_t p, std::size_t i) {
    const DirectionTable& table = bank[p / kStretch % bank.size()];
    const double spin = 2 * std::numbers::pi * hashUnit(task.seed, p);
    const Vec3d normal(points.pointNormal[p]);
    view.look(p, table, sh::localFrame(normal, spin), sky);
    table.sum(sky, local);
    rotation.toWorld(normal, spin, local, world);
    for (std::size_t k = 0; k < count; ++k) result.transfer[i * count + k] = static_cast<float>(world[k]);
  });
  result.cpu = cpu * static_cast<double>(points.size()) / static_cast<double>(task.chosen.size());
  result.rays = bank[0].size();
  return result;
}

Estimate estimateByExactTable(const TestBed& bed, const Task& task, Progress& progress, const MakeSet& makeSet,
                              Tables tables) {
  ExactView view(bed);
  Estimate result = estimateByTable(bed, task, progress, makeSet, tables, view);
  result.cpu += bed.contactSeconds();
  return result;
}

}  // namespace shbake::chart
