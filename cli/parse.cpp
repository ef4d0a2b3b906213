// Values of options as people type them, read with std::from_chars: the whole text counts, the locale does not.
#include "cli/parse.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "cli/format.h"

namespace shbake::cli {
namespace {

template <class T>
std::optional<T> read(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Error notUnderstood(const std::string& name, const std::string& text, const std::string& what,
                    const std::string& remedy) {
  return usageError(name + ": '" + text + "' is not " + what, remedy);
}

Error outOfRange(const std::string& name, const std::string& text, const std::string& range) {
  return usageError(name + ": " + text + " is out of range", "give " + range);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The factor of a suffix of bytes, or nothing for an unknown one.
std::optional<double> byteFactor(std::string suffix) {
  for (char& c : suffix) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (suffix.ends_with("IB")) {
    suffix.resize(suffix.size() - 2);
  } else if (suffix.ends_with("B")) {
    suffix.resize(suffix.size() - 1);
  }
  if (suffix.empty()) return 1;
  const std::size_t power = std::string("KMGT").find(suffix);
  if (suffix.size() != 1 || power == std::string::npos) return std::nullopt;
  return std::ldexp(1.0, 10 * (static_cast<int>(power) + 1));
}

}  // namespace

std::int64_t parseWhole(const std::string& name, const std::string& text, std::int64_t least, std::int64_t most) {
  const std::string range = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const auto value = read<std::int64_t>(text);
  if (!value) throw notUnderstood(name, text, "a whole number", "give " + range);
  if (*value < least || *value > most) throw outOfRange(name, text, range);
  return *value;
}

double parseReal(const std::string& name, const std::string& text, double least, double most) {
  const std::string range = "a number from " + formatNumber(least) + " to " + formatNumber(most);
  const auto value = read<double>(text);
  if (!value || !std::isfinite(*value)) throw notUnderstood(name, text, "a number", "give " + range);
  if (*value < least || *value > most) throw outOfRange(name, text, range);
  return *value;
}

std::size_t parseBytes(const std::string& name, const std::string& text) {
  constexpr const char* kRemedy = "give bytes, or a number with K, M, G or T such as 512M";
  const std::size_t digits = text.find_first_not_of("0123456789.");
  const auto number = read<double>(text.substr(0, digits));
  const auto factor = byteFactor(digits == std::string::npos ? "" : text.substr(digits));
  if (!number || !factor) throw notUnderstood(name, text, "a size", kRemedy);
  const double bytes = *number * *factor;
  if (!(bytes >= 1 && bytes < 0x1p63)) throw outOfRange(name, text, "at least 1 byte");
  return static_cast<std::size_t>(bytes);
}

Rgb parseRgb(const std::string& name, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  std::vector<float> values;
  for (const std::string& part : parts) {
    if (!read<double>(part)) break;
    values.push_back(static_cast<float>(parseReal(name, part, 0, 1)));
  }
  if (values.size() != parts.size() || (values.size() != 1 && values.size() != 3)) {
    throw notUnderstood(name, text, "a colour",
                        "give one number from 0 to 1, or three with commas such as 0.8,0.5,0.3");
  }
  return values.size() == 1 ? Rgb(values[0], values[0], values[0]) : Rgb(values[0], values[1], values[2]);
}

}  // namespace shbake::cli
