// Two independent high-ray estimates, block by block.
#include "chart/sweep/reference.h"

#include <algorithm>

#include "base/error.h"
#include "chart/sweep/direct.h"
#include "chart/sweep/reference_cache.h"
#include "chart/sweep/sample.h"

namespace shbake::chart {
namespace {

/// Seeds that no bake uses by default, so that the references are independent of what they judge.
constexpr std::uint64_t kFirstSeed = 0x5EED0001, kSecondSeed = 0x5EED0002;
/// Points between two looks at the deadline.
constexpr std::size_t kBatch = 2 * kSampleBlock;
/// Seconds between two writes of the cache: what a process killed outright loses at most.
constexpr double kWriteInterval = 5;

/// The second lattice has other rings, so that what the two have in common is the mesh alone.
int secondRays(int rays) {
  return std::max(16, rays / 16 * 15);
}

void append(std::vector<float>& to, const std::vector<float>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

MadeReference makeReference(const LightingPoints& points, const RayScene& scene, std::span<const std::uint32_t> sample,
                            const ReferenceOptions& options, const Deadline& deadline, const Parallel& parallel,
                            Progress& progress) {
  MadeReference made;
  Reference& r = made.reference;
  r.order = options.order;
  r.rays = options.rays;
  const bool cached = !options.cache.empty();
  const ReferenceKey key = cached ? referenceKey(points, sample, options) : ReferenceKey{};
  if (cached) {
    const CacheState state = readReferenceCache(options.cache, key, r);
    made.cache = state == CacheState::absent ? CacheUse::fresh
                 : state != CacheState::good ? CacheUse::remade
                 : r.points == sample.size() ? CacheUse::complete
                                             : CacheUse::resumed;
  }
  const auto write = [&] {
    if (cached) writeReferenceCache(options.cache, key, r);
  };
  const std::size_t known = r.points;
  const double perPoint = options.rays + secondRays(options.rays);
  progress.begin("reference", static_cast<double>(sample.size() - known) * perPoint, "rays");
  double written = deadline.passed();
  try {
    while (r.points < sample.size() && (r.points == 0 || !deadline.isOver())) {
      const auto batch = sample.subspan(r.points, std::min(kBatch, sample.size() - r.points));
      const auto trace = [&](int rays, std::uint64_t seed) {
        return directTransfer(points, scene, batch, options.order, rays, seed, parallel, progress);
      };
      const std::vector<float> first = trace(options.rays, kFirstSeed);
      append(r.second, trace(secondRays(options.rays), kSecondSeed));
      append(r.first, first);
      r.points += batch.size();
      if (deadline.passed() - written > kWriteInterval) {
        write();
        written = deadline.passed();
      }
    }
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled && r.points > known) write();
    throw;
  }
  if (r.points > known) write();
  progress.end();
  return made;
}

}  // namespace shbake::chart
