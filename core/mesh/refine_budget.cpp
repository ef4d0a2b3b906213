// How many vertices a refinement may make.
#include "mesh/refine_budget.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "mesh/refine.h"

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

RefineBudget::RefineBudget(std::string source, std::size_t before, std::size_t most)
    : source_(std::move(source)), before_(before), most_(std::min(most, kMostVertices)) {}

/// Equilateral triangles with sides of h, of which six share a vertex, have an area of sqrt(3)/2 h^2 for each vertex.
/// Vertices on a border have half of the triangles around them; halving may set them sqrt(2) times as densely.
void RefineBudget::expect(double area, double border, double length) {
  if (!std::isfinite(length)) return;
  inside_ += area / (std::sqrt(3.0) / 2 * length * length);
  onBorders_ += std::sqrt(2.0) / 2 * border / length;
  shortest_ = std::min(shortest_, length);
  longest_ = std::max(longest_, length);
}

void RefineBudget::checkExpected() const {
  // A tenth may be wrong, in favour of trying.
  if (shortest_ == longest_ && inside_ > 1.1 * static_cast<double>(most_)) fail(inside_);
}

void RefineBudget::count(std::size_t candidates) {
  const std::size_t all = candidates_ += candidates;
  if (all / kCandidatesEach > most_) fail(static_cast<double>(all));
}

void RefineBudget::check(std::size_t vertices) const {
  if (vertices > most_) fail(static_cast<double>(vertices - std::min(before_, vertices)));
}

/// `made`: how many new vertices there are, at the least.
void RefineBudget::fail(double made) const {
  constexpr double kStep = 1.05;
  const std::string cause = "refining would make more than the " + std::to_string(most_) + " vertices allowed";
  const double room = static_cast<double>(most_) - static_cast<double>(before_);
  if (room < 1)
    throw TooManyVertices({.file = source_, .cause = cause, .remedy = "allow more: it has as many already"});
  // What has been made tells how far off the expectation is.
  const double excess = std::max(1.0, made / std::max(1.0, expected()));
  double longer = kStep;
  while (excess * expected(longer) > room) longer *= kStep;
  const std::string fitting =
      shortest_ == longest_ ? "a length of " + roundedUp(longer * shortest_) : roundedUp(longer) + " times the lengths";
  throw TooManyVertices({.file = source_, .cause = cause, .remedy = fitting + " would fit, or allow more vertices"});
}

}  // namespace shbake
