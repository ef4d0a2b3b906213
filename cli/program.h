// The program around the verbs: parsing, messages, exit codes.
#pragma once

#include <string>
#include <vector>

#include "cli/interrupt.h"

namespace shbake::cli {

/// Exit codes of the program; work that a signal stopped ends with Interrupt::exitCode().
enum ExitCode { kDone = 0, kWorkFailed = 1, kWrongUsage = 2 };

/// Runs `shbake` with the arguments that follow its name, and returns its exit code. Never throws: what goes wrong is
/// told on stderr in one line, "shbake: FILE: PLACE: cause; remedy".
int runProgram(const std::vector<std::string>& arguments, Interrupt& interrupt) noexcept;

}  // namespace shbake::cli
