// The story of a fit: pilot, smoothing, decision, fit, choice. Equations (29) to (31) and (35) of maths.md.
#include "bake/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "bake/direction_set.h"
#include "bake/fit_prospect.h"
#include "bake/senders.h"
#include "bake/smoothing.h"
#include "bake/surface_fit_choice.h"
#include "bake/surface_fit_samples.h"
#include "bake/surface_fit_system.h"
#include "bake/surface_places.h"
#include "base/error.h"
#include "base/hash.h"

namespace shbake {
namespace {

/// Samples of the pilot: errors that gather in a few spots, as contact shadows do, are seen by a few of 512, and a gain
/// of a tenth is then not significant.
constexpr std::size_t kPilotSamples = 2048;
/// On small meshes that is more work than the bake. Glances for these shares of the bake's rays come first, with half
/// its rays a place, and places enough to tell at all: fewer rays scatter more than as many more places mend, and every
/// place costs its set-up. The error goes with rays^(-3/4): where a fit is of no use, looking for one makes a bake
/// worse than rays in the same time by three quarters of these shares.
constexpr std::array kGlanceShares{0.02, 0.03};
constexpr double kLeastGlance = 24;
/// Samples that judge a fit, for each lighting point, and the most of them.
constexpr double kJudgeShare = 0.25;
constexpr std::size_t kMostJudges = 16384;
/// Rays of a sample where they are not given: below 32 a lattice of directions is too coarse to be worth its place,
/// above 256 more places tell more than more rays.
constexpr int kRayShare = 4, kLeastRays = 32, kMostRays = 256;
/// The ridge times the samples a point: what interpolation cannot represent scatters the residuals even without noise,
/// and the noise of the rays adds to it relative to the error that is to be removed. Measured on eight meshes.
constexpr double kRidgeOfScatter = 0.4, kRidgeOfNoise = 2.0 / 3;
/// The ratio of the noise to the error that the ridge follows: beyond it a fit changes next to nothing.
constexpr double kMostNoise = 1e4;
/// Places traced together.
constexpr std::size_t kBatch = 1 << 20;
/// The independent streams of random numbers, apart from those that measure the surface error.
constexpr std::uint64_t kStreamsOfSamples = 4;
enum Stream : std::uint64_t { kGlance = 8, kPilot = 16, kJudges = 20, kFitPlaces = 24, kFirstBatch };

std::size_t roundedToEven(double count) {
  return 2 * static_cast<std::size_t>(std::ceil(count / 2));
}

class SurfaceFitter {
 public:
  SurfaceFitter(TracedPoints& traced, const std::vector<std::uint8_t>& wanted, const PointBake& baked,
                const BakeOptions& bake, const SurfaceFitOptions& options, const Parallel& parallel, Progress& progress)
      : traced_(traced),
        points_(traced.points()),
        wanted_(wanted),
        baked_(baked.transfer),
        bake_(bake),
        options_(options),
        parallel_(parallel),
        progress_(progress),
        stride_(baked.transfer.stride()),
        rays_(options.raysPerSample > 0 ? options.raysPerSample
                                        : std::clamp(baked.rays / kRayShare, kLeastRays, kMostRays)),
        values_(baked.transfer.coefficients) {}

  FitReport run() {
    countFaces();
    if (measuredPoints_ == 0) return stop("no face has an area and reflects light");
    const Senders senders(traced_, baked_, bake_, parallel_, progress_);
    PlaceTracer tracer(traced_, baked_, senders.transfer(), bake_, parallel_, progress_);
    HeldOutSamples held =
        options_.kind == FitKind::automatic ? lookAround(tracer) : holdOut(tracer, kPilotSamples, rays_, kPilot);
    const SampledMean before = held.squaredError(baked_.coefficients);
    if (isEnough(before)) {
      report_.before = report_.after = rootOf(before);
      report_.rays = tracer.rays();
      return stop("the surface error is within the tolerance as it is");
    }
    if (options_.kind == FitKind::automatic) smooth(held);
    if (useless_) {
      report_.reason = useless_;
    } else {
      const std::size_t judges =
          std::min(kMostJudges, roundedToEven(kJudgeShare * static_cast<double>(measuredPoints_)));
      if (judges > kPilotSamples) held = holdOut(tracer, judges, rays_, kJudges);
      fit(tracer, held);
    }
    report_.before = rootOf(held.squaredError(baked_.coefficients));
    report_.after = rootOf(held.squaredError(values_));
    report_.rays = tracer.rays();
    return std::move(report_);
  }

  std::vector<float> takeValues() { return std::move(values_); }

 private:
  FitReport stop(const char* reason) {
    report_.reason = reason;
    return std::move(report_);
  }

  bool isWanted(std::uint32_t p) const { return wanted_.empty() || wanted_[p] != 0; }

  /// The faces to fit: those of the mesh itself, whose corners are all wanted.
  void countFaces() {
    areas_ = areaWeights(points_, points_.faces.size());
    isMeasured_.assign(points_.size(), 0);
    for (std::size_t f = 0; f < areas_.size(); ++f) {
      const Triangle& t = points_.facePoints[f];
      if (!std::all_of(t.begin(), t.end(), [&](std::uint32_t p) { return isWanted(p); })) areas_[f] = 0;
      if (areas_[f] == 0) continue;
      ++measuredFaces_;
      totalArea_ += areas_[f];
      for (const std::uint32_t p : t) isMeasured_[p] = 1;
    }
    measuredPoints_ = static_cast<std::size_t>(std::count(isMeasured_.begin(), isMeasured_.end(), 1));
  }

  std::uint64_t seed(std::uint64_t stream) const { return hashBits(bake_.seed, stream); }

  /// The glances that tell that a fit is of no use, the last one as far as it can, others for sure; else the pilot.
  HeldOutSamples lookAround(PlaceTracer& tracer) {
    const double ownRays = static_cast<double>(measuredPoints_) * bake_.rays;
    const FitProspect prospect(points_, areas_, baked_.error,
                               static_cast<double>(options_.samplesPerPoint) * rays_ / bake_.rays);
    // Where there is an error to meet, a pilot is cheaper than another bake: only who is sure does without.
    const bool isToMeet = options_.enough > 0;
    const double pilotShare = isToMeet ? 0 : 2.0 * kPilotSamples * rays_ / ownRays;
    const int rays = std::max(DirectionSet::kGroup, bake_.rays / 2);
    std::vector<double> squares;  // of all glances
    for (std::size_t i = 0; i < kGlanceShares.size(); ++i) {
      const double count = std::max(kLeastGlance, kGlanceShares[i] * ownRays / (2 * rays));
      if (count >= static_cast<double>(kPilotSamples)) break;
      HeldOutSamples held = holdOut(tracer, roundedToEven(count), rays, kGlance + i * kStreamsOfSamples);
      const std::vector<double> found = held.missedSquares(baked_.coefficients, baked_.error);
      squares.insert(squares.end(), found.begin(), found.end());
      const SampledMean missed = stratifiedMean(squares);
      const bool isLast = i + 1 == kGlanceShares.size() && !isToMeet;
      useless_ = prospect.whyUseless(isLast ? missed.mean : missed.high(), pilotShare);
      if (useless_) return held;
      if (!prospect.whyUseless(missed.low(), pilotShare)) break;
    }
    HeldOutSamples held = holdOut(tracer, kPilotSamples, rays_, kPilot);
    useless_ = prospect.whyUseless(stratifiedMean(held.missedSquares(baked_.coefficients, baked_.error)).mean, 0);
    return held;
  }

  /// Places that have no part in the fit, each traced twice.
  HeldOutSamples holdOut(PlaceTracer& tracer, std::size_t count, int rays, std::uint64_t stream) {
    std::vector<SurfacePlace> places = drawPlaces(points_, areas_, count, seed(stream), progress_);
    PlaceTransfers traced = tracer.trace(places, rays, std::array{seed(stream + 1), seed(stream + 2)});
    report_.heldOut = places.size();
    return HeldOutSamples(points_, std::move(places), std::move(traced), stride_);
  }

  /// Takes as much of `changed` as `shares` says, for the points that are measured; returns how many take any.
  std::size_t take(const std::vector<float>& changed, const RegionalShares& shares) {
    std::size_t taken = 0;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const auto share = static_cast<float>(isMeasured_[p] != 0 ? shares.ofPoint(p) : 0);
      if (share == 0) continue;
      bool differs = false;
      for (std::size_t i = p * stride_; i < (p + 1) * stride_; ++i) {
        differs |= changed[i] != values_[i];
        values_[i] += share * (changed[i] - values_[i]);
      }
      taken += differs ? 1 : 0;
    }
    return taken;
  }

  /// The pilot judges smoothing region by region. The samples of a glance are too few for that: the weights of
  /// smoothing, which are those of least expected error, are trusted unless they speak against it.
  void smooth(const HeldOutSamples& held) {
    if (std::all_of(baked_.error.begin(), baked_.error.end(), [](float error) { return error == 0; })) return;
    const std::vector<float> smoothed = smoothedCoefficients(points_, wanted_, baked_, parallel_, progress_);
    const RegionalShares shares =
        isPilot() ? held.chooseShares(values_, smoothed) : held.takeUnlessWorse(values_, smoothed);
    if (shares.takesAny()) report_.smoothedPoints = take(smoothed, shares);
  }

  bool isPilot() const { return report_.heldOut >= kPilotSamples; }

  /// A glance does not tell: errors in a few spots, which it may miss, are what fits are for.
  bool isEnough(const SampledMean& before) const {
    return options_.kind == FitKind::automatic && isPilot() && before.high() <= options_.enough * options_.enough;
  }

  /// Draws the places to fit to: half of them by area, which is what the error counts, and half one face like another,
  /// so that the corners of small faces have some too.
  std::vector<SurfacePlace> drawFitPlaces(std::vector<double>& density) {
    density.resize(areas_.size());
    for (std::size_t f = 0; f < areas_.size(); ++f) {
      density[f] = areas_[f] > 0 ? areas_[f] / totalArea_ + 1 / static_cast<double>(measuredFaces_) : 0;
    }
    const double wish = static_cast<double>(options_.samplesPerPoint) * static_cast<double>(measuredPoints_);
    return drawPlaces(points_, density, std::max(std::size_t{2}, roundedToEven(wish)), seed(kFitPlaces), progress_);
  }

  /// Traces the places batch by batch and adds what they find to the system.
  void addSamples(PlaceTracer& tracer, std::span<const SurfacePlace> places, std::span<const double> density,
                  SurfaceFitSystem& system) {
    std::vector<double> residual(stride_);
    for (std::size_t first = 0; first < places.size(); first += kBatch) {
      const auto batch = places.subspan(first, std::min(kBatch, places.size() - first));
      const PlaceTransfers traced = tracer.trace(batch, rays_, std::array{seed(kFirstBatch + first / kBatch)});
      for (std::size_t s = 0; s < batch.size(); ++s) {
        const SurfacePlace& place = batch[s];
        const Triangle& corners = points_.facePoints[place.face];
        for (std::size_t i = 0; i < stride_; ++i) {
          residual[i] = static_cast<double>(traced.sets[0][s * stride_ + i]);
          for (std::size_t k = 0; k < 3; ++k) {
            residual[i] -= place.weights[k] * static_cast<double>(values_[corners[k] * stride_ + i]);
          }
        }
        const double area = areas_[place.face] / totalArea_ / density[place.face];
        system.add(place.face, place.weights, area * traced.scale[s], residual);
      }
    }
  }

  void fit(PlaceTracer& tracer, const HeldOutSamples& held) {
    std::vector<double> density;
    const std::vector<SurfacePlace> places = drawFitPlaces(density);
    SurfaceFitSystem system(points_.size(), points_.facePoints, stride_);
    const double raysBefore = tracer.rays();
    addSamples(tracer, places, density, system);
    report_.samples = places.size();
    report_.fittedRays = tracer.rays() - raysBefore;
    const double perPoint = static_cast<double>(places.size()) / static_cast<double>(measuredPoints_);
    // An error that drowns in the noise may be measured as none or less: what were removed then would be noise too.
    const double error = held.squaredError(values_).mean;
    const double ofNoise = std::min(kMostNoise, held.noise() / std::max(error, std::pow(FitProspect::kRounding, 2)));
    report_.ridge = (kRidgeOfScatter + kRidgeOfNoise * ofNoise) / perPoint;
    std::vector<float> fitted = system.solve(report_.ridge, parallel_, progress_);
    for (std::size_t i = 0; i < fitted.size(); ++i) fitted[i] += values_[i];
    const RegionalShares shares =
        options_.kind == FitKind::surface ? RegionalShares{{0}, {1}} : held.chooseShares(values_, fitted);
    report_.regions = shares.shares.size();
    report_.fittedRegions = static_cast<std::size_t>(
        std::count_if(shares.shares.begin(), shares.shares.end(), [](double share) { return share > 0; }));
    report_.fittedPoints = take(fitted, shares);
    report_.reason = options_.kind == FitKind::surface ? "asked for"
                     : report_.fittedPoints > 0        ? "the samples show that it helps"
                                                       : "the samples do not show that it would help";
  }

  TracedPoints& traced_;
  const LightingPoints& points_;
  const std::vector<std::uint8_t>& wanted_;
  const TransferSet& baked_;
  const BakeOptions& bake_;
  const SurfaceFitOptions& options_;
  const Parallel& parallel_;
  Progress& progress_;
  std::size_t stride_;
  int rays_;
  std::vector<float> values_;  // the coefficients so far
  std::vector<double> areas_;  // of the faces that are fitted, else 0
  std::vector<std::uint8_t> isMeasured_;
  std::size_t measuredFaces_ = 0, measuredPoints_ = 0;
  double totalArea_ = 0;
  const char* useless_ = nullptr;  // why a fit cannot help
  FitReport report_;
};

}  // namespace

const char* fitName(FitKind kind) {
  return kind == FitKind::automatic ? "auto" : kind == FitKind::surface ? "surface" : "vertex";
}

void validate(const SurfaceFitOptions& o) {
  const auto require = [](bool ok, const char* name, int value, const char* range) {
    if (!ok) throw usageError(std::string(name) + " " + std::to_string(value) + " is out of range", range);
  };
  require(o.samplesPerPoint >= 1 && o.samplesPerPoint <= 64, "samples per point", o.samplesPerPoint, "use 1 to 64");
  require(o.raysPerSample == 0 || (o.raysPerSample >= 16 && o.raysPerSample <= 65536), "rays per sample",
          o.raysPerSample, "use 16 to 65536, or 0 to choose by the bake's rays");
  if (!(o.enough >= 0)) {
    throw usageError("the error that needs no fit, " + std::to_string(o.enough) + ", is out of range", "use 0 or more");
  }
}

FitReport fitToSurface(TracedPoints& traced, const std::vector<std::uint8_t>& wanted, PointBake& baked,
                       const BakeOptions& bake, const SurfaceFitOptions& options, const Parallel& parallel,
                       Progress& progress) {
  validate(bake);
  validate(options);
  FitReport report;
  report.reason = "not asked for";
  if (options.kind == FitKind::vertex) return report;
  if (bake.kind == TransferKind::unshadowed) {
    report.reason = "unshadowed transfer has a closed form, which is kept";
    return report;
  }
  const std::size_t count = traced.points().size();
  if (baked.transfer.size() != count || (!wanted.empty() && wanted.size() != count)) {
    throw usageError("the transfer does not belong to these points", "give what bakePoints() returned");
  }
  BakeOptions done = bake;
  done.rays = baked.rays;
  SurfaceFitter fitter(traced, wanted, baked, done, options, parallel, progress);
  report = fitter.run();
  if (report.fittedPoints + report.smoothedPoints > 0) baked.transfer.coefficients = fitter.takeValues();
  return report;
}

FitReport fitToSurface(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, PointBake& baked,
                       const BakeOptions& bake, const SurfaceFitOptions& options, const Parallel& parallel,
                       Progress& progress) {
  TracedPoints traced(points, parallel, progress);
  traced.keepForMore(true);
  return fitToSurface(traced, wanted, baked, bake, options, parallel, progress);
}

}  // namespace shbake
