// A tree is built once for all who ask, and is gone when nobody does or memory is short; results do not tell.
#include <catch2/catch.hpp>
#include <string>

#include "bake/support.h"
#include "bake/surface_error.h"
#include "bake/surface_fit.h"
#include "bake/traced_points.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// Counts how often a stage of the work begins.
class StageCount {
 public:
  explicit StageCount(std::string stage)
      : progress_([this, stage](const ProgressState& state) {
          count_ += state.stage == stage && last_ != stage ? 1 : 0;
          last_ = state.stage;
          return true;
        }) {}

  Progress& progress() { return progress_; }
  int count() const { return count_; }

 private:
  std::string last_;
  int count_ = 0;
  Progress progress_;
};

}  // namespace

TEST_CASE("bake, fit and judge share one tree where it is kept for them", "[traced_points]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(1), {0.5f, 0.5f, 0.5f});
  const BakeOptions options = optionsOf(TransferKind::interreflected, 2, 64);
  const Parallel parallel(1);
  SurfaceFitOptions fit;
  fit.kind = FitKind::surface;
  const auto runAll = [&](StageCount& builds, bool keep) {
    TracedPoints traced(points, parallel, builds.progress());
    traced.keepForMore(keep);
    PointBake baked = bakePoints(traced, {}, options, parallel, builds.progress());
    fitToSurface(traced, {}, baked, options, fit, parallel, builds.progress());
    measureSurfaceError(traced, baked.transfer, options, {64, 0}, parallel, builds.progress());
    bakePoints(traced, {}, options, parallel, builds.progress());
    return baked.transfer.coefficients;
  };
  StageCount kept("building"), freed("building"), contacts("searching contacts");
  const std::vector<float> coefficients = runAll(kept, true);
  CHECK(kept.count() == 1);
  CHECK(sameBits(runAll(freed, false), coefficients));
  // For the bake, and once more for the fit, the judge and the second bake.
  CHECK(freed.count() == 2);
  runAll(contacts, true);
  // For all positions, the samples that judge the fit, those that it is made of, and those of the judge.
  CHECK(contacts.count() == 4);
}

TEST_CASE("a tree gives way to what a bake stores where memory is short", "[traced_points]") {
  const LightingPoints points = pointsOf(shapes::inwardSphere(3), {0.5f, 0.5f, 0.5f});
  BakeOptions options = optionsOf(TransferKind::interreflected, 2, 64);
  const Parallel parallel(1);
  const auto bakeTwice = [&](std::size_t memory, StageCount& builds) {
    options.memory = memory;
    TracedPoints traced(points, parallel, builds.progress());
    traced.keepForMore(true);
    const PointBake first = bakePoints(traced, {}, options, parallel, builds.progress());
    const PointBake second = bakePoints(traced, {}, options, parallel, builds.progress());
    CHECK(sameBits(first.transfer.coefficients, second.transfer.coefficients));
    return second;
  };
  StageCount ample("building"), enough("building"), scarce("building");
  const PointBake stored = bakeTwice(std::size_t(1) << 30, ample);
  CHECK(ample.count() == 1);
  // All hits are stored, and the tree does not fit beside them.
  const PointBake tight = bakeTwice(stored.wantedMemory, enough);
  CHECK(tight.retracedPoints == 0);
  CHECK(enough.count() == 2);
  // Points that are traced again need the tree to the end.
  const PointBake retraced = bakeTwice(stored.wantedMemory / 2, scarce);
  CHECK(retraced.retracedPoints > 0);
  CHECK(scarce.count() == 1);
  CHECK(sameBits(tight.transfer.coefficients, stored.transfer.coefficients));
  CHECK(sameBits(retraced.transfer.coefficients, stored.transfer.coefficients));
}
