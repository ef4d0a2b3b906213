// Whole numbers, reals, lengths, colours and choices out of MeshLab's parameters.
#include "meshlab_plugin/parameter_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "meshlab_plugin/api.h"

namespace shbake::meshlab {
namespace {

[[noreturn]] void outOfRange(const char* label, const std::string& value, const std::string& range) {
  throw usageError(std::string(label) + ": " + value + " is out of range", "give " + range);
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

double checkedReal(double value, const char* label, double least, double most) {
  if (value >= least && value <= most) return value;
  outOfRange(label, numberText(value), numberText(least) + " to " + numberText(most));
}

/// Numbers with commas between them; none where the text is anything else.
std::vector<double> numbersIn(const std::string& text) {
  const char *at = text.data(), *const end = at + text.size();
  const auto skipSpaces = [&] { at = std::find_if(at, end, [](char c) { return c != ' '; }); };
  std::vector<double> numbers;
  for (bool more = true; more;) {
    skipSpaces();
    const auto [rest, failure] = std::from_chars(at, end, numbers.emplace_back());
    if (failure != std::errc()) return {};
    at = rest;
    skipSpaces();
    more = at != end && *at == ',';
    if (more) ++at;
  }
  if (at != end) return {};
  return numbers;
}

}  // namespace

double typedNumber(float value) {
  if (!std::isfinite(value)) return static_cast<double>(value);
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double number = 0;
  std::from_chars(text, end, number);
  return number;
}

int wholeOf(const RichParameterList& p, const char* name, const char* label, int least, int most) {
  const int value = p.getInt(name);
  if (value >= least && value <= most) return value;
  outOfRange(label, std::to_string(value), std::to_string(least) + " to " + std::to_string(most));
}

double realOf(const RichParameterList& p, const char* name, const char* label, double least, double most) {
  return checkedReal(typedNumber(static_cast<float>(p.getFloat(name))), label, least, most);
}

double sliderOf(const RichParameterList& p, const char* name, const char* label, double least, double most) {
  return checkedReal(typedNumber(static_cast<float>(p.getDynamicFloat(name))), label, least, most);
}

double lengthOf(const RichParameterList& p, const char* name, const char* label) {
  const double length = typedNumber(static_cast<float>(p.getAbsPerc(name)));
  if (length > 0 && length <= static_cast<double>(std::numeric_limits<float>::max())) return length;
  outOfRange(label, numberText(length), "more than 0");
}

Rgb sharesOf(const RichParameterList& p, const char* name, const char* label) {
  const std::string text = p.getString(name).toStdString();
  const std::vector<double> shares = numbersIn(text);
  if (shares.size() != 1 && shares.size() != 3) {
    throw usageError(std::string(label) + ": '" + text + "' is not understood",
                     "give one number from 0 to 1, or three with commas such as 0.8,0.5,0.3");
  }
  Rgb color;
  float Rgb::*const channels[] = {&Rgb::x, &Rgb::y, &Rgb::z};
  for (std::size_t c = 0; c < 3; ++c) {
    color.*channels[c] = static_cast<float>(checkedReal(shares[shares.size() == 3 ? c : 0], label, 0, 1));
  }
  return color;
}

std::size_t placeOf(const RichParameterList& p, const char* name, const char* label, std::size_t count) {
  const int place = p.getEnum(name);
  if (place >= 0 && static_cast<std::size_t>(place) < count) return static_cast<std::size_t>(place);
  outOfRange(label, std::to_string(place), "0 to " + std::to_string(count - 1));
}

}  // namespace shbake::meshlab
