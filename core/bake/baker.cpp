#include "bake/baker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bake/direct_transfer.h"
#include "bake/fixed_point.h"
#include "bake/flush_denormals.h"
#include "bake/pilot.h"
#include "bake/ray_scene.h"
#include "bake/reflection_memory.h"
#include "bake/reflections.h"
#include "bake/stated_error.h"
#include "bake/traced_points.h"
#include "base/memory.h"
#include "base/passes.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

/// Reflections are summed until what is missing is this small a part of the tolerance on the stated error.
constexpr double kSolverShare = 0.1;
constexpr int kMaxSolverSteps = 200;
constexpr std::size_t kColumns = ReflectionMemory::kColumns;
/// Points that one worker looks from at a time, at least.
constexpr std::size_t kSkyBlock = 16;

class Baker {
 public:
  Baker(TracedPoints& points, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
        const Parallel& parallel, Progress& progress)
      : traced_(points),
        points_(points.points()),
        wanted_(wanted),
        options_(options),
        parallel_(parallel),
        progress_(progress) {
    result_.transfer.order = options.order;
    result_.transfer.channels = hasColor() ? 3 : 1;
  }

  PointBake run() {
    if (options_.kind == TransferKind::unshadowed) {
      bakeUnshadowed();
    } else {
      bakeTraced();
    }
    summarise();
    return std::move(result_);
  }

 private:
  /// Whether reflections are part of the transfer: only then do points that are not wanted colour those that are.
  bool reflects() const { return options_.kind == TransferKind::interreflected && options_.bounces != 0 && !isBlack(); }
  bool hasColor() const {
    const bool all = reflects();
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (isColored(points_.pointAlbedo[p]) && (all || isWanted(p))) return true;
    }
    return false;
  }
  bool isBlack() const {
    return std::all_of(points_.pointAlbedo.begin(), points_.pointAlbedo.end(), [](const Rgb& a) { return a == Rgb(); });
  }
  bool isWanted(std::size_t p) const { return wanted_.empty() || wanted_[p] != 0; }
  std::size_t count() const { return static_cast<std::size_t>(sh::coefficientCount(options_.order)); }

  /// Writes a point's direct transfer of albedo 1, times its albedo, to every channel.
  void store(std::size_t p, std::span<const float> direct) {
    const Rgb& albedo = points_.pointAlbedo[p];
    const float channel[] = {albedo.x, albedo.y, albedo.z};
    float* out = &result_.transfer.coefficients[p * result_.transfer.stride()];
    for (int c = 0; c < result_.transfer.channels; ++c) {
      for (const float value : direct) *out++ = channel[c] * value;
    }
  }

  /// Makes room for the result: after the BVH is built, which needs the memory only while it is.
  void allocate() {
    result_.transfer.coefficients.resize(points_.size() * result_.transfer.stride());
    result_.transfer.error.assign(points_.size(), 0);
    result_.transfer.visibility.assign(points_.size(), 1);
  }

  void bakeUnshadowed() {
    allocate();
    progress_.begin("evaluating", static_cast<double>(points_.size()), "points");
    parallel_.forBlocks(points_.size(), 1024, [&](std::size_t begin, std::size_t end, int) {
      std::vector<double> exact(count());
      std::vector<float> direct(count());
      for (std::size_t p = begin; p < end; ++p) {
        sh::unshadowedTransfer(options_.order, normalized(Vec3d(points_.pointNormal[p])), 1, exact);
        std::copy(exact.begin(), exact.end(), direct.begin());
        store(p, direct);
      }
      progress_.advance(static_cast<double>(end - begin));
    });
    progress_.end();
  }

  void bakeTraced() {
    const float maxDistance = static_cast<float>(options_.maxDistance * points_.frame.scale);
    const RayScene scene(points_, traced_.tree(), traced_.contacts(), maxDistance);
    const int rays =
        options_.rays > 0 ? options_.rays : chooseRays(points_, wanted_, scene, options_, parallel_, progress_);
    const DirectionSet directions(rays, options_.order);
    result_.rays = directions.size();
    pairs_.assign(points_.size(), 0);
    if (reflects()) {
      bakeReflected(scene, directions);
    } else {
      allocate();
      traceSky(scene, directions);
    }
    if (!traced_.keepsForMore()) traced_.free();
    result_.transfer.error = statedErrors(points_, pairs_, roughness_, result_.rays, options_.order, progress_);
  }

  /// Traces with hits and adds reflections; frees the tree before that takes memory, unless it is of use again.
  void bakeReflected(const RayScene& scene, const DirectionSet& directions) {
    const ReflectionMemory memory(options_.memory, availableMemory(), points_.size(), paddedCount());
    Reflections reflections(points_, scene, directions, options_.seed, options_.twoSided, memory.hitsWhileTracing(),
                            parallel_);
    // Beside the BVH and the hits, masks take less than the result that they will be turned into, unless rays are many.
    const auto groups = static_cast<std::size_t>(directions.groups());
    const bool turnLater = groups * sizeof(std::uint16_t) < result_.transfer.stride() * sizeof(float);
    std::vector<std::uint16_t> skies(turnLater ? points_.size() * groups : 0);
    if (!turnLater) allocate();
    traceWithHits(reflections, directions, skies);
    const ReflectionMemory::Share share = memory.shareOut(reflections.hitBytes());
    reflections.forget(share.hits);
    result_.storedBytes = reflections.storedBytes();
    result_.retracedPoints = reflections.forgottenPoints();
    result_.wantedMemory = memory.sufficient(reflections.hitBytes());
    // Its memory is more than the solver takes.
    const bool stays =
        traced_.keepsForMore() && memory.hasRoomBeside(share, reflections.storedBytes(), traced_.tree().bytes());
    if (reflections.forgottenPoints() == 0 && !stays) traced_.free();
    if (turnLater) {
      allocate();
      evaluateAll(directions, skies);
      skies = std::vector<std::uint16_t>();  // {} would keep the memory
    }
    addReflections(reflections, share.columns);
    measureRoughness(reflections);
  }

  /// What one worker needs to turn sky masks into transfer.
  struct Evaluator {
    DirectTransfer direct;
    std::vector<float> rows;  // of four points
  };

  std::vector<Evaluator> makeEvaluators(const DirectionSet& directions) const {
    return std::vector<Evaluator>(static_cast<std::size_t>(parallel_.threads()),
                                  {DirectTransfer(directions), std::vector<float>(4 * count())});
  }

  /// Stores what points get, whose masks follow each other in `skies`.
  void evaluate(Evaluator& e, std::span<const std::uint32_t> points, std::span<const std::uint16_t> skies) {
    const std::size_t groups = skies.size() / std::max<std::size_t>(1, points.size());
    const auto viewOf = [&](std::size_t i) {
      return PointView{skies.subspan(i * groups, groups), Vec3d(points_.pointNormal[points[i]]),
                       spinOf(options_.seed, points[i])};
    };
    std::size_t next = 0;
    for (; next + 4 <= points.size(); next += 4) {
      const std::array views{viewOf(next), viewOf(next + 1), viewOf(next + 2), viewOf(next + 3)};
      e.direct.evaluate(views, e.rows);
      for (std::size_t i = 0; i < 4; ++i) storeTraced(points[next + i], e, i, views[i].sky);
    }
    for (; next < points.size(); ++next) {
      const PointView view = viewOf(next);
      e.direct.evaluate(view, e.rows);
      storeTraced(points[next], e, 0, view.sky);
    }
  }

  void storeTraced(std::uint32_t p, const Evaluator& e, std::size_t row, std::span<const std::uint16_t> sky) {
    store(p, std::span(e.rows).subspan(row * count(), count()));
    result_.transfer.visibility[p] = static_cast<float>(e.direct.visibility(sky));
    pairs_[p] = boundaryPairs(sky);
  }

  void traceSky(const RayScene& scene, const DirectionSet& directions) {
    auto evaluators = makeEvaluators(directions);
    std::vector<PointTracer> tracers;
    for (int i = 0; i < parallel_.threads(); ++i)
      tracers.emplace_back(points_, scene, directions, options_.seed, false);
    const auto groups = static_cast<std::size_t>(directions.groups());
    const std::size_t together = std::max<std::size_t>(1, RayScene::kMaxGroups / groups);
    const auto look = [&](std::span<const std::uint32_t> points, std::size_t worker) {
      std::vector<std::uint16_t> skies(points.size() * groups);
      tracers[worker].look(points, skies);
      evaluate(evaluators[worker], points, skies);
    };
    progress_.begin("tracing", static_cast<double>(points_.size()) * directions.size(), "rays");
    // Small blocks: whoever is done first waits for the last block of the others.
    parallel_.forBlocks(points_.size(), std::max(together, kSkyBlock), [&](std::size_t begin, std::size_t end, int w) {
      const FlushDenormals flush;
      std::vector<std::uint32_t> block;
      for (std::size_t p = begin; p < end; ++p) {
        if (isWanted(p)) block.push_back(static_cast<std::uint32_t>(p));
      }
      look(block, static_cast<std::size_t>(w));
      progress_.advance(static_cast<double>(end - begin) * directions.size());
    });
    progress_.end();
  }

  /// Traces all points. Keeps the masks in `skies` where it has room for them, and evaluates them at once where not.
  void traceWithHits(Reflections& reflections, const DirectionSet& directions, std::vector<std::uint16_t>& skies) {
    auto evaluators = makeEvaluators(directions);
    progress_.begin("tracing", static_cast<double>(points_.size()) * directions.size(), "rays");
    reflections.trace(
        [&](std::uint32_t p, std::span<const std::uint16_t> sky, std::span<const Hit>, int worker) {
          if (skies.empty()) {
            evaluate(evaluators[static_cast<std::size_t>(worker)], std::span(&p, 1), sky);
          } else {
            std::copy(sky.begin(), sky.end(), skies.begin() + static_cast<std::ptrdiff_t>(p * sky.size()));
          }
        },
        progress_);
    progress_.end();
  }

  void evaluateAll(const DirectionSet& directions, std::span<const std::uint16_t> skies) {
    auto evaluators = makeEvaluators(directions);
    const auto groups = static_cast<std::size_t>(directions.groups());
    progress_.begin("evaluating", static_cast<double>(points_.size()), "points");
    parallel_.forBlocks(points_.size(), 1024, [&](std::size_t begin, std::size_t end, int worker) {
      const FlushDenormals flush;
      std::vector<std::uint32_t> block(end - begin);
      std::iota(block.begin(), block.end(), static_cast<std::uint32_t>(begin));
      evaluate(evaluators[static_cast<std::size_t>(worker)], block,
               skies.subspan(begin * groups, block.size() * groups));
      progress_.advance(static_cast<double>(end - begin));
    });
    progress_.end();
  }

  /// Columns of a channel, in whole vectors.
  std::size_t paddedCount() const { return (count() + kColumns - 1) / kColumns * kColumns; }

  /// Solves T = direct + albedo * K T for each channel, `batch` columns at a time.
  void addReflections(Reflections& reflections, std::size_t batch) {
    const std::size_t padded = paddedCount();
    progress_.begin("reflecting", 0, "reflections");
    for (int channel = 0; channel < result_.transfer.channels; ++channel) {
      for (std::size_t first = 0; first < count(); first += batch) {
        reflectColumns(reflections, channel, first, std::min(batch, padded - first));
      }
    }
    progress_.end();
  }

  /// How uneven the reflected light is that each point sees, judged by the first two bands of the middle channel: they
  /// hold 88 % of an unshadowed transfer.
  void measureRoughness(Reflections& reflections) {
    const std::size_t real = std::min(kColumns, count()), stride = result_.transfer.stride();
    const std::size_t offset = result_.transfer.channels == 3 ? count() : 0;
    std::vector<float> firstBands(points_.size() * kColumns);
    forEachCounted(progress_, points_.size(), 0, [&](std::size_t p) {
      std::copy_n(&result_.transfer.coefficients[p * stride + offset], real, &firstBands[p * kColumns]);
    });
    roughness_.resize(points_.size());
    reflections.roughness(firstBands.data(), roughness_.data(), kColumns, progress_);
  }

  float albedo(std::size_t p, int channel) const {
    const Rgb& a = points_.pointAlbedo[p];
    return channel == 0 ? a.x : channel == 1 ? a.y : a.z;
  }

  void reflectColumns(Reflections& reflections, int channel, std::size_t first, std::size_t columns) {
    const std::size_t n = points_.size(), real = std::min(columns, count() - first);
    const std::size_t offset = static_cast<std::size_t>(channel) * count() + first, stride = result_.transfer.stride();
    std::vector<float>& coefficients = result_.transfer.coefficients;
    const auto map = [&](const float* in, float* out) {
      reflections.gather(in, out, columns, progress_);
      parallel_.forBlocks(n, 4096, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t p = begin; p < end; ++p) {
          const float rho = albedo(p, channel);
          float* row = out + p * columns;
          const float* direct = &coefficients[p * stride + offset];
          for (std::size_t k = 0; k < real; ++k) row[k] = direct[k] + rho * row[k];
        }
        progress_.advance(0);
      });
      progress_.advance(1);
    };
    std::vector<float> x(n * columns);
    forEachCounted(progress_, n, 0,
                   [&](std::size_t p) { std::copy_n(&coefficients[p * stride + offset], real, &x[p * columns]); });
    if (options_.bounces == BakeOptions::kBouncesAuto) {
      const FixedPointOptions solver{kSolverShare * options_.tolerance * columnScale(channel), kMaxSolverSteps};
      const FixedPointResult solved = solveFixedPoint(n, columns, x, map, solver, parallel_, progress_);
      result_.bounces = std::max(result_.bounces, solved.steps);
      result_.converged &= solved.converged;
    } else {
      std::vector<float> next(x.size());
      for (int b = 0; b < options_.bounces; ++b) {
        map(x.data(), next.data());
        std::swap(x, next);
      }
      result_.bounces = options_.bounces;
    }
    forEachCounted(progress_, n, 0,
                   [&](std::size_t p) { std::copy_n(&x[p * columns], real, &coefficients[p * stride + offset]); });
  }

  /// The norm over all points that a column of unshadowed transfer has on average.
  double columnScale(int channel) const {
    double sum = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) sum += std::pow(static_cast<double>(albedo(p, channel)), 2);
    return std::sqrt(sum / static_cast<double>(count())) * sh::unshadowedNorm(options_.order);
  }

  void summarise() {
    const std::vector<double> areas = pointAreas(points_);
    double sum = 0, area = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (!isWanted(p)) continue;
      const double e = static_cast<double>(result_.transfer.error[p]);
      sum += areas[p] * e * e;
      area += areas[p];
      result_.maxError = std::max(result_.maxError, e);
    }
    result_.rmsError = area > 0 ? std::sqrt(sum / area) : 0;
  }

  TracedPoints& traced_;
  const LightingPoints& points_;
  const std::vector<std::uint8_t>& wanted_;
  const BakeOptions& options_;
  const Parallel& parallel_;
  Progress& progress_;
  std::vector<std::uint32_t> pairs_;  // boundary pairs of each point
  std::vector<float> roughness_;      // of the reflected light that each point sees; empty without reflections
  PointBake result_;
};

}  // namespace

PointBake bakePoints(TracedPoints& points, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                     const Parallel& parallel, Progress& progress) {
  validate(options);
  return Baker(points, wanted, options, parallel, progress).run();
}

PointBake bakePoints(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                     const Parallel& parallel, Progress& progress) {
  TracedPoints once(points, parallel, progress);
  return bakePoints(once, wanted, options, parallel, progress);
}

}  // namespace shbake
