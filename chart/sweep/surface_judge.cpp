// Errors at the same places for all bakes: drawn and traced once, kept in a file, found again on refined meshes.
#include "chart/sweep/surface_judge.h"

#include <limits>

#include "bake/sampled_mean.h"
#include "bake/surface_places.h"
#include "bake/surface_tracer.h"
#include "chart/sweep/sample.h"

namespace shbake::chart {
namespace {

/// A seed that no bake, and no other reference, draws with.
constexpr std::uint64_t kPlacesSeed = 0x5EED0005;

}  // namespace

SurfaceJudge::SurfaceJudge(const LightingPoints& points, const SurfaceJudgeOptions& options, const Deadline& deadline,
                           const Parallel& parallel, Progress& progress)
    : points_(points) {
  Progress polled([&progress](const ProgressState&) { return progress.tryAdvance(0); });
  const std::vector<SurfacePlace> places =
      drawPlaces(points, areaWeights(points, points.faces.size()), options.places, kPlacesSeed, polled);
  if (places.empty()) return;
  addPlaces(points_, places);
  // Blocks of places in an order of which any first part is spread over the surface; both places of a stratum stand in
  // one block.
  sample_ = samplePoints(places.size(), places.size());
  for (std::uint32_t& i : sample_) i += static_cast<std::uint32_t>(points.size());
  const RayScene scene(points_, std::numeric_limits<float>::infinity(), parallel, polled);
  MadeReference made =
      makeReference(points_, scene, sample_, {.order = options.order, .rays = options.rays, .cache = options.cache},
                    deadline, parallel, progress);
  reference_ = std::move(made.reference);
  cache_ = made.cache;
}

Vec3f SurfaceJudge::toWork(const Vec3d& position, const WorkFrame& from) const {
  return points_.frame.toWork(from.toFile(position));
}

PointSurface SurfaceJudge::surfaceOf(const LightingPoints& points) const {
  PointSurface surface{{}, points.pointNormal, points.facePoints};
  for (const std::uint32_t p : points.pointPosition) {
    surface.positions.push_back(toWork(Vec3d(points.positions[p]), points.frame));
  }
  return surface;
}

PointSurface SurfaceJudge::surfaceOf(const Mesh& mesh) const {
  PointSurface surface{{}, mesh.vertexNormals, mesh.triangles};
  for (const Vec3d& p : mesh.positions) surface.positions.push_back(points_.frame.toWork(p));
  return surface;
}

/// The squared error at place number `i` of the reference, which lies at `place` of the surface.
double SurfaceJudge::squareAt(std::size_t i, const SurfacePlace& place, const PointSurface& surface,
                              const TransferSet& baked) const {
  const std::size_t count = reference_.stride();
  std::vector<double> first(baked.stride()), second(baked.stride());
  for (std::size_t k = 0; k < baked.stride(); ++k) {
    first[k] = double{reference_.first[i * count + k % count]};
    second[k] = double{reference_.second[i * count + k % count]};
  }
  return relativeSquare(surface.faces[place.face], place.weights, points_.pointAlbedo[sample_[i]], {baked, first},
                        {baked, second});
}

SurfaceError SurfaceJudge::errorOf(const PointSurface& surface, const TransferSet& baked) const {
  if (places() == 0) return {};
  const PlaceFinder finder(surface);
  std::vector<double> squares(places());
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const std::uint32_t p = sample_[i];
    const SurfacePlace place = finder.nearest(points_.positions[points_.pointPosition[p]], points_.pointNormal[p]);
    squares[i] = squareAt(i, place, surface, baked);
  }
  SurfaceError error = surfaceErrorOf(squares, [&](std::size_t i) { return points_.filePosition(sample_[i]); });
  error.rays = reference_.rays + reference_.rays / 16 * 15;
  return error;
}

}  // namespace shbake::chart
