// What the tests of baking share: baking a mesh in one call, directions as the tracer makes them, statistics over
// seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <span>
#include <vector>

#include "bake/bake_options.h"
#include "bake/baker.h"
#include "bake/contact_search.h"
#include "bake/direction_set.h"
#include "base/hash.h"
#include "mesh/lighting_points.h"
#include "support/shapes.h"

namespace shbake::testing {

inline constexpr double kPi = std::numbers::pi;
/// The unit roundoff of float: half the distance from 1 to the next float.
inline constexpr double kHalfUlp = 0x1p-24;

/// The lighting points of a mesh of one albedo; the mesh's face colours are its albedo where it has them.
LightingPoints pointsOf(const Mesh& mesh, Rgb albedo = {1, 1, 1}, const LightingPointOptions& options = {});

/// The contacts of a mesh (contact_search.h).
Contacts contactsOf(const LightingPoints& points);

/// Options of a bake with a fixed number of rays.
BakeOptions optionsOf(TransferKind kind, int order, int rays, std::uint64_t seed = 1);

/// bakePoints() without progress, all points wanted unless some are named.
PointBake bakeAll(const LightingPoints& points, const BakeOptions& options, int threads = 1);
PointBake bakeSome(const LightingPoints& points, const std::vector<std::uint32_t>& wanted, const BakeOptions& options);

/// The lighting point of mesh vertex `v`, which must not be split; `face` picks the point of a corner where it is.
std::uint32_t pointOfVertex(const LightingPoints& points, std::uint32_t v);

/// Direction number `i`, uniform on the sphere.
Vec3d randomDirection(std::uint64_t seed, std::uint64_t i);

/// The world directions that a point looks along, in the set's order, as exact as double: the tracer's floats lie
/// within 4 half ulps of them per component (axes and local directions are rounded, then three products summed).
std::vector<Vec3d> directionsOf(const LightingPoints& points, std::uint32_t point, const DirectionSet& set,
                                std::uint64_t seed);

/// Whether two arrays hold the same bits.
template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Mean and standard error of several values over independent samples.
class Samples {
 public:
  /// One sample of all values, the same number each time.
  void add(std::span<const double> values);
  void add(std::span<const float> values) { add(std::vector<double>(values.begin(), values.end())); }

  std::size_t size() const { return sum_.size(); }
  int count() const { return count_; }
  double mean(std::size_t i) const { return shift_[i] + sum_[i] / count_; }
  /// Of the mean.
  double standardError(std::size_t i) const;

 private:
  int count_ = 0;
  std::vector<double> shift_, sum_, squares_;  // sums of differences to the first sample: they do not cancel
};

/// The number of standard errors that the mean of `samples` samples exceeds with probability 1e-4 in any of
/// `comparisons` comparisons (Bonferroni) of normal values: Student's quantile by its first Cornish-Fisher term.
double errorLimit(std::size_t comparisons, int samples);

/// |a - b| / |b| over all values.
double relativeDifference(std::span<const float> a, std::span<const float> b);

}  // namespace shbake::testing
