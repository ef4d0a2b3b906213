// The program around the verbs: parsing (CLI11), messages, exit codes.
#include "cli/program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "cli/help.h"
#include "cli/options.h"
#include "cli/suggest.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

/// Options that every verb has.
struct CommonOptions {
  bool verbose = false, quiet = false, help = false;
  int threads = 0;
  std::string json;

  void declare(CLI::App& app) {
    addSwitch(app, "-v,--verbose", verbose, "tell the time that each stage took");
    addSwitch(app, "-q,--quiet", quiet, "print nothing but warnings and errors");
    addWhole(app, {"--threads", "N", "threads to work on, 1..1024, or 0 for all cores; results do not depend on it"},
             threads, 0, Parallel::kMostThreads);
    addText(app, {"--json", "FILE", "write the report as JSON; '-': to stdout, in place of the text"}, json);
    app.set_help_flag("-h,--help", "print this help");
  }
};

/// Prints one line on stderr. Control characters, which names of files may hold, become question marks.
void complain(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  std::fprintf(stderr, "shbake: %s\n", text.c_str());
}

/// Writes the report where the user wants it. A full disk or a closed pipe is an error here as anywhere.
void deliver(const Report& report, const CommonOptions& common) {
  const bool jsonToStdout = common.json == "-";
  const std::string text = jsonToStdout ? report.json() : common.quiet ? "" : report.text();
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(
        {.file = "standard output", .cause = "cannot be written", .remedy = "free some space or write elsewhere"});
  }
  if (common.json.empty() || jsonToStdout) return;
  AtomicFile file(common.json);
  file.write(report.json());
  file.commit();
}

/// The arguments that `app` did not understand as a usage error that names the first of them.
Error unknownArgument(const CLI::App& app, const std::string& verb) {
  const std::vector<std::string> rest = app.remaining();
  const auto isOption = [](const std::string& s) { return s.size() > 1 && s[0] == '-'; };
  auto bad = std::find_if(rest.begin(), rest.end(), isOption);
  const std::string remedy = "'shbake " + verb + " --help' lists what it takes";
  if (bad == rest.end()) return usageError("'" + rest.front() + "' is one argument too many", remedy);
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string typed = bad->substr(0, bad->find('='));
  const std::string nearest = nearestWord(typed, names);
  return usageError("unknown option " + typed, nearest.empty() ? remedy : "did you mean " + nearest + "? " + remedy);
}

/// CLI11's complaint about an option as a usage error.
Error parseFailure(const CLI::ParseError& error, const CLI::App& app, const std::string& verb) {
  if (!app.remaining().empty()) return unknownArgument(app, verb);
  const std::string text = error.what(), name = text.substr(0, text.find(':'));
  const bool lacksValue = error.get_name() == "ArgumentMismatch" && name.starts_with('-');
  return usageError(lacksValue ? name + " needs a value" : text, "'shbake " + verb + " --help' tells more");
}

const VerbEntry& findVerb(const std::string& name) {
  std::vector<std::string> names;
  for (const VerbEntry* verb : allVerbs()) {
    if (verb->name == name) return *verb;
    names.push_back(verb->name);
  }
  const std::string nearest = nearestWord(name, names);
  throw usageError((name.starts_with('-') ? "unknown option " : "unknown verb ") + name,
                   (nearest.empty() ? "" : "did you mean " + nearest + "? ") + "'shbake --help' lists the verbs");
}

/// The exit code.
int runVerb(Verb& verb, const VerbEntry& entry, const CommonOptions& common, Interrupt& interrupt) {
  if (common.quiet && common.verbose)
    throw usageError("--quiet and --verbose contradict each other", "give one of them");
  if (!common.json.empty() && common.json != "-") checkWritable(common.json);
  using Style = ProgressDisplay::Style;
  ProgressDisplay display(common.quiet              ? Style::none
                          : ::isatty(STDERR_FILENO) ? Style::bar
                                                    : Style::lines,
                          common.verbose);
  interrupt.onHardStop([&display] { display.finish(); });
  Progress progress([&](const ProgressState& state) {
    display.update(state);
    return !interrupt.requested();
  });
  const Parallel parallel(common.threads);
  Report report;
  report.data("shbake", SHBAKE_VERSION);
  report.data("verb", entry.name);
  Session session{parallel, progress, display, report, common.verbose};
  try {
    verb.run(session);
  } catch (...) {
    display.finish();
    interrupt.onHardStop({});
    throw;
  }
  display.finish();
  interrupt.onHardStop({});
  deliver(report, common);
  return session.passed ? kDone : kWorkFailed;
}

int parseAndRun(const std::vector<std::string>& arguments, Interrupt& interrupt) {
  if (arguments.empty()) {
    std::fputs(programHelp().c_str(), stderr);
    return kWrongUsage;
  }
  if (arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "help") {
    std::fputs(programHelp().c_str(), stdout);
    return kDone;
  }
  if (arguments[0] == "--version") {
    std::puts("shbake " SHBAKE_VERSION);
    return kDone;
  }
  const VerbEntry& entry = findVerb(arguments[0]);
  const std::unique_ptr<Verb> verb = entry.make();
  CLI::App app;
  CommonOptions common;
  verb->declare(app);
  common.declare(app);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend() - 1));  // CLI11 takes them last first
  } catch (const CLI::CallForHelp&) {
    std::fputs(verbHelp(entry, app).c_str(), stdout);
    return kDone;
  } catch (const CLI::ParseError& error) {
    throw parseFailure(error, app, entry.name);
  }
  return runVerb(*verb, entry, common, interrupt);
}

}  // namespace

int runProgram(const std::vector<std::string>& arguments, Interrupt& interrupt) noexcept {
  int code = kWorkFailed;
  std::string message;
  try {
    code = parseAndRun(arguments, interrupt);
  } catch (const Error& error) {
    const ErrorKind kind = error.kind();
    code = kind == ErrorKind::usage ? kWrongUsage : kind == ErrorKind::cancelled ? interrupt.exitCode() : kWorkFailed;
    message = error.what();
  } catch (const std::bad_alloc&) {
    message = "not enough memory; use a smaller mesh or order, fewer rays, or a machine with more";
  } catch (const std::length_error&) {
    message = "not enough memory; use a smaller mesh or order, fewer rays, or a machine with more";
  } catch (const std::exception& error) {
    message = std::string("internal error: ") + error.what() + "; please report it with the command that led to it";
  }
  interrupt.finish();
  if (!message.empty()) complain(message);
  return code;
}

}  // namespace shbake::cli
