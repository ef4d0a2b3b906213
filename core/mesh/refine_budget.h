// How many vertices a refinement may make, and what to say when it asks for more.
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <string>

namespace shbake {

/// Keeps count while a mesh is refined. count() may be called from any thread.
class RefineBudget {
 public:
  /// `source` is the mesh's, for messages; of `most` vertices, at most kMostVertices, it has `before` already.
  RefineBudget(std::string source, std::size_t before, std::size_t most);
  static constexpr std::size_t kMostVertices = 700'000'000;  // whose faces' corners 32 bits can number

  /// Expects what a flat face of this area, with so much of its sides on the border of a patch, gets for edges of this
  /// length.
  void expect(double area, double border, double length);
  /// Vertices expected to be new in all, for lengths `longer` times as long.
  double expected(double longer = 1) const { return inside_ / (longer * longer) + onBorders_ / longer; }
  /// Throws TooManyVertices that says which length would fit when more than allowed are sure to come: where one length
  /// is wanted everywhere, what is expected comes true.
  void checkExpected() const;

  /// Counts candidates for new vertices. Throws when there are so many that most must become vertices.
  void count(std::size_t candidates);
  /// Throws when there are more than allowed.
  void check(std::size_t vertices) const;
  std::size_t most() const { return most_; }

 private:
  [[noreturn]] void fail(double made) const;

  std::string source_;
  std::size_t before_, most_;
  std::atomic<std::size_t> candidates_{0};
  double inside_ = 0, onBorders_ = 0;
  double shortest_ = std::numeric_limits<double>::infinity(), longest_ = 0;
};

}  // namespace shbake
