// What the loops of oneTBB and Embree do before what, told to the thread sanitizer.
#pragma once

// SHBAKE_TELL_THREAD_SANITIZER: for a file that is not instrumented itself, because it compiles parts of oneTBB.
#if defined(__SANITIZE_THREAD__) || defined(SHBAKE_TELL_THREAD_SANITIZER)
#define SHBAKE_TELLS_ORDER
#include <sanitizer/tsan_interface.h>

#include <cstddef>
#include <vector>
#endif

namespace shbake {

/// Debian's oneTBB and Embree are not instrumented: the sanitizer does not see what orders their threads, and would
/// call each result of a loop a race. This tells it that order, and no more than that: a block comes after what the
/// caller did before the loop and after the blocks that its worker did, and all blocks come before what the caller does
/// next. Blocks of two workers stay unordered, so that their races are found. Does nothing in other builds.
class LoopOrder {
 public:
#ifdef SHBAKE_TELLS_ORDER
  explicit LoopOrder(int workers) : workers_(static_cast<std::size_t>(workers)) {
    __tsan_release(&begin_);
  }
  ~LoopOrder() {
    __tsan_acquire(&end_);
  }
  LoopOrder(const LoopOrder&) = delete;
  LoopOrder& operator=(const LoopOrder&) = delete;

  class Block {
   public:
    /// A block on worker 0..workers-1.
    Block(LoopOrder& loop, int worker) : Block(loop, &loop.workers_[static_cast<std::size_t>(worker)]) {}
    /// A block on nobody knows which worker: it comes after no other.
    explicit Block(LoopOrder& loop) : Block(loop, nullptr) {}
    ~Block() {
      if (worker_ != nullptr) __tsan_release(worker_);
      __tsan_release(&loop_.end_);
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

   private:
    Block(LoopOrder& loop, char* worker) : loop_(loop), worker_(worker) {
      __tsan_acquire(&loop_.begin_);
      if (worker_ != nullptr) __tsan_acquire(worker_);
    }

    LoopOrder& loop_;
    char* worker_;
  };

 private:
  char begin_ = 0, end_ = 0;
  std::vector<char> workers_;
#else
  explicit LoopOrder(int) {}

  struct Block {
    Block(LoopOrder&, int) {}
    explicit Block(LoopOrder&) {}
  };
#endif
};

}  // namespace shbake
