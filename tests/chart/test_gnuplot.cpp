// Scripts for gnuplot and what it makes of them; skipped with a word where it is not installed.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "chart/draw/gnuplot.h"
#include "chart/draw/gnuplot_script.h"

using namespace shbake;
using namespace shbake::chart;

namespace {

bool installed() {
  try {
    requireGnuplot();
    return true;
  } catch (const Error&) {
    WARN("gnuplot is not installed: drawing is not tested");
    return false;
  }
}

Panel panel() {
  Panel p;
  p.name = "test";
  p.title = "It's a 'quoted' title; with_markup{} and \"more\"\nbelow";
  p.x = {"seconds", true};
  p.y = {"error in %", true};
  p.series = {{"a `date` $x \\n", Series::Style::strong, 0, {{0.1, 10}, {1, 1}, {10, 0.1}}},
              {"b", Series::Style::star, 3, {{1, 2}}},
              {"nothing", Series::Style::line, 2, {}}};
  return p;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("text of any kind stays text in a script", "[gnuplot]") {
  const std::string script = gnuplotScript(std::vector{panel()}, "", PictureFormat::svg);
  CHECK(count(script, "set title 'It''s a ''quoted'' title; with_markup{} and \"more\" below'\n") == 1);
  CHECK(count(script, "'a `date` $x \\n'") == 1);
  CHECK(count(script, "multiplot") == 0);
  CHECK(count(script, "nothing") == 0);  // a series without places is left out
  CHECK(count(gnuplotScript(std::vector{panel(), panel(), panel()}, "t", PictureFormat::png), "\nplot ") == 3);
}

TEST_CASE("pictures are whole", "[gnuplot]") {
  if (!installed()) return;
  Progress progress;
  const std::string svg = runGnuplot(gnuplotScript(std::vector{panel()}, "", PictureFormat::svg), progress);
  CHECK(count(svg, "<svg") == 1);
  CHECK(svg.find("</svg>") != std::string::npos);
  CHECK(count(svg, "a `date` $x \\n") == 1);
  CHECK(svg.find("seconds") != std::string::npos);
  const std::string png = runGnuplot(gnuplotScript(std::vector{panel(), panel()}, "t", PictureFormat::png), progress);
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(png.substr(png.size() - 8, 4) == "IEND");
}

TEST_CASE("a missing gnuplot is told with what to install, a failing one with its complaint", "[gnuplot]") {
  CHECK_THROWS_WITH(requireGnuplot("shbake-no-such-program"),
                    Catch::Contains("gnuplot-nox") && Catch::Contains(".json"));
  if (!installed()) return;
  Progress progress;
  CHECK_THROWS_WITH(runGnuplot("set terminal svg\nplot nonsense\n", progress), Catch::Contains("nonsense"));
}

TEST_CASE("drawing is ended when it is cancelled", "[gnuplot]") {
  if (!installed()) return;
  Progress progress([](const ProgressState&) { return false; }, Progress::Duration(0));
  CHECK_THROWS_AS(runGnuplot("pause 100\n", progress), Error);  // or this test would take 100 seconds
}
