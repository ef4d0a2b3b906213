// How much memory there is, and how much this process has used.
#pragma once

#include <cstddef>

namespace shbake {

/// Bytes that can be allocated without swapping, respecting the control group's limit; 0 when the system does not tell.
std::size_t availableMemory();

/// The largest resident set of this process so far, in bytes.
std::size_t peakMemory();

}  // namespace shbake
