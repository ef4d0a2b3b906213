// How many vertices a refinement may make.
#include "mesh/refine_budget.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

/// Corners of a lattice around a patch that turn out to lie beside it, or too near to its border, are a part of all.
constexpr std::size_t kCandidatesEach = 4;

/// Rounded up to two digits.
std::string roundedUp(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  std::array<char, 32> text;
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), std::ceil(x / unit) * unit, std::chars_format::general, 2)
          .ptr;
  return {text.data(), end};
}

}  // namespace

RefineBudget::RefineBudget(std::string source, std::size_t most)
    : source_(std::move(source)), most_(std::min(most, kMostVertices)) {}

/// Equilateral triangles with sides of h, of which six share a vertex, have an area of sqrt(3)/2 h^2 for each vertex.
void RefineBudget::expect(double area, double length) {
  if (!std::isfinite(length)) return;
  expected_ += area / (std::sqrt(3.0) / 2 * length * length);
  shortest_ = std::min(shortest_, length);
  longest_ = std::max(longest_, length);
}

void RefineBudget::checkExpected() const {
  if (shortest_ == longest_ && expected_ > static_cast<double>(most_)) fail(expected_);
}

void RefineBudget::count(std::size_t candidates) {
  const std::size_t all = candidates_ += candidates;
  if (all / kCandidatesEach > most_) fail(static_cast<double>(all));
}

void RefineBudget::check(std::size_t vertices) const {
  if (vertices > most_) fail(static_cast<double>(vertices));
}

void RefineBudget::fail(double vertices) const {
  // A tenth more vertices than expected, for borders.
  const double factor = std::sqrt(std::max(1.1 * std::max(expected_, vertices) / static_cast<double>(most_), 1.21));
  const std::string fitting =
      shortest_ == longest_ ? "a length of " + roundedUp(factor * shortest_) : roundedUp(factor) + " times the lengths";
  throw Error({.file = source_,
               .cause = "refining would make more than the " + std::to_string(most_) + " vertices allowed",
               .remedy = fitting + " would fit, or allow more vertices"});
}

}  // namespace shbake
