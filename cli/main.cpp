// The `shbake` program.
#include <csignal>

#include "cli/program.h"

int main(int argc, char** argv) {
  // A write past the limit on file sizes shall fail and be told, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  shbake::cli::Interrupt interrupt;
  return shbake::cli::runProgram({argv + 1, argv + argc}, interrupt);
}
