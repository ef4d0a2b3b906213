#include "bake/reflections.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bake/flush_denormals.h"

namespace shbake {
namespace {

/// Hits summed in float before the sum moves to double.
constexpr std::size_t kChunk = 1024;
/// Columns summed together: as many floats as registers hold.
constexpr std::size_t kStrip = 16;
/// Columns come in whole vectors of this many floats.
constexpr std::size_t kColumns = 4;
/// The hits ahead whose rows are fetched early.
constexpr std::size_t kAhead = 8;

/// Adds the interpolated rows of `hits` to sum[0..W-1].
template <std::size_t W>
void addHits(std::span<const Hit> hits, const std::vector<Triangle>& facePoints, const float* in, std::size_t columns,
             float* total) {
  std::array<float, W> sum{};
  for (std::size_t h = 0; h < hits.size(); ++h) {
    if (h + kAhead < hits.size()) __builtin_prefetch(in + facePoints[hits[h + kAhead].face][0] * columns);
    const Triangle& t = facePoints[hits[h].face];
    const float u = static_cast<float>(hits[h].u) * (1 / 65535.0f), v = static_cast<float>(hits[h].v) * (1 / 65535.0f);
    const float w = 1 - u - v;
    const float *a = in + t[0] * columns, *b = in + t[1] * columns, *c = in + t[2] * columns;
    for (std::size_t k = 0; k < W; ++k) sum[k] += w * a[k] + u * b[k] + v * c[k];
  }
  for (std::size_t k = 0; k < W; ++k) total[k] = sum[k];
}

}  // namespace

Reflections::Reflections(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions,
                         std::uint64_t seed, bool twoSided, std::size_t memoryBudget, const Parallel& parallel)
    : points_(points),
      directions_(directions),
      parallel_(parallel),
      memoryBudget_(memoryBudget),
      skies_(static_cast<std::size_t>(parallel.threads()), std::vector<std::uint16_t>(directions.groups())),
      traced_(static_cast<std::size_t>(parallel.threads())),
      blocks_((points.size() + kBlock - 1) / kBlock) {
  for (int i = 0; i < parallel.threads(); ++i) tracers_.emplace_back(points, scene, directions, seed, twoSided);
}

void Reflections::traceBlock(std::size_t begin, std::size_t end, int worker, Block& block, const Visit* visit) {
  const FlushDenormals flush;
  PointTracer& tracer = tracers_[static_cast<std::size_t>(worker)];
  auto& sky = skies_[static_cast<std::size_t>(worker)];
  block.hits.clear();
  block.ends.clear();
  for (std::size_t p = begin; p < end; ++p) {
    const std::size_t first = block.hits.size();
    tracer.lookForHits(static_cast<std::uint32_t>(p), sky, block.hits);
    block.ends.push_back(static_cast<std::uint32_t>(block.hits.size()));
    if (visit != nullptr) {
      (*visit)(static_cast<std::uint32_t>(p), sky, std::span(block.hits).subspan(first), worker);
    }
  }
}

void Reflections::trace(const Visit& visit, Progress& progress) {
  parallel_.forBlocks(points_.size(), kBlock, [&](std::size_t begin, std::size_t end, int worker) {
    Block& traced = traced_[static_cast<std::size_t>(worker)];
    traceBlock(begin, end, worker, traced, &visit);
    const std::size_t bytes = traced.bytes();
    if (storedBytes_.fetch_add(bytes) + bytes <= memoryBudget_) {
      blocks_[begin / kBlock] = traced;
    } else {
      storedBytes_ -= bytes;
      forgottenBytes_ += bytes;
      forgottenPoints_ += end - begin;
    }
    progress.advance(static_cast<double>(end - begin) * directions_.size());
  });
  for (Block& traced : traced_) traced = {};
}

void Reflections::forget(std::size_t memoryBudget) {
  for (auto block = blocks_.rbegin(); block != blocks_.rend() && storedBytes_ > memoryBudget; ++block) {
    storedBytes_ -= block->bytes();
    forgottenBytes_ += block->bytes();
    forgottenPoints_ += block->ends.size();
    *block = {};
  }
}

void Reflections::gatherPoint(std::span<const Hit> hits, const float* in, float* out, std::size_t columns) const {
  const double share = 1.0 / directions_.size();
  for (std::size_t first = 0; first < columns; first += kStrip) {
    const std::size_t width = std::min(kStrip, columns - first);
    std::array<double, kStrip> total{};
    std::array<float, kStrip> sum;
    for (std::size_t h = 0; h < hits.size(); h += kChunk) {
      const auto some = hits.subspan(h, std::min(kChunk, hits.size() - h));
      switch (width) {
        case 16:
          addHits<16>(some, points_.facePoints, in + first, columns, sum.data());
          break;
        case 12:
          addHits<12>(some, points_.facePoints, in + first, columns, sum.data());
          break;
        case 8:
          addHits<8>(some, points_.facePoints, in + first, columns, sum.data());
          break;
        default:
          addHits<4>(some, points_.facePoints, in + first, columns, sum.data());
          break;
      }
      for (std::size_t k = 0; k < width; ++k) total[k] += static_cast<double>(sum[k]);
    }
    for (std::size_t k = 0; k < width; ++k) out[first + k] = static_cast<float>(total[k] * share);
  }
}

/// Calls body(p, hits) for every point, in parallel; points without stored hits are traced again.
template <class Body>
void Reflections::forHits(Progress& progress, const Body& body) {
  parallel_.forBlocks(points_.size(), kBlock, [&](std::size_t begin, std::size_t end, int worker) {
    const Block* block = &blocks_[begin / kBlock];
    if (block->ends.empty()) {
      Block& again = traced_[static_cast<std::size_t>(worker)];
      traceBlock(begin, end, worker, again, nullptr);
      block = &again;
    }
    std::uint32_t first = 0;
    for (std::size_t p = begin; p < end; ++p) {
      const std::uint32_t last = block->ends[p - begin];
      body(p, std::span(block->hits).subspan(first, last - first));
      first = last;
    }
    progress.advance(0);
  });
}

void Reflections::gather(const float* in, float* out, std::size_t columns, Progress& progress) {
  forHits(progress,
          [&](std::size_t p, std::span<const Hit> hits) { gatherPoint(hits, in, out + p * columns, columns); });
}

void Reflections::roughness(const float* in, float* out, std::size_t columns, Progress& progress) {
  forHits(progress, [&](std::size_t p, std::span<const Hit> hits) {
    std::vector<float> last(columns), next(columns);
    double sum = 0;
    for (std::size_t h = 0; h < hits.size(); ++h) {
      for (std::size_t c = 0; c < columns; c += kColumns) {
        addHits<kColumns>(hits.subspan(h, 1), points_.facePoints, in + c, columns, &next[c]);
      }
      for (std::size_t c = 0; h > 0 && c < columns; ++c) {
        const double difference = static_cast<double>(next[c]) - static_cast<double>(last[c]);
        sum += difference * difference;
      }
      std::swap(last, next);
    }
    out[p] = static_cast<float>(sum);
  });
}

}  // namespace shbake
