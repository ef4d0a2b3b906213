// One thread for the work, and the caller's for what its progress is shown with.
#include "meshlab_plugin/background.h"

#include <chrono>
#include <exception>
#include <future>
#include <mutex>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace shbake::meshlab {

void runInBackground(const std::function<void(Progress&)>& work, const ProgressCallback& poll) {
  std::mutex mutex;
  ProgressState latest;
  bool go = true;
  Progress progress([&](const ProgressState& state) {
    const std::lock_guard lock(mutex);
    latest = state;
    return go;
  });
  auto done = std::async(std::launch::async, [&] { work(progress); });
  std::exception_ptr failure;
  while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    ProgressState state;
    {
      const std::lock_guard lock(mutex);
      if (!go) continue;
      state = latest;
    }
    bool wanted = false;
    try {
      wanted = poll(state);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    go = wanted;
  }
  done.wait();
  if (failure) std::rethrow_exception(failure);
  done.get();
}

void returnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace shbake::meshlab
