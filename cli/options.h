// Options of a verb: each is declared once, with its range and default, which its help then tells. Verbs see CLI11 only
// through these functions, since its header takes longer to compile than a verb.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace shbake::cli {

/// How an option is shown: `names` as "-o,--output", `value` as "FILE", `help` as a sentence without a full stop.
struct OptionText {
  std::string names;
  std::string value;
  std::string help;
};

/// Adds an option whose text `parse` takes; `parse` is given the option's longest name and throws usage errors.
/// `defaultText` is told by help; empty: none is.
CLI::Option* addOption(CLI::App& app, const OptionText& text, const std::string& defaultText,
                       std::function<void(const std::string& name, const std::string& value)> parse);

/// Adds a positional argument that takes one file name, required by the verb itself.
void addFile(CLI::App& app, const std::string& name, std::string& value, const std::string& help);

/// Adds an option that takes any text, such as a file name; help tells no default.
CLI::Option* addText(CLI::App& app, const OptionText& text, std::string& value);

/// Adds an option, or a positional argument without a leading dash, that takes all values that follow.
void addList(CLI::App& app, const OptionText& text, std::vector<std::string>& values);

/// Adds an option that may be given several times, each time with one value.
void addRepeated(CLI::App& app, const OptionText& text, std::vector<std::string>& values);

/// Adds a whole number in least..most; its value now is the default that help tells.
template <class T>
CLI::Option* addWhole(CLI::App& app, const OptionText& text, T& value, std::int64_t least, std::int64_t most);

/// Adds a number in least..most; its value now is the default that help tells.
CLI::Option* addReal(CLI::App& app, const OptionText& text, double& value, double least, double most);

/// Adds a switch without a value.
CLI::Option* addSwitch(CLI::App& app, const std::string& names, bool& value, const std::string& help);

/// Adds a choice of names; its value now is the default that help tells.
template <class T>
CLI::Option* addChoice(CLI::App& app, const OptionText& text, T& value,
                       const std::vector<std::pair<std::string, T>>& choices);

/// Lets an option be given without its value, of which the text is then empty.
void letValueBeLeftOut(CLI::Option& option);

/// Whether an option stood on the command line.
bool isGiven(const CLI::Option* option);

/// Throws a usage error that lists the `names` a choice has, and the nearest one.
[[noreturn]] void failChoice(const std::string& option, const std::string& text, const std::vector<std::string>& names);

template <class T>
CLI::Option* addChoice(CLI::App& app, const OptionText& text, T& value,
                       const std::vector<std::pair<std::string, T>>& choices) {
  std::string chosen;
  for (const auto& [name, meaning] : choices) {
    if (meaning == value) chosen = name;
  }
  return addOption(app, text, chosen, [&value, choices](const std::string& option, const std::string& given) {
    std::vector<std::string> names;
    for (const auto& [name, meaning] : choices) {
      if (name == given) {
        value = meaning;
        return;
      }
      names.push_back(name);
    }
    failChoice(option, given, names);
  });
}

}  // namespace shbake::cli
