// gnuplot as a child process.
#pragma once

#include <string>

#include "base/progress.h"

namespace shbake::chart {

/// What gnuplot writes to standard output for a script. It is started without a shell and without its user's settings,
/// found by PATH or by the name `program`. Throws an Error that says what to install where there is none, one with its
/// complaint where it fails, and ends it when cancelled by `progress`.
std::string runGnuplot(const std::string& script, Progress& progress, const std::string& program = "gnuplot");

/// Throws the Error that runGnuplot() would throw where there is no gnuplot: asked before long work starts.
void requireGnuplot(const std::string& program = "gnuplot");

}  // namespace shbake::chart
