// What each number of bands leaves out: from two independent estimates at order 12, whose noise cancels in the product.
#include "chart/sweep/order_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/stated_error.h"
#include "chart/sweep/direct.h"
#include "chart/sweep/transfer_error.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake::chart {
namespace {

constexpr int kMostOrder = 8;
/// Rays of the estimates at order 12: at some 0.2 % noise, whose square the product frees from.
constexpr int kRays = 4096, kOtherRays = 3840;
constexpr std::uint64_t kSeed = 0x5EED0003, kOtherSeed = 0x5EED0004;

/// What tails of transfer vectors hold, as a mean over points weighted by area.
class Tails {
 public:
  Tails(const LightingPoints& points, std::span<const std::uint32_t> chosen, std::vector<float> first,
        std::vector<float> second)
      : points_(points), chosen_(chosen), first_(std::move(first)), second_(std::move(second)) {
    const std::vector<double> areas = pointAreas(points);
    for (const std::uint32_t p : chosen) weights_.push_back(areas[p]);
  }

  double truncation(int order) const {
    const auto from = static_cast<std::size_t>(sh::coefficientCount(order));
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      for (std::size_t k = from; k < kCount; ++k) {
        sum += weights_[i] * static_cast<double>(first_[i * kCount + k]) * static_cast<double>(second_[i * kCount + k]);
      }
      area += weights_[i];
    }
    return std::sqrt(std::max(0.0, sum / area)) / sh::unshadowedNorm(kTruncationOrder);
  }

  double lit(int order, const Light& light) const {
    const Light all = withOrder(light, kTruncationOrder);
    const auto from = static_cast<std::size_t>(sh::coefficientCount(order));
    std::vector<double> open(kCount);
    double sum = 0, scale = 0;
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> channel = all.channel(c);
      for (std::size_t i = 0; i < chosen_.size(); ++i) {
        double a = 0, b = 0, whole = 0;
        sh::unshadowedTransfer(kTruncationOrder, normalized(Vec3d(points_.pointNormal[chosen_[i]])), 1, open);
        for (std::size_t k = 0; k < kCount; ++k) {
          whole += channel[k] * open[k];
          if (k < from) continue;
          a += channel[k] * static_cast<double>(first_[i * kCount + k]);
          b += channel[k] * static_cast<double>(second_[i * kCount + k]);
        }
        sum += weights_[i] * a * b;
        scale += weights_[i] * whole * whole;
      }
    }
    return scale > 0 ? std::sqrt(std::max(0.0, sum / scale)) : 0;
  }

 private:
  static constexpr std::size_t kCount = std::size_t{kTruncationOrder} * kTruncationOrder;

  const LightingPoints& points_;
  std::span<const std::uint32_t> chosen_;
  std::vector<float> first_, second_;
  std::vector<double> weights_;
};

}  // namespace

std::vector<OrderPoint> studyOrders(const TestBed& bed, std::span<const std::uint32_t> sample,
                                    const Reference& reference, std::size_t count, int rays, const Light* light,
                                    const Parallel& parallel, Progress& progress) {
  const auto chosen = sample.first(count);
  progress.begin("orders", static_cast<double>(count) * (kRays + kOtherRays + kMostOrder * rays), "rays");
  const auto trace = [&](int n, std::uint64_t seed) {
    return directTransfer(bed.points(), bed.exact(), chosen, kTruncationOrder, n, seed, parallel, progress);
  };
  const std::vector<float> first = trace(kRays, kSeed);
  const Tails tails(bed.points(), chosen, first, trace(kOtherRays, kOtherSeed));
  Progress polled([&progress](const ProgressState&) { return progress.tryAdvance(0); });
  std::vector<OrderPoint> orders;
  for (int order = 1; order <= kMostOrder; ++order) {
    const Estimate e = estimateShbake(bed, {chosen, order, rays, 1}, polled);
    const TransferJudge judge(bed.points(), sample, reference, order, count);
    OrderPoint point;
    point.order = order;
    point.truncation = tails.truncation(order);
    if (light != nullptr) point.lit = tails.lit(order, *light);
    point.sampling = std::sqrt(std::max(0.0, judge.squaredError(e.transfer)));
    point.cpu = e.cpu;
    orders.push_back(point);
    progress.advance(static_cast<double>(count) * rays);
  }
  progress.end();
  return orders;
}

}  // namespace shbake::chart
