// The error of interpolated transfer, measured at random points of the surface: maths.md (26) to (28).
#include "bake/surface_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "bake/direct_transfer.h"
#include "bake/point_tracer.h"
#include "bake/ray_scene.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/passes.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

/// Rays in one set of a sample, for each that the bake took: at an error of N^-3/4, both sets together have a fifth of
/// the bake's noise.
constexpr int kTruthRays = 4;
/// A set has at least this many, since the noise of few rays would hide small errors however it is subtracted,
constexpr int kLeastTruthRays = 512;
/// and no more than this, or as many as the bake, whose table of directions would not fit the memory at more.
constexpr int kMostTruthRays = 65536;
/// 97.5 % quantile of the normal distribution.
constexpr double kConfidence = 1.959963984540054;
/// The independent streams of random numbers.
enum Stream : std::uint64_t { kPlaces, kFirstSet, kSecondSet };

/// A place on a face: the weights of its corners, each 0..1, their sum 1.
struct Place {
  std::uint32_t face;
  std::array<double, 3> weights;
};

double areaOf(const LightingPoints& points, std::uint32_t face) {
  const auto corner = [&](std::size_t k) { return Vec3d(points.positions[points.faces[face][k]]); };
  return length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
}

bool isBlack(const LightingPoints& points, std::uint32_t face) {
  const Triangle& t = points.facePoints[face];
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t p) { return points.pointAlbedo[p] == Rgb(); });
}

/// The corner with the lowest number of a point, and the points from there on: the same however a face is turned.
std::size_t firstCorner(const Triangle& t) {
  return static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
}
Triangle fromFirstCorner(const Triangle& t) {
  const std::size_t k = firstCorner(t);
  return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}

/// Draws two places uniformly from each of samples/2 equal areas along the Morton curve, on which points are numbered.
std::vector<Place> drawPlaces(const LightingPoints& points, std::size_t faces, std::size_t samples, std::uint64_t seed,
                              Progress& progress) {
  Passes passes(progress, "placing samples", faces, "faces", 2);
  std::vector<std::uint32_t> order(faces);
  std::iota(order.begin(), order.end(), 0u);
  passes.sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Triangle ta = fromFirstCorner(points.facePoints[a]), tb = fromFirstCorner(points.facePoints[b]);
    return ta != tb ? ta < tb : a < b;
  });
  std::vector<double> ends;  // the area up to the end of each face in order
  ends.reserve(faces);
  double area = 0;
  passes.forEach(faces, [&](std::size_t i) {
    if (!isBlack(points, order[i])) area += areaOf(points, order[i]);
    ends.push_back(area);
  });
  passes.end();
  std::vector<Place> places;
  if (area == 0) return places;
  const double stratum = area / static_cast<double>(samples / 2);
  for (std::size_t s = 0; s < samples; ++s) {
    const double at = (static_cast<double>(s / 2) + hashUnit(seed, 2 * s)) * stratum;
    // The last face with an area where rounding has carried `at` to the end.
    auto end = std::upper_bound(ends.begin(), ends.end(), at);
    if (end == ends.end()) end = std::lower_bound(ends.begin(), ends.end(), area);
    const double begin = end == ends.begin() ? 0 : *(end - 1);
    const double x = std::min((at - begin) / (*end - begin), 1.0), y = hashUnit(seed, 2 * s + 1), root = std::sqrt(x);
    Place place{order[static_cast<std::size_t>(end - ends.begin())], {}};
    const std::size_t k = firstCorner(points.facePoints[place.face]);
    place.weights[k] = 1 - root;
    place.weights[(k + 1) % 3] = root * (1 - y);
    place.weights[(k + 2) % 3] = root * y;
    places.push_back(place);
  }
  return places;
}

/// The place's value of something that each corner has.
template <class T, class OfCorner>
Vec3<T> blend(const Place& place, const OfCorner& ofCorner) {
  Vec3d sum;
  for (std::size_t k = 0; k < 3; ++k) sum += Vec3d(ofCorner(k)) * place.weights[k];
  return Vec3<T>(sum);
}

/// Adds a lighting point for each place. No face has it as a corner: the fan test finds it in contact with its own.
void addPoints(LightingPoints& points, const std::vector<Place>& places) {
  for (const Place& place : places) {
    const Triangle &corners = points.faces[place.face], &facePoints = points.facePoints[place.face];
    const auto position = [&](std::size_t k) { return points.positions[corners[k]]; };
    Vec3d normal = normalized(blend<double>(place, [&](std::size_t k) { return points.pointNormal[facePoints[k]]; }));
    if (normal == Vec3d()) {
      normal = normalized(cross(Vec3d(position(1) - position(0)), Vec3d(position(2) - position(0))));
    }
    const Rgb albedo = blend<float>(place, [&](std::size_t k) { return points.pointAlbedo[facePoints[k]]; });
    points.pointPosition.push_back(static_cast<std::uint32_t>(points.positions.size()));
    points.positions.push_back(blend<float>(place, position) + Vec3f());
    points.positionFaces.starts.push_back(static_cast<std::uint32_t>(points.positionFaces.items.size()));
    points.pointNormal.push_back(Vec3f(normal));
    points.pointAlbedo.push_back(albedo);
  }
  // Room for one more, so that they are traced in place.
  points.positions.reserve(points.positions.size() + 1);
}

/// Adds `weight` times the transfer at a place with these weights to `sum`.
void addInterpolated(const TransferSet& set, const Triangle& corners, const std::array<double, 3>& weights,
                     double weight, std::span<double> sum) {
  for (std::size_t k = 0; k < 3; ++k) {
    const float* row = &set.coefficients[corners[k] * set.stride()];
    const double w = weight * weights[k];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * static_cast<double>(row[i]);
  }
}

/// The transfer of albedo 1 traced from samples by one set of rays; one for each worker thread.
class SetOfRays {
 public:
  /// `senders` has what each point sends to others; null: nothing is reflected.
  SetOfRays(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions, std::uint64_t seed,
            bool twoSided, const TransferSet* senders)
      : points_(points),
        directions_(directions),
        senders_(senders),
        tracer_(points, scene, directions, seed, twoSided),
        direct_(directions),
        sky_(static_cast<std::size_t>(directions.groups())),
        directTransfer_(static_cast<std::size_t>(sh::coefficientCount(directions.order()))) {}

  /// Writes all channels of the transfer of point `p`.
  void trace(std::uint32_t p, std::span<double> out) {
    hits_.clear();
    if (senders_ == nullptr) {
      tracer_.look(p, sky_);
    } else {
      tracer_.lookForHits(p, sky_, hits_);
    }
    direct_.evaluate(sky_, Vec3d(points_.pointNormal[p]), tracer_.spin(p), directTransfer_);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<double>(directTransfer_[i % directTransfer_.size()]);
    }
    for (const Hit& hit : hits_) {
      const double u = hit.u / 65535.0, v = hit.v / 65535.0;
      addInterpolated(*senders_, points_.facePoints[hit.face], {1 - u - v, u, v}, 1.0 / directions_.size(), out);
    }
  }

 private:
  const LightingPoints& points_;
  const DirectionSet& directions_;
  const TransferSet* senders_;
  PointTracer tracer_;
  DirectTransfer direct_;
  std::vector<std::uint16_t> sky_;
  std::vector<float> directTransfer_;
  std::vector<Hit> hits_;
};

class SurfaceMeter {
 public:
  SurfaceMeter(LightingPoints points, const TransferSet& baked, const BakeOptions& bake, const Parallel& parallel,
               Progress& progress)
      : points_(std::move(points)), baked_(baked), bake_(bake), parallel_(parallel), progress_(progress) {}

  SurfaceError run(std::size_t faces, std::size_t samples) {
    result_.samples = samples;
    firstSample_ = points_.size();
    places_ = drawPlaces(points_, faces, samples, hashBits(bake_.seed, kPlaces), progress_);
    if (places_.empty()) return {};
    squares_.resize(samples);
    if (bake_.kind == TransferKind::unshadowed) {
      measureUnshadowed();
    } else {
      measureTraced();
    }
    summarise();
    return result_;
  }

 private:
  double albedo(std::uint32_t p, std::size_t channel) const {
    const Rgb& a = points_.pointAlbedo[p];
    return static_cast<double>(channel == 0 ? a.x : channel == 1 ? a.y : a.z);
  }

  /// (t - t1) . (t - t2) of sample s, relative, from two estimates of its transfer with albedo 1 in all channels.
  double relativeSquare(std::size_t s, std::span<const double> first, std::span<const double> second) const {
    const Place& place = places_[s];
    const auto p = static_cast<std::uint32_t>(firstSample_ + s);
    std::vector<double> interpolated(baked_.stride(), 0);
    addInterpolated(baked_, points_.facePoints[place.face], place.weights, 1, interpolated);
    const std::size_t count = static_cast<std::size_t>(baked_.coefficientsPerChannel());
    double product = 0, scale = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(baked_.channels); ++c) {
      const double rho = albedo(p, c);
      for (std::size_t i = c * count; i < (c + 1) * count; ++i) {
        product += (interpolated[i] - rho * first[i]) * (interpolated[i] - rho * second[i]);
      }
      scale += std::pow(rho * sh::unshadowedNorm(baked_.order), 2);
    }
    return product / scale;
  }

  void measureUnshadowed() {
    addPoints(points_, places_);
    progress_.begin("measuring the surface", static_cast<double>(places_.size()), "samples");
    parallel_.forBlocks(places_.size(), 64, [&](std::size_t begin, std::size_t end, int) {
      const auto count = static_cast<std::size_t>(baked_.coefficientsPerChannel());
      std::vector<double> exact(count), all(baked_.stride());
      for (std::size_t s = begin; s < end; ++s) {
        const Vec3d normal = normalized(Vec3d(points_.pointNormal[firstSample_ + s]));
        sh::unshadowedTransfer(baked_.order, normal, 1, exact);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = exact[i % count];
        squares_[s] = relativeSquare(s, all, all);
      }
      progress_.advance(static_cast<double>(end - begin));
    });
    progress_.end();
  }

  /// What the faces send to the samples; null: nothing is reflected.
  const TransferSet* findSenders() {
    if (bake_.kind != TransferKind::interreflected || bake_.bounces == 0) return nullptr;
    if (bake_.bounces == BakeOptions::kBouncesAuto) return &baked_;
    // The last reflection counted is the one towards the samples.
    BakeOptions oneLess = bake_;
    --oneLess.bounces;
    return &fewerBounces_.emplace(bakePoints(points_, {}, oneLess, parallel_, progress_).transfer);
  }

  void measureTraced() {
    const TransferSet* senders = findSenders();
    addPoints(points_, places_);
    const auto maxDistance = static_cast<float>(bake_.maxDistance * points_.frame.scale);
    const RayScene scene(points_, maxDistance, parallel_, progress_);
    const int most = std::max(kMostTruthRays, bake_.rays);
    const DirectionSet directions(
        std::max(kLeastTruthRays, bake_.rays > most / kTruthRays ? most : kTruthRays * bake_.rays), baked_.order);
    result_.rays = 2 * directions.size();
    std::vector<SetOfRays> first, second;
    for (int i = 0; i < parallel_.threads(); ++i) {
      const auto set = [&](Stream stream) {
        return SetOfRays(points_, scene, directions, hashBits(bake_.seed, stream), bake_.twoSided, senders);
      };
      first.push_back(set(kFirstSet));
      second.push_back(set(kSecondSet));
    }
    progress_.begin("measuring the surface", static_cast<double>(places_.size()) * result_.rays, "rays");
    parallel_.forBlocks(places_.size(), 4, [&](std::size_t begin, std::size_t end, int worker) {
      const FlushDenormals flush;
      std::vector<double> one(baked_.stride()), other(baked_.stride());
      for (std::size_t s = begin; s < end; ++s) {
        const auto p = static_cast<std::uint32_t>(firstSample_ + s);
        first[static_cast<std::size_t>(worker)].trace(p, one);
        second[static_cast<std::size_t>(worker)].trace(p, other);
        squares_[s] = relativeSquare(s, one, other);
        progress_.advance(result_.rays);
      }
    });
    progress_.end();
  }

  void summarise() {
    const double n = static_cast<double>(squares_.size());
    const double mean = std::accumulate(squares_.begin(), squares_.end(), 0.0) / n;
    double variance = 0;  // of the mean: that of each stratum's, which is the mean of two, over their number
    for (std::size_t s = 0; s + 1 < squares_.size(); s += 2) variance += std::pow(squares_[s] - squares_[s + 1], 2);
    const double error = kConfidence * std::sqrt(variance) / n;
    // Noise is subtracted: what is left of no error at all may be less than none.
    const auto rootOf = [](double square) { return std::sqrt(std::max(0.0, square)); };
    result_.rms = rootOf(mean);
    result_.low = rootOf(mean - error);
    result_.high = rootOf(mean + error);
    const auto worst = std::max_element(squares_.begin(), squares_.end());
    result_.worst = rootOf(*worst);
    const auto position =
        points_.positions[points_.pointPosition[firstSample_ + static_cast<std::size_t>(worst - squares_.begin())]];
    result_.worstPosition = Vec3d(position) * (1 / points_.frame.scale) + points_.frame.centre;
  }

  LightingPoints points_;
  const TransferSet& baked_;
  const BakeOptions& bake_;
  const Parallel& parallel_;
  Progress& progress_;
  std::size_t firstSample_ = 0;
  std::vector<Place> places_;
  std::vector<double> squares_;  // of each sample's relative error; where rays are traced, with noise of mean zero
  std::optional<TransferSet> fewerBounces_;
  SurfaceError result_;
};

}  // namespace

void validate(const SurfaceErrorOptions& options) {
  constexpr std::size_t kLeast = SurfaceErrorOptions::kLeastSamples, kMost = SurfaceErrorOptions::kMostSamples;
  if (options.samples < kLeast || options.samples > kMost) {
    throw usageError("the number of surface samples, " + std::to_string(options.samples) + ", is out of range",
                     "use " + std::to_string(kLeast) + " to " + std::to_string(kMost));
  }
}

SurfaceError measureSurfaceError(LightingPoints points, const TransferSet& baked, const BakeOptions& bake,
                                 const SurfaceErrorOptions& options, const Parallel& parallel, Progress& progress) {
  validate(bake);
  validate(options);
  if (bake.kind != TransferKind::unshadowed && bake.rays == 0) {
    throw usageError("the surface error needs the number of rays that the bake took", "set BakeOptions::rays");
  }
  const bool hasColor = std::any_of(points.pointAlbedo.begin(), points.pointAlbedo.end(),
                                    [](const Rgb& a) { return a.x != a.y || a.y != a.z; });
  if (baked.size() != points.size() || baked.order != bake.order || baked.channels != (hasColor ? 3 : 1)) {
    throw usageError("the transfer does not belong to these points and options", "give what bakePoints() returned");
  }
  const std::size_t faces = options.faces == 0 ? points.faces.size() : std::min(options.faces, points.faces.size());
  SurfaceMeter meter(std::move(points), baked, bake, parallel, progress);
  return meter.run(faces, (options.samples + 1) / 2 * 2);
}

}  // namespace shbake
