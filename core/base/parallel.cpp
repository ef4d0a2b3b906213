// Loops over blocks of work, by oneTBB.
#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/loop_order.h"

namespace shbake {

struct Parallel::Arena {
  tbb::task_arena arena;
};

Parallel::Parallel(int threads) : threads_(threads) {
  if (threads < 0) throw usageError("the number of threads is negative", "use 0 for all cores");
  if (threads > kMostThreads) {
    throw usageError("the number of threads is above " + std::to_string(kMostThreads), "use 0 for all cores");
  }
  // Without this, oneTBB grants no more threads than there are cores, and says so on stderr when asked for more.
  static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kMostThreads);
  if (threads_ == 0) threads_ = tbb::info::default_concurrency();
  arena_ = std::make_unique<Arena>(tbb::task_arena(threads_));
}

Parallel::~Parallel() = default;

void Parallel::forBlocks(std::size_t count, std::size_t blockSize, const Block& body) const {
  const std::size_t blocks = (count + blockSize - 1) / blockSize;
  LoopOrder order(threads_);
  arena_->arena.execute([&] {
    tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
      const int worker = tbb::this_task_arena::current_thread_index();
      const LoopOrder::Block block(order, worker);
      body(b * blockSize, std::min(count, (b + 1) * blockSize), worker);
    });
  });
}

double Parallel::sumBlocks(std::size_t count, std::size_t blockSize,
                           const std::function<double(std::size_t, std::size_t)>& body) const {
  std::vector<double> sums((count + blockSize - 1) / blockSize);
  forBlocks(count, blockSize,
            [&](std::size_t begin, std::size_t end, int) { sums[begin / blockSize] = body(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace shbake
