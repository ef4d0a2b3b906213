// A chart as one page for browsers.
#include "chart/draw/page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "chart/draw/panels.h"
#include "chart/draw/surface_text.h"
#include "chart/draw/text.h"

namespace shbake::chart {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>@title@</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 0 auto; padding: 0 1rem 3rem; color: #222; background: #fff; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.5rem; }
figure { margin: 2rem 0; } figure svg { width: 100%; height: auto; display: block; }
figcaption { font-size: .9rem; color: #555; }
.table { overflow-x: auto; } table { border-collapse: collapse; font-size: .85rem; }
th, td { padding: .25rem .6rem; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
th { white-space: normal; vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; }
.words { text-align: left; white-space: normal; min-width: 14rem; }
.advice { background: #f3f6f8; border-left: 4px solid #0072B2; padding: .5rem 1rem .5rem 2rem; }
</style>
</head>
<body>
<h1>@title@</h1>
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

void replaceAll(std::string& text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

/// Whether a column behind the first has words in all its cells; such columns are not aligned like numbers.
bool holdsWords(const Table& table, std::size_t column) {
  const auto isWord = [&](const std::vector<std::string>& row) {
    return column < row.size() && !row[column].empty() && std::isalpha(static_cast<unsigned char>(row[column][0])) != 0;
  };
  return column > 0 && std::all_of(table.rows.begin(), table.rows.end(), isWord);
}

std::string tableHtml(const Table& table) {
  std::string html = "<h2>" + escaped(table.title) + "</h2>\n<div class=\"table\"><table>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string cell = r == 0 ? "th" : "td";
    html += "<tr>";
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
      const std::string style = holdsWords(table, c) ? " class=\"words\"" : "";
      html += "<" + cell + style + ">" + escaped(table.rows[r][c]) + "</" + cell + ">";
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace

std::string inlineSvg(const std::string& file, const std::string& prefix) {
  const std::size_t begin = file.find("<svg"), end = file.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::string svg = file.substr(begin, end + 6 - begin);
  // Where ids are defined, and where they are referred to.
  for (const std::string_view place : {"id=\"", "id='", "href=\"#", "href='#", "url(#"}) {
    replaceAll(svg, place, std::string(place) + prefix);
  }
  return svg;
}

std::string chartPage(const ChartData& data, const DrawPanel& draw) {
  std::string page(kHead);
  replaceAll(page, "@title@", escaped("Speed and accuracy of " + data.mesh));
  page += "<ul class=\"advice\">\n";
  for (const std::string& sentence : adviceSentences(data)) page += "<li>" + escaped(sentence) + "</li>\n";
  for (const std::string& sentence : surfaceSentences(data)) page += "<li>" + escaped(sentence) + "</li>\n";
  page += "</ul>\n";
  for (const Panel& panel : panelsOf(data)) {
    std::string svg = inlineSvg(draw(panel), panel.name + "-");
    replaceAll(svg, "<title>Gnuplot</title>", "<title>" + escaped(panel.title) + "</title>");
    page += "<figure id=\"" + escaped(panel.name) + "\">\n" + svg + "\n<figcaption>" + escaped(panel.caption) +
            "</figcaption>\n</figure>\n";
  }
  page += "<h2>How it was measured</h2>\n<ul>\n";
  for (const std::string& sentence : measurementSentences(data)) page += "<li>" + escaped(sentence) + "</li>\n";
  page += "</ul>\n";
  for (const Table& table : tablesOf(data)) page += tableHtml(table);
  return page + "</body>\n</html>\n";
}

}  // namespace shbake::chart
