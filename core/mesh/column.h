// Properties made from plain arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesh/property.h"

namespace shbake {

/// The PLY type that stores a T.
template <class T>
constexpr ScalarType scalarTypeOf() {
  if constexpr (std::is_same_v<T, std::int8_t>) return ScalarType::int8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return ScalarType::uint8;
  if constexpr (std::is_same_v<T, std::int16_t>) return ScalarType::int16;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ScalarType::uint16;
  if constexpr (std::is_same_v<T, std::int32_t>) return ScalarType::int32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return ScalarType::uint32;
  if constexpr (std::is_same_v<T, float>) return ScalarType::float32;
  return ScalarType::float64;
}

/// A property with one scalar for each item of its element.
template <class T>
Property scalarColumn(std::string name, const std::vector<T>& values) {
  Property column;
  column.name = std::move(name);
  column.type = scalarTypeOf<T>();
  const auto bytes = std::as_bytes(std::span(values));
  column.values.assign(bytes.begin(), bytes.end());
  return column;
}

/// A property with a list of `each` scalars for each item of its element.
template <class T>
Property listColumn(std::string name, const std::vector<T>& values, std::size_t each) {
  Property column = scalarColumn(std::move(name), values);
  column.isList = true;
  column.listStarts.resize(values.size() / each + 1);
  for (std::size_t i = 0; i < column.listStarts.size(); ++i) column.listStarts[i] = i * each;
  return column;
}

}  // namespace shbake
