#include "bake/direct_transfer.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/wide.h"
#include "sh/basis.h"

namespace shbake {
namespace {

constexpr unsigned kAll = 0xFFFF;
/// Groups summed in float before the sum moves to double: rounding stays near 1e-7 at any number of rays.
constexpr std::size_t kChunk = 64;

/// Adds the visible directions of groups first..last-1 to `total`. S is the table's stride, known to the compiler so
/// that the running sums stay in registers. Groups that are wholly visible or mostly so start from their stored sum.
template <std::size_t S>
[[gnu::always_inline]] inline void addGroups(const DirectionSet& set, std::span<const std::uint16_t> sky,
                                             std::size_t first, std::size_t last, double* total) {
  std::array<float, S> sum{};
  for (std::size_t g = first; g < last; ++g) {
    unsigned bits = sky[g];
    const int group = static_cast<int>(g);
    const float* rows = set.basis(group * DirectionSet::kGroup);
    if (std::popcount(bits) > DirectionSet::kGroup / 2) {
      const float* whole = set.groupSum(group);
      for (std::size_t k = 0; k < S; ++k) sum[k] += whole[k];
      for (bits = kAll & ~bits; bits != 0; bits &= bits - 1) {
        const float* row = rows + static_cast<std::size_t>(std::countr_zero(bits)) * S;
        for (std::size_t k = 0; k < S; ++k) sum[k] -= row[k];
      }
    } else {
      for (; bits != 0; bits &= bits - 1) {
        const float* row = rows + static_cast<std::size_t>(std::countr_zero(bits)) * S;
        for (std::size_t k = 0; k < S; ++k) sum[k] += row[k];
      }
    }
  }
  for (std::size_t k = 0; k < S; ++k) total[k] += static_cast<double>(sum[k]);
}

/// The same for orders above 8, where the table is read once a ray whatever is done.
void addGroupsWide(const DirectionSet& set, std::span<const std::uint16_t> sky, std::size_t first, std::size_t last,
                   double* total) {
  for (std::size_t g = first; g < last; ++g) {
    for (unsigned bits = sky[g]; bits != 0; bits &= bits - 1) {
      const float* row = set.basis(static_cast<int>(g) * DirectionSet::kGroup + std::countr_zero(bits));
      for (std::size_t k = 0; k < set.stride(); ++k) total[k] += static_cast<double>(row[k]);
    }
  }
}

/// addGroups() for the table's stride.
SHBAKE_WIDE void addGroupsOf(const DirectionSet& set, std::span<const std::uint16_t> sky, std::size_t first,
                             std::size_t last, double* total) {
  switch (set.stride()) {
    case 4:  // orders 1, 2
      return addGroups<4>(set, sky, first, last, total);
    case 12:  // order 3
      return addGroups<12>(set, sky, first, last, total);
    case 16:
      return addGroups<16>(set, sky, first, last, total);
    case 28:
      return addGroups<28>(set, sky, first, last, total);
    case 36:
      return addGroups<36>(set, sky, first, last, total);
    case 52:
      return addGroups<52>(set, sky, first, last, total);
    case 64:  // order 8
      return addGroups<64>(set, sky, first, last, total);
    default:
      return addGroupsWide(set, sky, first, last, total);
  }
}

/// What sees nothing gets 0, not -0.
float toFloat(double coefficient) {
  return static_cast<float>(coefficient + 0.0);
}

SHBAKE_WIDE int countVisible(std::span<const std::uint16_t> sky) {
  int visible = 0;
  for (const std::uint16_t mask : sky) visible += std::popcount(mask);
  return visible;
}

}  // namespace

DirectTransfer::DirectTransfer(const DirectionSet& directions)
    : directions_(directions),
      rotation_(directions.order()),
      local_(directions.stride()),
      world_(static_cast<std::size_t>(sh::coefficientCount(directions.order()))),
      locals_(world_.size()),
      worlds_(world_.size()) {}

double DirectTransfer::visibility(std::span<const std::uint16_t> sky) const {
  return static_cast<double>(countVisible(sky)) / directions_.size();
}

void DirectTransfer::sum(std::span<const std::uint16_t> sky) {
  std::fill(local_.begin(), local_.end(), 0.0);
  for (std::size_t first = 0; first < sky.size(); first += kChunk) {
    addGroupsOf(directions_, sky, first, std::min(first + kChunk, sky.size()), local_.data());
  }
}

void DirectTransfer::findLocal(std::span<const std::uint16_t> sky) {
  const double v = visibility(sky);
  if (v == 1) {
    std::copy(directions_.unshadowed().begin(), directions_.unshadowed().end(), local_.begin());
    return;
  }
  sum(sky);
  for (std::size_t k = 0; k < world_.size(); ++k) {
    local_[k] = local_[k] / directions_.size() + v * directions_.residual()[k];
  }
}

void DirectTransfer::evaluate(const PointView& view, std::span<float> out) {
  findLocal(view.sky);
  rotation_.toWorld(view.normal, view.spin, std::span<const double>(local_.data(), world_.size()), world_);
  for (std::size_t k = 0; k < world_.size(); ++k) out[k] = toFloat(world_[k]);
}

void DirectTransfer::evaluate(std::span<const PointView, 4> views, std::span<float> out) {
  std::array<Vec3d, 4> normals;
  std::array<double, 4> spins;
  for (std::size_t i = 0; i < 4; ++i) {
    findLocal(views[i].sky);
    for (std::size_t k = 0; k < locals_.size(); ++k) locals_[k].set(static_cast<int>(i), local_[k]);
    normals[i] = views[i].normal;
    spins[i] = views[i].spin;
  }
  rotation_.toWorld(normals, spins, locals_, worlds_);
  for (std::size_t i = 0; i < 4; ++i) {
    float* row = &out[i * worlds_.size()];
    for (std::size_t k = 0; k < worlds_.size(); ++k) row[k] = toFloat(worlds_[k][static_cast<int>(i)]);
  }
}

}  // namespace shbake
