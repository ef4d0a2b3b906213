// The file that keeps a reference: magic, key, number of points, two arrays of floats, checksum.
#include "chart/sweep/reference_cache.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/atomic_file.h"
#include "base/hash.h"

namespace shbake::chart {
namespace {

/// Ends in the version of this layout.
constexpr std::array<char, 8> kMagic{'S', 'H', 'B', 'R', 'E', 'F', '0', '1'};

struct Head {
  std::array<char, 8> magic;
  ReferenceKey key;
  std::uint64_t points;
};

std::uint64_t hashOf(const void* data, std::size_t bytes, std::uint64_t seed) {
  const auto* from = static_cast<const char*>(data);
  std::uint64_t hash = mixBits(seed ^ bytes);
  for (std::size_t i = 0; i < bytes; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + i, std::min<std::size_t>(8, bytes - i));
    hash = mixBits(hash + word * 0x9E3779B97F4A7C15ull + 1);
  }
  return hash;
}

template <class T>
std::uint64_t hashOf(const std::vector<T>& values, std::uint64_t seed) {
  return hashOf(values.data(), values.size() * sizeof(T), seed);
}

}  // namespace

ReferenceKey referenceKey(const LightingPoints& points, std::span<const std::uint32_t> sample,
                          const ReferenceOptions& options) {
  ReferenceKey key;
  for (std::size_t i = 0; i < key.size(); ++i) {
    std::uint64_t h = hashOf(points.positions, i + 1);
    h = hashOf(points.faces, h);
    h = hashOf(points.pointPosition, h);
    h = hashOf(points.pointNormal, h);
    h = hashOf(sample.data(), sample.size_bytes(), h);
    const std::array<std::int32_t, 2> numbers{options.order, options.rays};
    h = hashOf(numbers.data(), sizeof numbers, h);
    key[i] = hashOf(SHBAKE_VERSION, sizeof SHBAKE_VERSION, h);
  }
  return key;
}

CacheState readReferenceCache(const std::string& path, const ReferenceKey& key, Reference& reference) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return CacheState::absent;
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  Head head{};
  std::uint64_t checksum = 0;
  if (bytes.size() < sizeof head + sizeof checksum) return CacheState::damaged;
  std::memcpy(&head, bytes.data(), sizeof head);
  std::memcpy(&checksum, bytes.data() + bytes.size() - sizeof checksum, sizeof checksum);
  if (head.magic != kMagic || checksum != hashOf(bytes.data(), bytes.size() - sizeof checksum, 0)) {
    return CacheState::damaged;
  }
  if (head.key != key) return CacheState::other;
  const std::size_t values = head.points * reference.stride(), array = values * sizeof(float);
  if (bytes.size() != sizeof head + 2 * array + sizeof checksum) return CacheState::damaged;
  reference.points = head.points;
  reference.first.resize(values);
  reference.second.resize(values);
  std::memcpy(reference.first.data(), bytes.data() + sizeof head, array);
  std::memcpy(reference.second.data(), bytes.data() + sizeof head + array, array);
  return CacheState::good;
}

void writeReferenceCache(const std::string& path, const ReferenceKey& key, const Reference& reference) {
  const Head head{kMagic, key, reference.points};
  const std::size_t array = reference.first.size() * sizeof(float);
  std::vector<char> bytes(sizeof head + 2 * array);
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, reference.first.data(), array);
  std::memcpy(bytes.data() + sizeof head + array, reference.second.data(), array);
  const std::uint64_t checksum = hashOf(bytes.data(), bytes.size(), 0);
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.write(&checksum, sizeof checksum);
  file.commit();
}

}  // namespace shbake::chart
