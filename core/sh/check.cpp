// Size checks shared by the functions of this layer.
#include "sh/check.h"

#include <string>

#include "base/error.h"

namespace shbake::sh {
namespace {

// Kept out of line so that the checks themselves cost a comparison.
[[noreturn, gnu::noinline, gnu::cold]] void throwBadOrder(int order, int lowest, int highest, const char* what) {
  const std::string range = "between " + std::to_string(lowest) + " and " + std::to_string(highest);
  throw usageError(std::string(what) + " of order " + std::to_string(order) + " asked for", "give an order " + range);
}

[[noreturn, gnu::noinline, gnu::cold]] void throwBadSize(int order, std::size_t size, const char* what) {
  if (order < 1) {
    throw usageError(std::string(what) + " of order " + std::to_string(order) + " asked for",
                     "give an order of 1 or more");
  }
  throw usageError(std::string(what) + " holds " + std::to_string(size) + " coefficients where order " +
                       std::to_string(order) + " has " + std::to_string(std::size_t(order) * std::size_t(order)),
                   "give order^2 coefficients");
}

}  // namespace

void requireCoefficients(int order, std::size_t size, const char* what) {
  if (order < 1 || size < std::size_t(order) * std::size_t(order)) throwBadSize(order, size, what);
}

void requireOrder(int order, int lowest, int highest, const char* what) {
  if (order < lowest || order > highest) throwBadOrder(order, lowest, highest, what);
}

}  // namespace shbake::sh
