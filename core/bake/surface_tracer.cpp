#include "bake/surface_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sh/basis.h"
#include "sh/irradiance.h"

namespace shbake {

SurfaceTracer::SurfaceTracer(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions,
                             std::uint64_t seed, bool twoSided, const TransferSet* senders)
    : points_(points),
      directions_(directions),
      senders_(senders),
      tracer_(points, scene, directions, seed, twoSided),
      direct_(directions),
      sky_(static_cast<std::size_t>(directions.groups())),
      directTransfer_(static_cast<std::size_t>(sh::coefficientCount(directions.order()))) {}

void SurfaceTracer::trace(std::uint32_t p, std::span<double> out) {
  hits_.clear();
  if (senders_ == nullptr) {
    tracer_.look(p, sky_);
  } else {
    tracer_.lookForHits(p, sky_, hits_);
  }
  direct_.evaluate({sky_, Vec3d(points_.pointNormal[p]), tracer_.spin(p)}, directTransfer_);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<double>(directTransfer_[i % directTransfer_.size()]);
  }
  for (const Hit& hit : hits_) {
    const double u = hit.u / 65535.0, v = hit.v / 65535.0;
    addInterpolated(*senders_, points_.facePoints[hit.face], {1 - u - v, u, v}, 1.0 / directions_.size(), out);
  }
}

double relativeSquare(const Triangle& corners, const std::array<double, 3>& weights, const Rgb& albedo,
                      const PlaceEstimate& a, const PlaceEstimate& b) {
  const std::array<float, 3> rho{albedo.x, albedo.y, albedo.z};
  std::vector<double> left(a.baked.stride(), 0), right(b.baked.stride(), 0);
  addInterpolated(a.baked, corners, weights, 1, left);
  addInterpolated(b.baked, corners, weights, 1, right);
  const std::size_t count = static_cast<std::size_t>(a.baked.coefficientsPerChannel());
  double product = 0, scale = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(a.baked.channels); ++c) {
    const double r = static_cast<double>(rho[c]);
    for (std::size_t i = c * count; i < (c + 1) * count; ++i) {
      product += (left[i] - r * a.truth[i]) * (right[i] - r * b.truth[i]);
    }
    scale += std::pow(r * sh::unshadowedNorm(a.baked.order), 2);
  }
  return product / scale;
}

}  // namespace shbake
