#include "mesh/text_scanner.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kReportBytes = 1 << 18;  // a few milliseconds of parsing

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

TextScanner::TextScanner(const std::string& path, std::string_view text, Continuation continuation, Progress& progress)
    : path_(path), text_(text), joinLines_(continuation == Continuation::backslash), progress_(progress) {
  lineEnd_ = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte order mark of UTF-8
}

std::string_view TextScanner::takeLine() {
  const char* begin = text_.data() + at_;
  const std::size_t left = text_.size() - at_;
  const char* newline = static_cast<const char*>(std::memchr(begin, lineEnd_, left));
  std::size_t size = newline ? static_cast<std::size_t>(newline - begin) : left;
  at_ += newline ? size + 1 : size;
  ++linesTaken_;
  if (size > 0 && begin[size - 1] == '\r') --size;
  return {begin, size};
}

bool TextScanner::nextLine() {
  if (at_ - reported_ >= kReportBytes || at_ == text_.size()) {
    progress_.advance(static_cast<double>(at_ - reported_));
    reported_ = at_;
  }
  if (at_ == text_.size()) {
    cursor_ = end_ = nullptr;
    return false;
  }
  std::string_view line = takeLine();
  lineNumber_ = linesTaken_;
  if (joinLines_ && !line.empty() && line.back() == '\\') {
    joined_.clear();
    while (!line.empty() && line.back() == '\\') {
      joined_.append(line.substr(0, line.size() - 1));
      joined_ += ' ';
      line = at_ == text_.size() ? std::string_view() : takeLine();
    }
    joined_.append(line);
    line = joined_;
  }
  cursor_ = line.data();
  end_ = line.data() + line.size();
  return true;
}

bool TextScanner::nextWord(std::string_view& word) {
  while (cursor_ != end_ && isBlank(*cursor_)) ++cursor_;
  if (cursor_ == end_ || *cursor_ == '#') return false;
  const char* begin = cursor_;
  while (cursor_ != end_ && !isBlank(*cursor_)) ++cursor_;
  word = {begin, static_cast<std::size_t>(cursor_ - begin)};
  return true;
}

bool TextScanner::nextWordAnywhere(std::string_view& word) {
  while (!nextWord(word)) {
    if (!nextLine()) return false;
  }
  return true;
}

std::string_view TextScanner::restOfLine() const {
  const char *begin = cursor_, *end = end_;
  while (begin != end && isBlank(*begin)) ++begin;
  while (begin != end && isBlank(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

bool TextScanner::atLineEnd() const {
  const std::string_view rest = restOfLine();
  return rest.empty() || rest[0] == '#';
}

double TextScanner::number(const char* what) {
  std::string_view word;
  if (!nextWord(word)) {
    fail(std::string("the line ends where ") + what + " should stand", "check that the file is complete");
  }
  return toNumber(word, what);
}

Vec3d TextScanner::numbers3(const char* what) {
  const double x = number(what), y = number(what), z = number(what);
  return {x, y, z};
}

double TextScanner::toNumber(std::string_view word, const char* what) const {
  double value = 0;
  if (!parseNumber(word, value)) {
    const bool comma = word.find(',') != std::string_view::npos;
    fail(quotedWord(word) + " is not a number where " + what + " should stand",
         comma ? "write decimals with a point, not a comma" : "correct the line or export the mesh again");
  }
  if (!std::isfinite(value)) {
    fail(quotedWord(word) + " is not finite where " + what + " should stand",
         "remove the vertex or correct it in the program that wrote the file");
  }
  return value;
}

std::uint32_t TextScanner::toCount(std::string_view word, const char* what) const {
  const char* first = word.data() + (word.size() > 1 && word[0] == '+');
  const char* last = word.data() + word.size();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc::invalid_argument || end != last) {
    fail(quotedWord(word) + " is not a whole number where " + what + " should stand",
         "correct the line or export the mesh again");
  }
  if (error != std::errc() || value >= std::numeric_limits<std::uint32_t>::max()) {
    fail(std::string(what) + " of " + quotedWord(word) + " is beyond the limit of 4294967294",
         "split the mesh into parts");
  }
  return static_cast<std::uint32_t>(value);
}

void TextScanner::fail(const std::string& cause, const std::string& remedy) const {
  throw Error({.file = path_, .place = "line " + std::to_string(lineNumber_), .cause = cause, .remedy = remedy});
}

bool parseNumber(std::string_view word, double& value) {
  const char* first = word.data();
  const char* last = first + word.size();
  if (word.size() > 1 && *first == '+' && word[1] != '-') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc::invalid_argument || end != last) return false;
  if (error == std::errc::result_out_of_range) {
    // from_chars does not tell too large from too small: a negative exponent, or 0.000… without one, is too small.
    const std::size_t exponent = word.find_last_of("eE");
    const char sign = exponent == std::string_view::npos ? '-' : word[exponent + 1];
    const bool integerPart = exponent == std::string_view::npos && word.find_first_of("123456789") < word.find('.');
    value = sign == '-' && !integerPart ? 0.0 : std::numeric_limits<double>::infinity();
    if (*first == '-') value = -value;
  }
  return true;
}

std::string quotedWord(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "…\"" : "\"");
}

}  // namespace shbake
