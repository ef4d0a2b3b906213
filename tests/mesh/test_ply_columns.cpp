// Columns by name: taken, joined, repeated.
#include <catch2/catch.hpp>

#include "mesh/ply_columns.h"
#include "test_ply_files.h"

using namespace shbake;

namespace {

template <class T>
Property column(std::string name, ScalarType type, const std::vector<T>& values) {
  Property p{std::move(name), type, false, ScalarType::uint8, {}, {}};
  p.values.resize(values.size() * sizeof(T));
  std::memcpy(p.values.data(), values.data(), p.values.size());
  return p;
}

}  // namespace

TEST_CASE("PLY columns: found and taken by name") {
  std::vector<Property> columns = {column<float>("a", ScalarType::float32, {1}),
                                   column<float>("b", ScalarType::float32, {2})};
  CHECK(findColumn(columns, "b") == &columns[1]);
  CHECK_FALSE(findColumn(columns, "c"));
  CHECK_FALSE(takeColumn(columns, "c"));
  const auto taken = takeColumn(columns, "a");
  REQUIRE(taken);
  CHECK(scalarAt(*taken, 0) == 1);
  REQUIRE(columns.size() == 1);
  CHECK(columns[0].name == "b");
}

TEST_CASE("PLY columns: three columns become vectors, or stay where one does not fit") {
  std::vector<Property> columns = {column<double>("z", ScalarType::float64, {3, 6}),
                                   column<float>("x", ScalarType::float32, {1, 4}),
                                   column<float>("y", ScalarType::float32, {2, 5})};
  CHECK_FALSE(takeFloatVectors(columns, {"x", "y", "w"}));
  CHECK(columns.size() == 3);
  std::vector<Property> bytes = columns;
  bytes[1] = column<std::uint8_t>("x", ScalarType::uint8, {1, 4});
  CHECK_FALSE(takeFloatVectors(bytes, {"x", "y", "z"}));
  CHECK(takeFloatVectors(columns, {"x", "y", "z"}) == std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}});
  CHECK(columns.empty());
}

TEST_CASE("PLY columns: items repeated and left out, scalars and lists") {
  Property list = column<std::int16_t>("l", ScalarType::int16, {1, 2, 3, 4});
  list.isList = true;
  list.listStarts = {0, 1, 1, 4};
  std::vector<Property> columns = {column<float>("s", ScalarType::float32, {10, 20, 30}), list};
  const std::vector<std::uint32_t> items = {2, 2, 0, 1};
  repeatItems(columns, items);
  const double scalars[] = {30, 30, 10, 20}, entries[] = {2, 3, 4, 2, 3, 4, 1};
  for (std::size_t i = 0; i < 4; ++i) CHECK(scalarAt(columns[0], i) == scalars[i]);
  CHECK(columns[1].listStarts == std::vector<std::uint64_t>{0, 3, 6, 7, 7});
  REQUIRE(columns[1].values.size() == 14);
  for (std::size_t i = 0; i < 7; ++i) CHECK(scalarAt(columns[1], i) == entries[i]);
}

TEST_CASE("PLY columns: colours are there only when all three fit one encoding") {
  const auto make = [](ScalarType r, ScalarType g, ScalarType b) {
    std::vector<Property> columns;
    for (const auto& [name, type] : {std::pair("red", r), {"green", g}, {"blue", b}}) {
      columns.push_back({name, type, false, ScalarType::uint8, std::vector<std::byte>(scalarSize(type)), {}});
    }
    return columns;
  };
  using enum ScalarType;
  CHECK(hasColors(make(uint8, uint8, uint8)));
  CHECK(hasColors(make(float32, float64, float32)));
  CHECK_FALSE(hasColors(make(uint8, float32, uint8)));
  CHECK_FALSE(hasColors(make(int8, int8, int8)));
  CHECK_FALSE(hasColors({}));
}
