// Numbers as people read them, independent of the locale.
#include "cli/format.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace shbake::cli {
namespace {

std::string printed(const char* format, double value) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Three significant digits of a magnitude below 1000, without an exponent.
std::string threeDigits(double value) {
  const double size = std::abs(value);
  return printed(size >= 99.95 ? "%.0f" : size >= 9.995 ? "%.1f" : size >= 0.9995 ? "%.2f" : "%.3g", value);
}

struct Scaled {
  double value;
  const char* prefix;
};

/// Divides by 1000 until what is left, rounded to three digits, is below 1000.
Scaled scaled(double value) {
  constexpr std::array<const char*, 5> kPrefixes{"", "k", "M", "G", "T"};
  std::size_t i = 0;
  while (std::abs(value) >= 999.5 && i + 1 < kPrefixes.size()) {
    value /= 1000;
    ++i;
  }
  return {value, kPrefixes[i]};
}

}  // namespace

std::string formatCount(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

std::string formatShort(double value) {
  const Scaled s = scaled(value);
  return threeDigits(s.value) + (*s.prefix ? std::string(" ") + s.prefix : "");
}

std::string formatBytes(double bytes) {
  const Scaled s = scaled(bytes);
  return (*s.prefix ? threeDigits(s.value) : printed("%.0f", s.value)) + " " + s.prefix + "B";
}

std::string formatDuration(double seconds) {
  if (seconds < 59.95) return printed(seconds < 9.995 ? "%.2f s" : "%.1f s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  std::array<char, 64> text;
  if (whole < 3600) {
    std::snprintf(text.data(), text.size(), "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text.data();
}

std::string formatPercent(double ratio) {
  return threeDigits(100 * ratio) + " %";
}

std::string formatNumber(double value) {
  std::array<char, 64> text;
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e15);
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  return {text.data(), end};
}

std::string formatNumber(double value, int digits) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  return {text.data(), end};
}

}  // namespace shbake::cli
