// Reports: aligned lines and JSON that a parser takes.
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/report.h"

using namespace shbake::cli;

TEST_CASE("lines are aligned behind the longest label") {
  Report report;
  CHECK(report.text().empty());
  report.line("points", "12");
  report.line("", "continued");
  report.line("reflections", "all");
  CHECK(report.text() ==
        "points       12\n"
        "             continued\n"
        "reflections  all\n");
}

TEST_CASE("JSON nests by the dots of keys and keeps every type") {
  Report report;
  report.data("verb", "bake");  // a literal is text, not a boolean
  report.fact("mesh.triangles", std::int64_t(12), "triangles", "12");
  report.data("mesh.closed", true);
  report.data("error.rms", 0.25);
  report.data("energy", std::vector<double>{1, 2.5});
  report.data("warnings", std::vector<std::string>{"one"});
  const auto json = nlohmann::json::parse(report.json());
  CHECK(json["verb"] == "bake");
  CHECK(json["mesh"]["triangles"] == 12);
  CHECK(json["mesh"]["closed"] == true);
  CHECK(json["error"]["rms"] == 0.25);
  CHECK(json["energy"] == nlohmann::json({1.0, 2.5}));
  CHECK(json["warnings"][0] == "one");
  CHECK(report.text() == "triangles  12\n");
}

TEST_CASE("what JSON cannot hold is replaced, not refused") {
  Report report;
  report.data("file", std::string("caf\xE9.ply"));  // Latin-1, no UTF-8
  report.data("nan", std::numeric_limits<double>::quiet_NaN());
  const auto json = nlohmann::json::parse(report.json());
  CHECK(json["file"] == "caf\xEF\xBF\xBD.ply");
  CHECK(json["nan"].is_null());
}
