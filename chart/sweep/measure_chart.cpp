// The whole measurement behind a chart: how the budget is shared out, and the order of the parts.
#include "chart/sweep/measure_chart.h"

#include <algorithm>

#include "base/error.h"
#include "chart/sweep/advice.h"
#include "chart/sweep/bounce_study.h"
#include "chart/sweep/order_study.h"
#include "chart/sweep/reference.h"
#include "chart/sweep/sample.h"
#include "chart/sweep/surface_study.h"

namespace shbake::chart {
namespace {

/// The parts of the budget by whose ends each part of the work is done; what is left is for drawing.
constexpr double kReferenceEnd = 0.22, kSweepEnd = 0.54, kBouncesEnd = 0.66, kSurfaceEnd = 0.95;
/// Orders are measured on fewer points: sampling them costs next to nothing, and they differ by factors.
constexpr std::size_t kOrderPoints = 512;

void validate(const MeasureOptions& o) {
  const auto require = [](bool ok, const std::string& what, const std::string& range) {
    if (!ok) throw usageError(what + " is out of range", "use " + range);
  };
  require(o.budget >= 1 && o.budget <= 100000, "the budget", "1 to 100000 seconds");
  require(o.sample >= kSampleBlock, "the number of points", "16 or more");
  require(o.referenceRays >= 256 && o.referenceRays <= 1 << 20, "the number of reference rays", "256 to 1048576");
  require(o.sweep.order >= 1 && o.sweep.order <= 8, "the order", "1 to 8");
}

std::string counted(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what;
}

void noteCache(CacheUse use, const std::string& path, ChartData& data) {
  if (use == CacheUse::remade) {
    data.notes.push_back("the cache " + path + " was damaged or of another mesh or setting, and was made anew");
  }
}

/// CPU seconds that one ray from every point takes, by the setting of ours with most rays.
double secondsPerRay(const ChartData& data) {
  const MethodCurve* ours = curveOf(data, "shbake");
  if (ours == nullptr || ours->points.empty()) return data.defaults.cpu / data.defaults.rays;
  return ours->points.back().cpu / ours->points.back().rays;
}

double secondsPerPointRay(const ChartData& data) {
  return secondsPerRay(data) / static_cast<double>(data.points);
}

}  // namespace

ChartData measureChart(const LightingPoints& points, const MeasureOptions& o, const Parallel& parallel,
                       Progress& progress) {
  validate(o);
  const Deadline deadline(o.budget);
  // Without the last part the others share its time.
  const double whole = o.surface == nullptr ? kSurfaceEnd / kBouncesEnd : 1;
  ChartData data;
  data.mesh = o.mesh;
  data.points = points.size();
  data.faces = points.faces.size();
  data.order = o.sweep.order;

  const TestBed bed(points, parallel, progress);
  data.buildSeconds = bed.buildSeconds();
  data.contactSeconds = bed.contactSeconds();

  const std::vector<std::uint32_t> sample = samplePoints(points.size(), o.sample);
  const MadeReference made = makeReference(points, bed.exact(), sample, {.rays = o.referenceRays, .cache = o.cache},
                                           deadline.at(whole * kReferenceEnd), parallel, progress);
  const Reference& reference = made.reference;
  data.referencePoints = reference.points;
  data.referenceRays = reference.rays;
  data.cache = made.cache;
  noteCache(made.cache, o.cache, data);

  runSweep(bed, sample, reference, o.sweep, deadline.at(whole * kSweepEnd), progress, data);
  if (data.measuredPoints < points.size()) {
    data.notes.push_back("errors and times were measured on " + counted(data.measuredPoints, "of ") +
                         counted(points.size(), "points, spread over the mesh; times are scaled up to all of them"));
  }

  if (o.light != nullptr) data.light = o.lightName;
  data.orders = studyOrders(bed, sample, reference, std::min(data.measuredPoints, kOrderPoints), data.defaults.rays,
                            o.light, parallel, progress);
  studyBounces(points, data.order, secondsPerRay(data), deadline.at(whole * kBouncesEnd), parallel, progress, data);
  if (o.surface != nullptr) {
    const SurfaceStudyOptions study{.order = data.order,
                                    .rays = data.defaults.rays,
                                    .secondsPerPointRay = secondsPerPointRay(data),
                                    .cache = o.surfaceCache};
    studySurface(*o.surface, study, deadline.at(kSurfaceEnd), parallel, progress, data);
    noteCache(data.surface.cache, o.surfaceCache, data);
  }
  data.advice = adviseSettings(data);
  data.surfaceAdvice = adviseSurface(data.surface);
  data.seconds = deadline.passed();
  return data;
}

}  // namespace shbake::chart
