// The help pages, made from the verbs' own declarations so that they cannot drift from what is parsed.
#include "cli/help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace shbake::cli {
namespace {

constexpr std::size_t kColumns = 80;
/// Where descriptions begin.
constexpr std::size_t kDescriptionColumn = 26;

std::string entryLine(const std::string& left, const std::string& right) {
  std::string text = "  " + left;
  if (text.size() + 2 > kDescriptionColumn) {
    text += "\n" + std::string(kDescriptionColumn, ' ');
  } else {
    text.resize(kDescriptionColumn, ' ');
  }
  return text + wrapped(right, kDescriptionColumn) + "\n";
}

std::string optionNames(const CLI::Option& option) {
  const bool takesValue = option.get_items_expected_max() > 0;
  std::string names;
  for (const auto& s : option.get_snames()) names += (names.empty() ? "-" : ", -") + s;
  for (const auto& l : option.get_lnames()) names += (names.empty() ? "--" : ", --") + l;
  return takesValue && !option.get_type_name().empty() ? names + " " + option.get_type_name() : names;
}

std::string optionHelp(const CLI::Option& option) {
  const std::string& standard = option.get_default_str();
  return option.get_description() + (standard.empty() ? "" : " (default: " + standard + ")");
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent) {
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!all.empty()) all += "\n" + (line.empty() ? "" : std::string(indent, ' '));
    std::size_t column = indent;
    const std::size_t lead = line.find_first_not_of(' ');
    if (lead != std::string::npos && lead > 0) {  // an example: kept as it stands
      all += line;
      continue;
    }
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (column > indent && column + 1 + word.size() > kColumns) {
        all += "\n" + std::string(indent, ' ');
        column = indent;
      } else if (column > indent) {
        all += ' ';
        ++column;
      }
      all += word;
      column += word.size();
    }
  }
  return all;
}

std::string programHelp() {
  std::string text =
      "shbake bakes how light reaches every vertex of a mesh (precomputed radiance\n"
      "transfer in spherical harmonics), so that it can be relit at once.\n\n"
      "Usage: shbake VERB [OPTIONS]\n\nVerbs:\n";
  for (const VerbEntry* verb : allVerbs()) text += entryLine(verb->name, verb->summary);
  return text +
         "\nExamples:\n"
         "  shbake bake bunny.obj -o bunny.ply    shadows and reflections, to 1 % error\n"
         "  shbake info bunny.ply                 what is in the file, and how exact it is\n"
         "\n'shbake VERB --help' tells all options; 'shbake --version' the version.\n";
}

std::string verbHelp(const VerbEntry& entry, const CLI::App& app) {
  std::string arguments, options;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      arguments += entryLine(option->get_single_name(), option->get_description());
    } else {
      options += entryLine(optionNames(*option), optionHelp(*option));
    }
  }
  return std::string("Usage: shbake ") + entry.name + " " + entry.arguments + " [OPTIONS]\n\n" +
         wrapped(entry.details, 0) + "\n" + (arguments.empty() ? "" : "\nArguments:\n" + arguments) + "\nOptions:\n" +
         options;
}

}  // namespace shbake::cli
