// A verb of the command line: `shbake VERB ...`.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "cli/progress_display.h"
#include "cli/report.h"
#include "shbake.h"

namespace CLI {
class App;
}

namespace shbake::cli {

/// What a verb works with while it runs.
struct Session {
  const Parallel& parallel;
  Progress& progress;
  ProgressDisplay& display;
  Report& report;
  bool verbose = false;
  bool passed = true;  ///< false: the work was done and reported, but what it tested failed (exit code 1)

  /// Tells the user one thing that they should know, now on stderr and in the JSON report.
  void warn(const std::string& sentence);

  std::vector<std::string> warnings{};
};

class Verb {
 public:
  virtual ~Verb() = default;
  /// Adds the verb's arguments and options; their values are members of the verb.
  virtual void declare(CLI::App& app) = 0;
  /// Does the work, once the values have been parsed. What it finds goes to the session's report.
  virtual void run(Session& session) = 0;
};

/// What is known of a verb before it is made.
struct VerbEntry {
  const char* name;
  const char* arguments;  ///< what must be given, for the line of usage: "MESH -o FILE"
  const char* summary;    ///< half a line for the list of verbs
  const char* details;    ///< a paragraph and examples for its own help
  std::unique_ptr<Verb> (*make)();
};

/// All verbs, in the order in which help lists them. A new one is a file in verbs/ and a line in verb.cpp.
std::span<const VerbEntry* const> allVerbs();

}  // namespace shbake::cli
