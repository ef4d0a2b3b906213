#include "bake/surface_tracer.h"

#include "bake/surface_places.h"
#include "sh/basis.h"

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
  direct_.evaluate(sky_, Vec3d(points_.pointNormal[p]), tracer_.spin(p), directTransfer_);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<double>(directTransfer_[i % directTransfer_.size()]);
  }
  for (const Hit& hit : hits_) {
    const double u = hit.u / 65535.0, v = hit.v / 65535.0;
    addInterpolated(*senders_, points_.facePoints[hit.face], {1 - u - v, u, v}, 1.0 / directions_.size(), out);
  }
}

}  // namespace shbake
