// Loops over blocks of work on a fixed number of threads (oneTBB).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace shbake {

/// A team of threads. Results never depend on how many there are: blocks have fixed bounds and sums a fixed order.
class Parallel {
 public:
  static constexpr int kMostThreads = 1024;

  /// `threads` = 0 takes all cores; throws a usage error when it is negative or above kMostThreads.
  explicit Parallel(int threads = 0);
  ~Parallel();

  int threads() const { return threads_; }

  /// The work on one block: items begin..end-1 on worker 0..threads()-1. No two blocks run on one worker at once.
  using Block = std::function<void(std::size_t begin, std::size_t end, int worker)>;
  /// Runs `body` over 0..count-1 in blocks of `blockSize` (at least 1), in any order; the first exception stops the
  /// loop and is rethrown. `body` must not start another loop: a worker that waits for it may be given a second block.
  void forBlocks(std::size_t count, std::size_t blockSize, const Block& body) const;

  /// Sums `body` over blocks of `blockSize` in index order, so that the rounding is the same on any number of threads.
  double sumBlocks(std::size_t count, std::size_t blockSize,
                   const std::function<double(std::size_t begin, std::size_t end)>& body) const;

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace shbake
