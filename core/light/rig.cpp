// Local lights: Green, "Spherical Harmonic Lighting: The Gritty Details", GDC 2003, names both ways of blending
// samples: weights (1/d)^n, here normalised, and barycentric weights on the samples' low-polygon hull, here with the
// tetrahedra inside.
#include "light/rig.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "light/simplex_weights.h"

namespace shbake {
namespace {

bool isLess(const Vec3d& a, const Vec3d& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Keeps the positive weights and makes their sum 1.
std::vector<RigWeight> normalizedWeights(std::vector<RigWeight> weights) {
  std::erase_if(weights, [](const RigWeight& w) { return !(w.weight > 0); });
  std::sort(weights.begin(), weights.end(), [](const RigWeight& a, const RigWeight& b) { return a.index < b.index; });
  double sum = 0;
  for (const RigWeight& w : weights) sum += w.weight;
  for (RigWeight& w : weights) w.weight /= sum;
  return weights;
}

}  // namespace

/// Samples joined by position, and the simplices between these.
class LightRig::Simplices {
 public:
  explicit Simplices(const std::vector<LightSample>& samples) {
    std::map<Vec3d, std::vector<int>, decltype(&isLess)> byPosition(&isLess);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      byPosition[samples[i].position].push_back(static_cast<int>(i));
    }
    std::vector<Vec3d> positions;
    for (auto& [position, indices] : byPosition) {
      positions.push_back(position);
      members_.push_back(std::move(indices));
    }
    simplices_ = std::make_unique<DelaunaySimplices>(positions);
  }

  std::vector<RigWeight> weightsAt(const Vec3d& place) const {
    const SimplexWeights corners = simplices_->weightsAt(place);
    std::vector<RigWeight> weights;
    for (int k = 0; k < 4 && corners.corner[k] >= 0; ++k) {
      const std::vector<int>& members = members_[corners.corner[k]];
      for (const int i : members) weights.push_back({i, corners.weight[k] / static_cast<double>(members.size())});
    }
    return weights;
  }

 private:
  std::vector<std::vector<int>> members_;  ///< the samples at each position
  std::unique_ptr<DelaunaySimplices> simplices_;
};

LightRig::LightRig(std::vector<LightSample> samples, const RigOptions& options)
    : samples_(std::move(samples)), options_(options) {
  if (samples_.empty()) throw usageError("a light rig has no samples", "give at least one");
  if (!(options.power > 0 && std::isfinite(options.power))) {
    throw usageError("the power of a light rig is not above 0", "give a number such as 10");
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (!isFinite(samples_[i].position)) {
      throw usageError("the position of light sample " + std::to_string(i) + " is not finite", "give finite numbers");
    }
  }
  if (options.method == RigMethod::barycentric) simplices_ = std::make_unique<Simplices>(samples_);
}

LightRig::~LightRig() = default;
LightRig::LightRig(LightRig&&) noexcept = default;
LightRig& LightRig::operator=(LightRig&&) noexcept = default;

std::vector<RigWeight> LightRig::weights(const Vec3d& place) const {
  if (!isFinite(place)) throw usageError("a place in a light rig is not finite", "give finite numbers");
  return normalizedWeights(simplices_ ? simplices_->weightsAt(place) : inverseDistanceWeights(place));
}

std::vector<RigWeight> LightRig::inverseDistanceWeights(const Vec3d& place) const {
  std::vector<double> distances;
  for (const LightSample& s : samples_) distances.push_back(length(s.position - place));
  const double nearest = *std::min_element(distances.begin(), distances.end());
  std::vector<RigWeight> weights;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    // Relative to the nearest, so that no power overflows. At distance 0 this is the limit: 1 there, 0 elsewhere.
    const double weight = distances[i] == nearest ? 1 : std::pow(nearest / distances[i], options_.power);
    weights.push_back({static_cast<int>(i), weight});
  }
  return weights;
}

LightRig rotated(const LightRig& rig, const sh::Matrix3d& rotation, const Vec3d& about) {
  std::vector<LightSample> samples;
  for (const LightSample& s : rig.samples()) {
    samples.push_back({about + rotation * (s.position - about), rotated(s.light, rotation)});
  }
  return LightRig(std::move(samples), rig.options());
}

Light LightRig::at(const Vec3d& place) const {
  Light sum;
  for (const RigWeight& w : weights(place)) addLight(sum, samples_[w.index].light, Vec3d{1, 1, 1} * w.weight);
  return sum;
}

}  // namespace shbake
