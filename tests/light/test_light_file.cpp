// Light files.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "light/light_file.h"
#include "light/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

void writeText(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string readText(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// What reading this text says; empty when it reads.
std::string messageFor(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder / "light.shlight";
  writeText(path, text);
  try {
    readLightFile(path);
  } catch (const Error& error) {
    REQUIRE(error.parts().file == path);
    return error.what();
  }
  return "";
}

/// A light file of order 1 with one field replaced, or one more.
std::string fileWith(const std::string& name, const std::string& value) {
  std::vector<std::pair<std::string, std::string>> fields{
      {"shbake_light", "1"},        {"order", "1"},       {"basis", "\"real-orthonormal\""},
      {"condon_shortley", "false"}, {"axes", "\"z-up\""}, {"radiance", "[[1, 2, 3]]"},
      {"sources", "[\"a test\"]"}};
  bool known = false;
  for (auto& [n, v] : fields) {
    if (n == name) {
      v = value;
      known = true;
    }
  }
  if (!known) fields.emplace_back(name, value);
  std::string text;
  for (const auto& [n, v] : fields) {
    if (!v.empty()) text += (text.empty() ? "{" : ", ") + ("\"" + n + "\": " + v);
  }
  return text + "}";
}

}  // namespace

TEST_CASE("a light file reads back to the same bits") {
  const TemporaryFolder folder;
  const std::string path = folder / "light.shlight";
  for (const int order : {1, 3, 8}) {
    LightFile file{randomLight(order, order), order == 3 ? UpAxis::y : UpAxis::z, {"probe \"x\".hdr", "Himmel über"}};
    file.light.coefficients[0] = {1e300, -5e-324, -0.0};
    writeLightFile(path, file);
    const LightFile back = readLightFile(path);
    REQUIRE(sameBits(back.light, file.light));
    REQUIRE(back.up == file.up);
    REQUIRE(back.sources == file.sources);
  }
}

TEST_CASE("a light file has the documented text") {
  const TemporaryFolder folder;
  const std::string path = folder / "light.shlight";
  Light light(1);
  light.coefficients[0] = {0.1, 2, -3.5};
  writeLightFile(path, {light, UpAxis::z, {"by hand"}});
  REQUIRE(
      readText(path) ==
      "{\n  \"shbake_light\": 1,\n  \"order\": 1,\n  \"basis\": \"real-orthonormal\",\n  \"condon_shortley\": false,\n"
      "  \"axes\": \"z-up\",\n  \"radiance\": [\n    [0.1,2.0,-3.5]\n  ],\n  \"sources\": [\"by hand\"]\n}\n");
}

TEST_CASE("each wrong field is named") {
  using Catch::Contains;
  REQUIRE(messageFor(fileWith("order", "1")).empty());
  REQUIRE(messageFor(fileWith("sources", "")).empty());
  REQUIRE_THAT(messageFor(fileWith("gain", "2")), Contains("field \"gain\"") && Contains("not a field"));
  REQUIRE_THAT(messageFor(fileWith("shbake_light", "2")), Contains("field \"shbake_light\""));
  REQUIRE_THAT(messageFor(fileWith("shbake_light", "")), Contains("not a light file"));
  REQUIRE_THAT(messageFor(fileWith("basis", "\"hazel\"")), Contains("field \"basis\""));
  REQUIRE_THAT(messageFor(fileWith("condon_shortley", "true")), Contains("field \"condon_shortley\""));
  REQUIRE_THAT(messageFor(fileWith("condon_shortley", "0")), Contains("field \"condon_shortley\""));
  REQUIRE_THAT(messageFor(fileWith("axes", "\"up\"")), Contains("field \"axes\""));
  REQUIRE_THAT(messageFor(fileWith("axes", "")), Contains("field \"axes\"") && Contains("missing"));
  for (const char* order : {"0", "129", "1.5", "\"3\"", "4000000000", "-1", "1e99"}) {
    REQUIRE_THAT(messageFor(fileWith("order", order)), Contains("field \"order\""));
  }
  REQUIRE_THAT(messageFor(fileWith("order", "2")), Contains("field \"radiance\"") && Contains("1 rows"));
  for (const char* rows :
       {"[[1, 2]]", "[[1, 2, null]]", "[1]", "{}", "[]", "[[1, 2, 3], [1, 2, 3]]", "[[1, 2, \"3\"]]"}) {
    REQUIRE_THAT(messageFor(fileWith("radiance", rows)), Contains("field \"radiance\""));
  }
  REQUIRE_THAT(messageFor(fileWith("sources", "\"a\"")), Contains("field \"sources\""));
  REQUIRE_THAT(messageFor(fileWith("sources", "[1]")), Contains("field \"sources\""));
}

TEST_CASE("what is no JSON or no light file is refused in one line") {
  using Catch::Contains;
  REQUIRE_THAT(messageFor(""), Contains("empty"));
  REQUIRE_THAT(messageFor("ply\n"), Contains("not JSON"));
  REQUIRE_THAT(messageFor("[1, 2]"), Contains("not a light file"));
  REQUIRE_THAT(messageFor("{\"order\": 1, \"order\": 2}"), Contains("field \"order\"") && Contains("twice"));
  REQUIRE_THAT(messageFor(fileWith("radiance", "[[1e999, 0, 0]]")), Contains("too large"));
  REQUIRE_THROWS_AS(readLightFile("/nowhere/light.shlight"), Error);
  const std::string whole = fileWith("order", "1");
  for (std::size_t length = 1; length < whole.size(); ++length) {
    REQUIRE_FALSE(messageFor(whole.substr(0, length)).empty());
  }
}

TEST_CASE("a light that cannot be written leaves nothing") {
  const TemporaryFolder folder;
  LightFile file;
  file.light.coefficients[0] = {NAN, 0, 0};
  REQUIRE_THROWS_AS(writeLightFile(folder / "light.shlight", file), Error);
  REQUIRE_FALSE(std::filesystem::exists(folder / "light.shlight"));
}

TEST_CASE("a rig reads back to the same bits") {
  const TemporaryFolder folder;
  const std::string path = folder / "rig.shlight";
  for (const RigMethod method : {RigMethod::inverseDistance, RigMethod::barycentric}) {
    RigFile file;
    for (int i = 0; i < 3; ++i) file.samples.push_back({randomDirection(5, i), randomLight(3, 50 + i)});
    file.options = {method, method == RigMethod::inverseDistance ? 2.5 : 10};
    file.up = UpAxis::y;
    file.sources = {"three places"};
    writeRigFile(path, file);
    REQUIRE(isRigFile(path));
    const RigFile back = readRigFile(path);
    REQUIRE(back.samples.size() == 3);
    for (int i = 0; i < 3; ++i) {
      REQUIRE(back.samples[i].position == file.samples[i].position);
      REQUIRE(sameBits(back.samples[i].light, file.samples[i].light));
    }
    CHECK((back.options.method == method && back.options.power == file.options.power));
    CHECK((back.up == UpAxis::y && back.sources == file.sources));
    CHECK_THROWS_WITH(readLightFile(path), Catch::Contains("field \"samples\""));
  }
  RigFile bad;
  CHECK_THROWS_AS(writeRigFile(path, bad), Error);
  bad.samples = {{{0, 0, 0}, Light(2)}, {{1, 0, 0}, Light(3)}};
  CHECK_THROWS_AS(writeRigFile(path, bad), Error);
  writeLightFile(path, {});
  CHECK_FALSE(isRigFile(path));
  CHECK_THROWS_WITH(readRigFile(path), Catch::Contains("field \"samples\"") && Catch::Contains("missing"));
}

TEST_CASE("a rig has the documented text, and each wrong field is named") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const std::string path = folder / "rig.shlight";
  Light light(1);
  light.coefficients[0] = {1, 2, 3};
  writeRigFile(path, {{{{0.5, 0, -1}, light}, {{2, 0, 0}, light}}, {}, UpAxis::z, {}});
  const std::string good = readText(path);
  REQUIRE(good ==
          "{\n  \"shbake_light\": 1,\n  \"order\": 1,\n  \"basis\": \"real-orthonormal\",\n  \"condon_shortley\": "
          "false,\n  \"axes\": \"z-up\",\n  \"blend\": \"inverse-distance\",\n  \"power\": 10.0,\n  \"samples\": [\n"
          "    {\"position\": [0.5,0.0,-1.0],\n     \"radiance\": [\n      [1.0,2.0,3.0]\n    ]},\n"
          "    {\"position\": [2.0,0.0,0.0],\n     \"radiance\": [\n      [1.0,2.0,3.0]\n    ]}\n  ],\n"
          "  \"sources\": []\n}\n");
  const auto messageWith = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    writeText(path, text);
    try {
      readRigFile(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(messageWith("10.0", "4").empty());
  CHECK_THAT(messageWith("\"inverse-distance\"", "\"nearest\""), Contains("field \"blend\""));
  CHECK_THAT(messageWith("\"inverse-distance\"", "\"barycentric\""), Contains("field \"power\""));
  CHECK_THAT(messageWith("10.0", "0"), Contains("field \"power\""));
  CHECK_THAT(messageWith("\"power\": 10.0,", ""), Contains("field \"power\"") && Contains("missing"));
  CHECK_THAT(messageWith("\"power\": 10.0", "\"power\": 10.0, \"gain\": 1"), Contains("field \"gain\""));
  CHECK_THAT(messageWith("\"power\": 10.0", "\"power\": 10.0, \"radiance\": [[1,2,3]]"), Contains("\"radiance\""));
  CHECK_THAT(messageWith("[0.5,0.0,-1.0]", "[0.5,0.0]"), Contains("field \"samples[0].position\""));
  CHECK_THAT(messageWith("[2.0,0.0,0.0]", "[2.0,0.0,1e999]"), Contains("too large"));
  CHECK_THAT(messageWith("\"order\": 1", "\"order\": 2"), Contains("field \"samples[0].radiance\""));
  CHECK_THAT(messageWith("{\"position\": [2.0,0.0,0.0],", "{"), Contains("field \"samples[1].position\""));
  CHECK_THAT(messageWith("{\"position\": [2.0", "{\"weight\": 1, \"position\": [2.0"), Contains("samples[1].weight"));
  CHECK_THAT(messageWith("{\"position\": [0.5", "3, {\"position\": [0.5"), Contains("field \"samples[0]\""));
}
