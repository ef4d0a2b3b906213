// A loop whose blocks do what they may and, when told so, one thing that they may not: what the thread sanitizer must
// let pass and what it must find.
//
// Usage: race ordered|racing|racing-strings
#include <atomic>
#include <cstdio>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/parallel.h"

int main(int argc, char** argv) {
  const std::string_view mode = argc == 2 ? argv[1] : "";
  if (mode != "ordered" && mode != "racing" && mode != "racing-strings") {
    std::fputs("usage: race ordered|racing|racing-strings\n", stderr);
    return 2;
  }
  constexpr int kThreads = 2, kLoops = 20;
  const shbake::Parallel parallel(kThreads);
  std::vector<int> blocks(2), workers(kThreads);
  int shared = 0;
  std::string word = "a word that needs memory of its own", sharedWord = word;
  for (int loop = 0; loop < kLoops; ++loop) {
    for (int& block : blocks) block = loop;
    std::atomic<int> begun = 0;
    parallel.forBlocks(blocks.size(), 1, [&](std::size_t begin, std::size_t, int worker) {
      // Both threads are in the loop before one goes on.
      for (++begun; begun < kThreads;) std::this_thread::yield();
      ++blocks[begin];
      ++workers[static_cast<std::size_t>(worker)];
      if (mode == "racing") ++shared;
      if (mode == "racing-strings") sharedWord.assign(word);
    });
    shared += blocks[0] + blocks[1];
  }
  std::printf("%d %s\n", shared + workers[0] + workers[1], sharedWord.c_str());
}
