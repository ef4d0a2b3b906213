// What a loop of oneTBB does before what, told to the thread sanitizer.
#pragma once

#ifdef SHBAKE_TELL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>

#include <vector>
#endif

namespace shbake {

/// Debian's oneTBB is not instrumented: the sanitizer does not see what orders its threads, and would call each result
/// of a loop a race. This tells it that order, and no more than that: a block comes after what the caller did before
/// the loop and after the blocks that its worker did, and all blocks come before what the caller does next. Blocks of
/// two workers stay unordered, so that their races are found. Does nothing in other builds.
class LoopOrder {
 public:
#ifdef SHBAKE_TELL_THREAD_SANITIZER
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
    Block(LoopOrder& loop, int worker) : loop_(loop), worker_(&loop.workers_[static_cast<std::size_t>(worker)]) {
      __tsan_acquire(&loop_.begin_);
      __tsan_acquire(worker_);
    }
    ~Block() {
      __tsan_release(worker_);
      __tsan_release(&loop_.end_);
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

   private:
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
  };
#endif
};

}  // namespace shbake
