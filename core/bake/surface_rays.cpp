// Rays from places of a surface.
#include "bake/surface_rays.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bake/flush_denormals.h"
#include "bake/surface_tracer.h"
#include "sh/basis.h"

namespace shbake {
namespace {

/// Places in a block of work.
constexpr std::size_t kBlock = 4;

/// The positions of some points, each once.
std::vector<std::uint32_t> positionsOf(const LightingPoints& points, std::span<const std::uint32_t> corners,
                                       std::span<const std::uint32_t> places) {
  std::vector<std::uint32_t> positions;
  for (const std::uint32_t p : corners) positions.push_back(points.pointPosition[p]);
  for (const std::uint32_t p : places) positions.push_back(points.pointPosition[p]);
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

}  // namespace

// The array of positions is traced in place, and must not grow where it stands: a longer copy takes its turn. No other
// array of the points is copied, and nothing that may fail comes after the first change.
SurfaceRays::Added::Added(LightingPoints& points, std::span<const SurfacePlace> places)
    : points_(points), ownPoints_(points.size()) {
  const auto makeRoom = [&](auto& values) { values.reserve(values.size() + places.size()); };
  makeRoom(points.positionFaces.starts);
  makeRoom(points.pointPosition);
  makeRoom(points.pointNormal);
  makeRoom(points.pointAlbedo);
  std::vector<Vec3f> positions;
  positions.reserve(points.positions.size() + places.size() + 1);  // one more, as addPlaces() leaves
  positions.assign(points.positions.begin(), points.positions.end());
  ownPositions_ = std::exchange(points.positions, std::move(positions));
  addPlaces(points, places);
}

SurfaceRays::Added::~Added() {
  points_.positionFaces.starts.resize(ownPositions_.size() + 1);
  points_.pointPosition.resize(ownPoints_);
  points_.pointNormal.resize(ownPoints_);
  points_.pointAlbedo.resize(ownPoints_);
  points_.positions = std::move(ownPositions_);
}

std::vector<std::uint32_t> SurfaceRays::Added::places() const {
  std::vector<std::uint32_t> numbers(points_.size() - ownPoints_);
  std::iota(numbers.begin(), numbers.end(), static_cast<std::uint32_t>(ownPoints_));
  return numbers;
}

SurfaceRays::SurfaceRays(TracedPoints& traced, std::span<const SurfacePlace> places,
                         std::span<const std::uint32_t> corners, DirectionSet directions, const BakeOptions& options,
                         const Parallel& parallel, Progress& progress)
    : tree_(traced.tree()),
      added_(traced.pointsForPlaces(), places),
      corners_(corners.begin(), corners.end()),
      places_(added_.places()),
      directions_(std::move(directions)),
      twoSided_(options.twoSided),
      parallel_(parallel),
      progress_(progress),
      contacts_(added_.points(), tree_, positionsOf(added_.points(), corners_, places_), parallel, progress),
      scene_(added_.points(), tree_, contacts_, static_cast<float>(options.maxDistance * added_.points().frame.scale)) {
}

SurfaceRays::~SurfaceRays() = default;

void SurfaceRays::tracePlaces(const char* stage, std::span<const RaySet> sets, int channels, const Visit& visit) const {
  trace(stage, places_, sets, channels, visit);
}

void SurfaceRays::traceCorners(const char* stage, std::span<const RaySet> sets, int channels,
                               const Visit& visit) const {
  trace(stage, corners_, sets, channels, visit);
}

void SurfaceRays::trace(const char* stage, std::span<const std::uint32_t> from, std::span<const RaySet> sets,
                        int channels, const Visit& visit) const {
  const LightingPoints& points = added_.points();
  std::vector<std::vector<SurfaceTracer>> workers(static_cast<std::size_t>(parallel_.threads()));
  for (std::vector<SurfaceTracer>& tracers : workers) {
    for (const RaySet& set : sets) {
      tracers.emplace_back(points, scene_, directions_, set.seed, twoSided_, set.senders);
    }
  }
  const auto stride = static_cast<std::size_t>(channels * sh::coefficientCount(directions_.order()));
  const double rays = static_cast<double>(sets.size()) * directions_.size();
  progress_.begin(stage, static_cast<double>(from.size()) * rays, "rays");
  parallel_.forBlocks(from.size(), kBlock, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    std::vector<SurfaceTracer>& tracers = workers[static_cast<std::size_t>(worker)];
    std::vector<std::vector<double>> transfers(sets.size(), std::vector<double>(stride));
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < sets.size(); ++k) tracers[k].trace(from[i], transfers[k]);
      visit(i, points.pointAlbedo[from[i]], transfers);
      progress_.advance(rays);
    }
  });
  progress_.end();
}

}  // namespace shbake
