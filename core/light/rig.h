// A few lights taken at places of a scene, and the light between them.
#pragma once

#include <memory>
#include <vector>

#include "light/light.h"
#include "sh/matrix3.h"

namespace shbake {

/// The light at a place, in world axes.
struct LightSample {
  Vec3d position;
  Light light;
};

/// How much sample `index` counts at a place.
struct RigWeight {
  int index = 0;
  double weight = 0;

  friend bool operator==(const RigWeight&, const RigWeight&) = default;
};

enum class RigMethod {
  inverseDistance,  ///< all samples, by 1 / distance^power
  barycentric,  ///< the corners of the Delaunay simplex that holds the place; outside of all, of the nearest point of
                ///< the convex hull. A field that is an affine function of place is reproduced inside the hull.
};

struct RigOptions {
  RigMethod method = RigMethod::inverseDistance;
  double power = 10;  ///< of inverseDistance, above 0; Green's choice, close to the nearest sample's light
};

/// Immutable after construction; safe to share between threads.
class LightRig {
 public:
  /// Throws a usage error when there is no sample, a position is not finite or the power is not above 0.
  LightRig(std::vector<LightSample> samples, const RigOptions& options);
  ~LightRig();
  LightRig(LightRig&&) noexcept;
  LightRig& operator=(LightRig&&) noexcept;

  const std::vector<LightSample>& samples() const { return samples_; }
  const RigOptions& options() const { return options_; }

  /// The weights at a place: positive, summing to 1, rising in index. Samples at one position share its weight. On a
  /// sample's position only that position counts. Throws a usage error for a place that is not finite.
  std::vector<RigWeight> weights(const Vec3d& place) const;
  /// The weighted sum of the samples' lights.
  Light at(const Vec3d& place) const;

 private:
  class Simplices;
  std::vector<RigWeight> inverseDistanceWeights(const Vec3d& place) const;

  std::vector<LightSample> samples_;
  RigOptions options_;
  std::unique_ptr<Simplices> simplices_;
};

/// The rig turned as a whole about a place, its samples' positions and their lights: what shone at p shines at
/// about + R (p - about), turned by R. Throws a usage error for a matrix that is not a rotation.
LightRig rotated(const LightRig& rig, const sh::Matrix3d& rotation, const Vec3d& about = {});

}  // namespace shbake
