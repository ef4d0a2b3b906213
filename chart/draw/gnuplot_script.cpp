// Panels as scripts for gnuplot: text quoted, ranges and ticks chosen here so that all panels read alike.
#include "chart/draw/gnuplot_script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace shbake::chart {
namespace {

/// Colours that people with any colour vision tell apart (M. Okabe, K. Ito, "Color Universal Design", 2008), without
/// the yellow, which is faint on white, and with marks of different shapes beside them.
constexpr std::array<const char*, 8> kColors{"#0072B2", "#D55E00", "#009E73", "#E69F00",
                                             "#56B4E9", "#CC79A7", "#555555", "#000000"};
constexpr std::array<int, 8> kMarks{7, 5, 9, 11, 13, 4, 8, 12};
constexpr int kWidth = 800, kHeight = 640;  // of a panel, in pixels
/// Space beyond the outermost places on logarithmic axes, as a factor.
constexpr double kMargin = 1.35;
/// Ranges of fewer decades have ticks named between these.
constexpr double kFineDecades = 2.6;

/// A string of gnuplot in single quotes, where nothing but the quote itself has a meaning.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return result + "'";
}

std::string number(double value) {
  std::array<char, 64> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Named ticks at 1, 2, 5, 10 ... within a range of few decades, at all digits within less than one, else at whole
/// decades; small ones without a name at all other digits.
std::string logarithmicTicks(const Range& range) {
  const double decades = std::log10(range.high / range.low);
  std::string ticks;
  for (int decade = static_cast<int>(std::floor(std::log10(range.low))); std::pow(10, decade) <= range.high; ++decade) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double tick = digit * std::pow(10, decade);
      if (tick < range.low || tick > range.high) continue;
      const bool isFine = digit == 2 || digit == 5;
      const bool isNamed = digit == 1 || (isFine && decades < kFineDecades) || decades < 1;
      std::array<char, 64> text;
      const int digits = std::max(0, -decade);
      const auto end =
          std::to_chars(text.data(), text.data() + text.size(), tick, std::chars_format::fixed, digits).ptr;
      const std::string name(text.data(), end);
      ticks += (ticks.empty() ? "" : ", ") + quoted(isNamed ? name : "") + " " + number(tick) + (isNamed ? " 0" : " 1");
    }
  }
  return ticks;
}

std::string axisScript(const std::string& name, const Axis& axis, Range range) {
  std::string script = "set " + name + "label " + quoted(axis.label) + "\n";
  if (!axis.logarithmic) {
    return script + "unset logscale " + name + "\nset " + name + "tics 1\nset " + name + "range [" +
           number(range.low - 0.5) + ":" + number(range.high + 0.5) + "]\n";
  }
  range = {range.low / kMargin, range.high * kMargin};
  return script + "set logscale " + name + "\nset " + name + "range [" + number(range.low) + ":" + number(range.high) +
         "]\nset " + name + "tics (" + logarithmicTicks(range) + ")\n";
}

std::string styleOf(const Series& s) {
  const auto i = static_cast<std::size_t>(s.color) % kColors.size();
  const std::string color = std::string(" lc rgb '") + kColors[i] + "'", mark = " pt " + std::to_string(kMarks[i]);
  switch (s.style) {
    case Series::Style::line:
      return "linespoints lw 1.6 ps 0.7" + mark + color;
    case Series::Style::strong:
      return "linespoints lw 3.2 ps 1" + mark + color;
    case Series::Style::dashed:
      return "linespoints lw 1.6 dt 2 ps 0.7" + mark + color;
    case Series::Style::rings:
      return "points pt 6 ps 1.9 lw 1.3 lc rgb '#000000'";
    default:
      return "points pt 3 ps 2.4 lw 2.6 lc rgb '#000000'";
  }
}

std::string panelScript(const Panel& panel) {
  Range x, y;
  std::string data, plots;
  int block = 0;
  for (const Series& s : panel.series) {
    if (s.places.empty()) continue;
    const std::string name = "$d" + std::to_string(block++);
    data += name + " << EOD\n";
    for (const Place& p : s.places) {
      data += number(p.x) + " " + number(p.y) + "\n";
      x.add(p.x);
      y.add(p.y);
    }
    data += "EOD\n";
    plots += (plots.empty() ? "" : ", ") + name + " using 1:2 with " + styleOf(s) + " title " + quoted(s.title);
  }
  return data + "set title " + quoted(panel.title) + "\n" + axisScript("x", panel.x, x) + axisScript("y", panel.y, y) +
         "plot " + plots + "\n";
}

}  // namespace

std::string gnuplotScript(std::span<const Panel> panels, const std::string& title, PictureFormat format) {
  const auto count = static_cast<int>(panels.size());
  const int columns = count > 1 ? 2 : 1, rows = (count + columns - 1) / columns;
  const std::string size = std::to_string(columns * kWidth) + "," + std::to_string(rows * kHeight);
  const std::string terminal =
      format == PictureFormat::svg
          ? "svg size " + size + " dynamic noenhanced background '#ffffff' font 'DejaVu Sans,15'"
          : "pngcairo size " + size + " noenhanced background '#ffffff' font 'DejaVu Sans,12'";
  std::string script = "set encoding utf8\nset terminal " + terminal + "\n";
  script +=
      "set grid lc rgb '#dddddd' lt 1 lw 0.8\nset border 3 lc rgb '#444444'\nset tics nomirror\n"
      "set key below center horizontal Left reverse maxcols 2 width -4 samplen 2 spacing 1.15 title ' '\n"
      "set lmargin 9\nset rmargin 3\n";
  if (count > 1)
    script += "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + " title " +
              quoted(title) + "\n";
  for (const Panel& panel : panels) script += panelScript(panel);
  return script + (count > 1 ? "unset multiplot\n" : "");
}

}  // namespace shbake::chart
