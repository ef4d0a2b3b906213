// The help pages: laid out for 80 columns.
#pragma once

#include <string>

#include "cli/verb.h"

namespace shbake::cli {

/// `text` with line breaks at spaces so that no line, after `indent` blanks, passes column 80 (words longer than that
/// aside). Lines of the text itself stay; the first line is not indented.
std::string wrapped(const std::string& text, std::size_t indent);

/// What `shbake --help` prints: what the program is, its verbs, two examples.
std::string programHelp();

/// What `shbake VERB --help` prints: usage, what the verb does, its arguments and options with ranges and defaults.
std::string verbHelp(const VerbEntry& entry, const CLI::App& app);

}  // namespace shbake::cli
