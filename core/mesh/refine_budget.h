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
  /// `source` is the mesh's, for messages; `most` vertices are allowed, at most kMostVertices.
  RefineBudget(std::string source, std::size_t most);
  static constexpr std::size_t kMostVertices = 700'000'000;  // whose faces' corners 32 bits can number

  /// Expects what a flat part of this area gets for edges of this length.
  void expect(double area, double length);
  /// Vertices expected to be new in all.
  double expected() const { return expected_; }
  /// Throws an Error that says which length would fit when more than allowed are sure to come: where one length is
  /// wanted everywhere, what is expected comes true.
  void checkExpected() const;

  /// Counts candidates for new vertices. Throws when there are so many that most must become vertices.
  void count(std::size_t candidates);
  /// Throws when there are more than allowed.
  void check(std::size_t vertices) const;
  std::size_t most() const { return most_; }

 private:
  [[noreturn]] void fail(double vertices) const;

  std::string source_;
  std::size_t most_;
  std::atomic<std::size_t> candidates_{0};
  double expected_ = 0;
  double shortest_ = std::numeric_limits<double>::infinity(), longest_ = 0;
};

}  // namespace shbake
