// Which property is which coefficient, and what contradicts itself.
#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/test_ply_files.h"
#include "transfer/sh_columns.h"

using namespace shbake;
using plytest::errorOf;

namespace {

std::vector<PlyProperty> named(const std::vector<std::string>& names) {
  std::vector<PlyProperty> properties;
  for (const std::string& name : names) properties.push_back({name, ScalarType::float32});
  return properties;
}

std::vector<std::string> coefficientNames(int channels, int count) {
  std::vector<std::string> names;
  for (int c = 0; c < channels; ++c) {
    for (int i = 0; i < count; ++i) names.push_back(shColumnName(channels, c, i));
  }
  return names;
}

StatedFacts stating(std::optional<int> order, std::optional<int> channels = {}) {
  StatedFacts stated;
  stated.order = order;
  stated.channels = channels;
  return stated;
}

}  // namespace

TEST_CASE("SH columns: names") {
  CHECK(shColumnName(1, 0, 0) == "sh_0");
  CHECK(shColumnName(1, 0, 120) == "sh_120");
  CHECK(shColumnName(3, 0, 4) == "sh_r_4");
  CHECK(shColumnName(3, 1, 4) == "sh_g_4");
  CHECK(shColumnName(3, 2, 15) == "sh_b_15");
  for (const char* own : {"quality", "sh_error", "source_vertex", "sh_0", "sh_17", "sh_b_3"})
    CHECK(isTransferColumn(own));
  for (const char* other :
       {"x", "Quality", "sh_", "sh_x", "sh_a_3", "sh_r_", "sh_01", "sh_1a", "sh_-1", "sh_errors", "sh_r"}) {
    INFO(other);
    CHECK_FALSE(isTransferColumn(other));
  }
}

TEST_CASE("SH columns: found in any order among others") {
  for (const int channels : {1, 3}) {
    for (const int order : {1, 2, 3, 5}) {
      std::vector<std::string> names = coefficientNames(channels, order * order);
      std::ranges::reverse(names);
      names.insert(names.begin(), "quality");
      names.insert(names.begin() + 2, "red");
      for (const StatedFacts& stated : {stating({}), stating(order), stating(order, channels)}) {
        const auto found = findShColumns(named(names), stated, "a.ply");
        REQUIRE(found);
        CHECK(found->order == order);
        CHECK(found->channels == channels);
        std::size_t next = static_cast<std::size_t>(channels * order * order);
        for (std::size_t i = 0; i < names.size(); ++i) {
          if (names[i] == "quality" || names[i] == "red") {
            CHECK_FALSE(found->place[i]);
          } else {
            CHECK(found->place[i] == --next);
          }
        }
        CHECK(next == 0);
      }
    }
  }
  CHECK_FALSE(findShColumns(named({"red", "quality", "sh_error"}), stating(3, 1), "a.ply"));
}

TEST_CASE("SH columns: contradictions are named") {
  const auto fault = [](std::vector<PlyProperty> properties, const StatedFacts& stated) {
    const auto error = errorOf([&] { findShColumns(properties, stated, "a.ply"); });
    REQUIRE(error);
    CHECK(error->file == "a.ply");
    CHECK_FALSE(error->remedy.empty());
    return error->place + ": " + error->cause;
  };
  std::vector<std::string> gap = coefficientNames(1, 9);
  gap.erase(gap.begin() + 5);
  CHECK_THAT(fault(named(gap), stating(3)), Catch::StartsWith("header: property sh_5 is missing: order=3 asks for 9"));
  CHECK_THAT(fault(named(gap), stating({})), Catch::StartsWith("header: property sh_5 is missing: order 3, the least"));
  CHECK_THAT(fault(named(coefficientNames(1, 16)), stating(3)),
             Catch::StartsWith("header field order: order=3 asks for 9") && Catch::EndsWith("there is property sh_9"));
  CHECK_THAT(fault(named(coefficientNames(1, 9)), stating(4)), Catch::Contains("sh_9 is missing: order=4"));
  CHECK_THAT(fault(named(coefficientNames(1, 10)), stating({})), Catch::Contains("sh_10 is missing: order 4"));
  CHECK_THAT(fault(named(coefficientNames(1, 9)), stating(3, 3)), Catch::StartsWith("header field channels: states 3"));
  CHECK_THAT(fault(named(coefficientNames(3, 9)), stating(3, 1)), Catch::StartsWith("header field channels: states 1"));
  CHECK_THAT(fault(named({"sh_0", "sh_r_0"}), stating({})), Catch::Contains("of one channel (sh_0 …) and of three"));
  CHECK_THAT(fault(named({"sh_r_0", "sh_g_0"}), stating({})), Catch::Contains("sh_b_0 is missing"));
  CHECK_THAT(fault(named({"sh_4000000000"}), stating({})), Catch::Contains("sh_0 is missing"));
  CHECK_THAT(fault({{"sh_0", ScalarType::int32}}, stating({})), Catch::StartsWith("property sh_0: is not a scalar"));
  CHECK_THAT(fault({{"sh_0", ScalarType::float32, true}}, stating({})),
             Catch::StartsWith("property sh_0: is not a scalar"));
}
