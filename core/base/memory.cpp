// How much memory there is, by /proc, the control group and getrusage.
#include "base/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace shbake {
namespace {

std::size_t readNumber(const char* path) {
  std::ifstream in(path);
  std::size_t value = 0;
  return in >> value ? value : 0;  // "max" does not parse: no limit
}

}  // namespace

std::size_t availableMemory() {
  std::size_t bytes = 0;
  std::ifstream in("/proc/meminfo");
  for (std::string key, rest; in >> key && std::getline(in, rest);) {
    if (key == "MemAvailable:") bytes = std::stoull(rest) * 1024;
  }
  const std::size_t limit = readNumber("/sys/fs/cgroup/memory.max");
  const std::size_t used = readNumber("/sys/fs/cgroup/memory.current");
  return limit > used ? std::min(bytes, limit - used) : bytes;
}

std::size_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace shbake
