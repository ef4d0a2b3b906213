// Long work beside a thread that must stay awake: MeshLab's window, which alone may draw.
#pragma once

#include <functional>

#include "shbake.h"

namespace shbake::meshlab {

/// Runs `work` on another thread and calls `poll` here every 50 ms with how far it is, until it is done. When `poll`
/// returns false the work is cancelled. Throws what `work` throws (an Error of kind `cancelled` after cancelling), and
/// what `poll` throws, once the work has ended.
void runInBackground(const std::function<void(Progress&)>& work, const ProgressCallback& poll);

/// Hands back to the system what has been freed. glibc would keep all of it for later; the end of each thread's heap it
/// keeps all the same, up to 64 MB, and uses it again.
void returnFreedMemory();

}  // namespace shbake::meshlab
