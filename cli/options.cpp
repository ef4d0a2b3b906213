// Options of a verb, on top of CLI11: values are read by parse.h, so that messages and ranges are shbake's own.
#include "cli/options.h"

#include <CLI/CLI.hpp>

#include "cli/format.h"
#include "cli/parse.h"
#include "cli/suggest.h"

namespace shbake::cli {

CLI::Option* addOption(CLI::App& app, const OptionText& text, const std::string& defaultText,
                       std::function<void(const std::string& name, const std::string& value)> parse) {
  const std::string name = text.names.substr(text.names.rfind(',') + 1);
  CLI::Option* option = app.add_option_function<std::string>(
      text.names, [name, parse = std::move(parse)](const std::string& value) { parse(name, value); }, text.help);
  option->type_name(text.value)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  return defaultText.empty() ? option : option->default_str(defaultText);
}

void addFile(CLI::App& app, const std::string& name, std::string& value, const std::string& help) {
  app.add_option(name, value, help)->type_name("");
}

CLI::Option* addText(CLI::App& app, const OptionText& text, std::string& value) {
  return addOption(app, text, "", [&value](const std::string&, const std::string& given) { value = given; });
}

void addList(CLI::App& app, const OptionText& text, std::vector<std::string>& values) {
  app.add_option(text.names, values, text.help)->type_name(text.value);
}

void addRepeated(CLI::App& app, const OptionText& text, std::vector<std::string>& values) {
  app.add_option(text.names, values, text.help)->type_name(text.value)->allow_extra_args(false);
}

template <class T>
CLI::Option* addWhole(CLI::App& app, const OptionText& text, T& value, std::int64_t least, std::int64_t most) {
  return addOption(app, text, std::to_string(value), [&value, least, most](const std::string& n, const std::string& v) {
    value = static_cast<T>(parseWhole(n, v, least, most));
  });
}

template CLI::Option* addWhole(CLI::App&, const OptionText&, int&, std::int64_t, std::int64_t);
template CLI::Option* addWhole(CLI::App&, const OptionText&, std::uint64_t&, std::int64_t, std::int64_t);

CLI::Option* addReal(CLI::App& app, const OptionText& text, double& value, double least, double most) {
  return addOption(app, text, formatNumber(value), [&value, least, most](const std::string& n, const std::string& v) {
    value = parseReal(n, v, least, most);
  });
}

CLI::Option* addSwitch(CLI::App& app, const std::string& names, bool& value, const std::string& help) {
  return app.add_flag(names, value, help)->default_str("off");
}

void letValueBeLeftOut(CLI::Option& option) {
  option.expected(0, 1);
}

bool isGiven(const CLI::Option* option) {
  return option->count() > 0;
}

void failChoice(const std::string& option, const std::string& text, const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  const std::string nearest = nearestWord(text, names);
  throw usageError(
      option + ": '" + text + "' is not known" + (nearest.empty() ? std::string() : " (did you mean " + nearest + "?)"),
      "give " + list);
}

}  // namespace shbake::cli
