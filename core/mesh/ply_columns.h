// Columns of properties by name: what readers and writers of meshes share.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "mesh/mesh.h"
#include "mesh/property.h"

namespace shbake {

/// The column of that name, or null.
const Property* findColumn(const std::vector<Property>& columns, std::string_view name);

/// Removes the column of that name and returns it; nothing when there is none.
std::optional<Property> takeColumn(std::vector<Property>& columns, std::string_view name);

/// Scalar `i` of a column's values as a double, which holds every type of PLY exactly.
inline double scalarAt(const Property& column, std::size_t i) {
  return withScalarType(column.type, [&]<class T>(std::type_identity<T>) {
    T value;
    std::memcpy(&value, column.values.data() + i * sizeof(T), sizeof(T));
    return static_cast<double>(value);
  });
}

/// Removes three scalar columns of a floating type and joins them; nothing, and nothing removed, unless all are there.
std::optional<std::vector<Vec3f>> takeFloatVectors(std::vector<Property>& columns,
                                                   const std::array<const char*, 3>& names);

/// Reads red, green and blue, which stay in the columns: uchar as display values, floats as linear light. Other types
/// and incomplete colours leave both results as they are.
void readColors(const std::vector<Property>& columns, std::vector<Rgb>& colors, ColorEncoding& encoding);

/// True where readColors() finds colours.
bool hasColors(const std::vector<Property>& columns);

/// Replaces every column by one that holds, for each i, the item number items[i] of the old one.
void repeatItems(std::vector<Property>& columns, std::span<const std::uint32_t> items);

}  // namespace shbake
