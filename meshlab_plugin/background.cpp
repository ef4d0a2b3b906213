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
namespace {

/// Hands back to the system what the work has freed. glibc keeps it in the heap of the thread that ended, and takes
/// another heap for the next one: MeshLab, which stays open for hours, would grow from bake to bake.
void returnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

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
  returnFreedMemory();
  if (failure) std::rethrow_exception(failure);
  done.get();
}

}  // namespace shbake::meshlab
