// How much memory there is and was: against what the test itself allocates.
#include <catch2/catch.hpp>
#include <cstring>
#include <memory>

#include "base/memory.h"

using namespace shbake;

TEST_CASE("the peak grows by what is touched and stays when it is freed") {
  constexpr std::size_t kBytes = std::size_t(256) << 20;
  const std::size_t before = peakMemory();
  CHECK(before > 0);
  {
    const std::unique_ptr<char[]> block(new char[kBytes]);
    for (std::size_t i = 0; i < kBytes; i += 4096) static_cast<volatile char*>(block.get())[i] = 1;
  }
  // Anything the process freed before may be counted in `before`: hence half.
  CHECK(peakMemory() >= before + kBytes / 2);
}

TEST_CASE("available memory is that of a machine: more than this test, less than an address space") {
  CHECK(availableMemory() > (std::size_t(16) << 20));
  CHECK(availableMemory() < (std::size_t(1) << 48));
}
