// Measures methods at rising effort: runs, statistics, the plan that keeps the deadline.
#include "chart/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bake/bake_options.h"
#include "bake/pilot.h"
#include "chart/sweep/sample.h"
#include "chart/sweep/transfer_error.h"

namespace shbake::chart {
namespace {

/// Runs with different seeds, of which mean and scatter are taken.
int runsAt(int rays) {
  return rays <= 1024 ? 4 : 2;
}

constexpr int kSlopeFrom = 64, kSlopeTo = 4096;
/// The number of rays at which the shared error of independent runs is measured: the most that has four of them.
constexpr int kSystematicRays = 1024;
/// Points by which the time of all the work is foreseen, and the share of the time that is planned: what is foreseen
/// from few rays is off by some 10 %.
constexpr std::size_t kPilotPoints = 4 * kSampleBlock;
constexpr int kPilotRays = 256;
constexpr double kPlanned = 0.8;

class Sweep {
 public:
  Sweep(const TestBed& bed, std::span<const std::uint32_t> sample, const Reference& reference,
        const SweepOptions& options, const Deadline& deadline, Progress& progress, ChartData& data)
      : bed_(bed),
        sample_(sample),
        reference_(reference),
        options_(options),
        deadline_(deadline),
        progress_(progress),
        polled_([&progress](const ProgressState&) { return progress.tryAdvance(0); }),
        data_(data) {
    for (const Method& m : allMethods()) methods_.push_back(&m);
    if (!options.methods.empty()) methods_ = options.methods;
  }

  void run() {
    planPoints();
    const TransferJudge judge(bed_.points(), sample_, reference_, options_.order, count_);
    data_.measuredPoints = count_;
    data_.referenceNoise = judge.referenceNoise();
    for (const Method* m : methods_) data_.curves.push_back({m, {}, {}, {}});
    const int defaultRays = chooseDefault(), defaultRound = nearestRays(defaultRays);
    for (const int rays : options_.rays) {
      std::vector<Setting> round = affordable(rays);
      if (rays == defaultRound) round.push_back({&methodNamed("shbake"), defaultRays, nullptr, {}, {}, {}, 0});
      measure(round, judge);
      progress_.advance(double(rays) * runsAt(rays) * static_cast<double>(methods_.size()));
    }
    progress_.end();
    for (MethodCurve& curve : data_.curves) curve.slope = slopeOf(curve.points, kSlopeFrom, kSlopeTo);
    if (skipped_ > 0)
      data_.notes.push_back("the time was short: " + std::to_string(skipped_) +
                            " measurements with many rays were left out");
  }

 private:
  double rayRuns() const {
    double sum = 0;
    for (const int rays : options_.rays) sum += double(rays) * runsAt(rays);
    return sum;
  }

  Estimate estimate(const Method& method, std::size_t count, int rays, std::uint64_t seed) {
    return method.estimate(bed_, {sample_.first(count), options_.order, rays, seed}, polled_);
  }

  /// How many points there is time for: each method is timed once with few rays.
  void planPoints() {
    const std::size_t most = reference_.points, few = std::min(kPilotPoints, most);
    progress_.begin("planning", 0, "");
    const Deadline::Clock::time_point start = Deadline::Clock::now();
    for (const Method* m : methods_) estimate(*m, few, kPilotRays, 1);
    const double seconds = std::chrono::duration<double>(Deadline::Clock::now() - start).count();
    progress_.end();
    const double perPoint = seconds / static_cast<double>(few) * rayRuns() / kPilotRays;
    const auto affordable = static_cast<std::size_t>(kPlanned * deadline_.left() / perPoint);
    count_ = std::clamp(affordable / kSampleBlock * kSampleBlock, std::min(kSampleBlock, most), most);
    progress_.begin("measuring", rayRuns() * static_cast<double>(methods_.size()), "");
  }

  /// A number of rays of a method, and what its runs have brought so far.
  struct Setting {
    const Method* method;
    int rays;
    MethodCurve* curve;  ///< null: it is the default
    std::vector<double> squares, times;
    std::vector<std::vector<float>> estimates;  ///< kept where their shared error is asked for
    double traced;
  };

  /// The number of rays that meets the tolerance, and the one that is measured at about the same time.
  int chooseDefault() {
    BakeOptions bake;
    bake.order = options_.order;
    bake.tolerance = options_.tolerance;
    data_.defaultTolerance = options_.tolerance;
    return chooseRays(bed_.points(), {}, bed_.exact(), bake, Parallel(1), polled_);
  }
  int nearestRays(int rays) const {
    return *std::min_element(options_.rays.begin(), options_.rays.end(), [&](int a, int b) {
      return std::abs(std::log(double(a) / rays)) < std::abs(std::log(double(b) / rays));
    });
  }

  /// The methods for whose next setting there is time.
  std::vector<Setting> affordable(int rays) {
    std::vector<Setting> round;
    double seconds = 0;
    for (MethodCurve& curve : data_.curves) {
      const double next = curve.points.empty() ? 0 : foreseen(curve.points.back(), rays);
      if (!curve.points.empty() && seconds + next > deadline_.left()) {
        ++skipped_;
        continue;
      }
      seconds += next;
      round.push_back({curve.method, rays, &curve, {}, {}, {}, 0});
    }
    return round;
  }

  /// Runs the settings in turns.
  void measure(std::vector<Setting>& round, const TransferJudge& judge) {
    const int most = round.empty() ? 0 : runsAt(std::min_element(round.begin(), round.end(), [](auto& a, auto& b) {
                                                  return a.rays < b.rays;
                                                })->rays);
    for (int run = 0; run < most; ++run) {
      for (Setting& s : round) {
        if (run >= runsAt(s.rays)) continue;
        Estimate e = estimate(*s.method, count_, s.rays, static_cast<std::uint64_t>(run + 1));
        s.squares.push_back(judge.squaredError(e.transfer));
        s.times.push_back(e.cpu);
        s.traced = e.rays;
        if (s.rays == kSystematicRays) s.estimates.push_back(std::move(e.transfer));
      }
    }
    for (const Setting& s : round) {
      if (s.curve == nullptr) {
        data_.defaults = pointOf(s);
        continue;
      }
      s.curve->points.push_back(pointOf(s));
      if (s.rays == kSystematicRays) s.curve->systematic = sharedError(s.estimates, judge);
    }
  }

  static CurvePoint pointOf(const Setting& s) {
    CurvePoint point;
    point.rays = s.rays;
    point.traced = s.traced;
    point.runs = static_cast<int>(s.times.size());
    double mean = 0, variance = 0;
    for (const double square : s.squares) mean += square / point.runs;
    for (const double square : s.squares) variance += (square - mean) * (square - mean) / (point.runs - 1) / point.runs;
    point.error = mean > 0 ? std::sqrt(mean) : 0;
    point.errorSpread = mean > 0 ? std::sqrt(variance) / (2 * mean) : 0;
    const LeastTime time = leastTime(s.times);
    point.cpu = time.cpu;
    point.cpuSpread = time.spread;
    return point;
  }

  /// Seconds that all runs of a setting will take, from a smaller one.
  double foreseen(const CurvePoint& last, int rays) const {
    const double share = static_cast<double>(count_) / static_cast<double>(bed_.points().size());
    return last.cpu * share * rays / last.rays * runsAt(rays);
  }

  /// The mean over all pairs of runs, and its standard error by leaving out one run at a time (the jackknife).
  static std::optional<double> sharedError(const std::vector<std::vector<float>>& runs, const TransferJudge& judge) {
    const std::size_t n = runs.size();
    std::vector<double> pair(n * n, 0), without(n, 0);
    double all = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        pair[i * n + j] = judge.sharedError(runs[i], runs[j]);
        all += pair[i * n + j];
      }
    }
    const double pairs = static_cast<double>(n * (n - 1)) / 2, fewer = static_cast<double>((n - 1) * (n - 2)) / 2;
    double mean = 0, variance = 0;
    for (std::size_t out = 0; out < n; ++out) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) without[out] += i != out && j != out ? pair[i * n + j] / fewer : 0;
      }
      mean += without[out] / static_cast<double>(n);
    }
    for (const double w : without)
      variance += (w - mean) * (w - mean) * static_cast<double>(n - 1) / static_cast<double>(n);
    const double shared = all / pairs;
    if (shared <= 3 * std::sqrt(variance)) return {};
    return std::sqrt(shared);
  }

  const TestBed& bed_;
  std::span<const std::uint32_t> sample_;
  const Reference& reference_;
  const SweepOptions& options_;
  const Deadline& deadline_;
  Progress& progress_;
  Progress polled_;  // lets methods be cancelled without their points being counted
  ChartData& data_;
  std::vector<const Method*> methods_;
  std::size_t count_ = 0;
  int skipped_ = 0;
};

}  // namespace

void runSweep(const TestBed& bed, std::span<const std::uint32_t> sample, const Reference& reference,
              const SweepOptions& options, const Deadline& deadline, Progress& progress, ChartData& data) {
  Sweep(bed, sample, reference, options, deadline, progress, data).run();
}

}  // namespace shbake::chart
