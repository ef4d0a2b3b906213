// Work that is stopped from inside: how it ends, and how soon.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/progress.h"

namespace shbake {

/// What a stage may do at most between two reports, in the unit that it counts.
struct StageLimit {
  std::string stage;
  double most = 0;
};

/// Runs `work` to its end and CHECKs that its stages are those of `limits`, in that order, and that each keeps its
/// limit from report to report up to its end. Then stops it at reports spread over all of it and CHECKs that it ends
/// each time as cancelled, without another report. `work` must do the same each time, on one thread.
void checkStopping(const std::function<void(Progress&)>& work, const std::vector<StageLimit>& limits);

}  // namespace shbake
