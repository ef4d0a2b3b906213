#include "transfer/transfer_set.h"

#include <algorithm>
#include <iterator>

namespace shbake {
namespace {

// In the order of TransferKind.
constexpr const char* kNames[] = {"unshadowed", "shadowed", "interreflected"};

}  // namespace

const char* transferName(TransferKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<TransferKind> transferKindOf(std::string_view name) {
  const auto* found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames)) return {};
  return static_cast<TransferKind>(found - kNames);
}

}  // namespace shbake
