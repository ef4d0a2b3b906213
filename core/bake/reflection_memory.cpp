// How the memory of a bake is shared out between hits and solver.
#include "bake/reflection_memory.h"

#include <algorithm>
#include <limits>

#include "bake/fixed_point.h"

namespace shbake {

ReflectionMemory::ReflectionMemory(std::size_t asked, std::size_t available, std::size_t points, std::size_t columns)
    : budget_(asked > 0 ? asked : available / 2), points_(points), columns_(columns), isDefault_(asked == 0) {}

std::size_t ReflectionMemory::solverBytes(std::size_t columns) const {
  return points_ * columns * sizeof(float) * 2 * kFixedPointWindow;
}

std::size_t ReflectionMemory::roomBeside(std::size_t columns) const {
  return budget_ - std::min(budget_, solverBytes(columns));
}

std::size_t ReflectionMemory::hitsWhileTracing() const {
  return roomBeside(kColumns);
}

ReflectionMemory::Share ReflectionMemory::shareOut(std::size_t hitBytes) const {
  const std::size_t most = isDefault_ ? std::max(kFreely, hitBytes) : budget_;
  Share best{kColumns, 0};
  double least = std::numeric_limits<double>::infinity();
  // From one batch of all columns to as many as there are vectors of them. Tracing a ray again takes ten times as long
  // as adding up its stored hit for 16 columns, and four batches of 4 no longer than one of 16.
  for (std::size_t batches = 1; batches <= columns_ / kColumns; ++batches) {
    const std::size_t columns = (columns_ / kColumns + batches - 1) / batches * kColumns;
    if (columns > kColumns && solverBytes(columns) > std::min(most, budget_)) continue;
    const std::size_t kept = std::min(hitBytes, roomBeside(columns));
    const double again = hitBytes > 0 ? 1 - static_cast<double>(kept) / static_cast<double>(hitBytes) : 0;
    const double traced = static_cast<double>(batches) * again;
    if (traced >= least) continue;
    least = traced;
    best = {columns, roomBeside(columns)};
  }
  return best;
}

}  // namespace shbake
