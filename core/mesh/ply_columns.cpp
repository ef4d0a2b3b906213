#include "mesh/ply_columns.h"

#include <algorithm>
#include <utility>

namespace shbake {
namespace {

constexpr std::array kColorNames = {"red", "green", "blue"};

bool isByteType(ScalarType type) {
  return type == ScalarType::uint8;
}

/// The three columns of that name, when all are scalars of a type that `accepts` them.
template <class Accepts>
std::optional<std::array<const Property*, 3>> findThree(const std::vector<Property>& columns,
                                                        const std::array<const char*, 3>& names, Accepts accepts) {
  std::array<const Property*, 3> found{};
  for (std::size_t i = 0; i < 3; ++i) {
    found[i] = findColumn(columns, names[i]);
    if (!found[i] || found[i]->isList || !accepts(found[i]->type)) return {};
  }
  return found;
}

std::vector<Vec3f> joined(const std::array<const Property*, 3>& columns, float divisor) {
  std::vector<Vec3f> vectors(columns[0]->values.size() / scalarSize(columns[0]->type));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = {static_cast<float>(scalarAt(*columns[0], i)) / divisor,
                  static_cast<float>(scalarAt(*columns[1], i)) / divisor,
                  static_cast<float>(scalarAt(*columns[2], i)) / divisor};
  }
  return vectors;
}

Property repeated(const Property& old, std::span<const std::uint32_t> items) {
  Property result{old.name, old.type, old.isList, old.countType, {}, {}};
  if (old.isList) result.listStarts = {0};
  const std::size_t size = scalarSize(old.type);
  for (const std::uint32_t item : items) {
    const std::size_t begin = old.isList ? old.listStarts[item] : item;
    const std::size_t end = old.isList ? old.listStarts[item + 1] : item + 1;
    result.values.insert(result.values.end(), old.values.begin() + static_cast<std::ptrdiff_t>(begin * size),
                         old.values.begin() + static_cast<std::ptrdiff_t>(end * size));
    if (old.isList) result.listStarts.push_back(result.listStarts.back() + (end - begin));
  }
  return result;
}

}  // namespace

const Property* findColumn(const std::vector<Property>& columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &Property::name);
  return found == columns.end() ? nullptr : &*found;
}

std::optional<Property> takeColumn(std::vector<Property>& columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &Property::name);
  if (found == columns.end()) return {};
  Property column = std::move(*found);
  columns.erase(found);
  return column;
}

std::optional<std::vector<Vec3f>> takeFloatVectors(std::vector<Property>& columns,
                                                   const std::array<const char*, 3>& names) {
  const auto found = findThree(columns, names, isFloatType);
  if (!found) return {};
  std::vector<Vec3f> vectors = joined(*found, 1);
  for (const char* name : names) takeColumn(columns, name);
  return vectors;
}

void readColors(const std::vector<Property>& columns, std::vector<Rgb>& colors, ColorEncoding& encoding) {
  if (const auto bytes = findThree(columns, kColorNames, isByteType)) {
    colors = joined(*bytes, 255);
    encoding = ColorEncoding::srgb;
  } else if (const auto floats = findThree(columns, kColorNames, isFloatType)) {
    colors = joined(*floats, 1);
    encoding = ColorEncoding::linear;
  }
}

bool hasColors(const std::vector<Property>& columns) {
  return findThree(columns, kColorNames, isByteType) || findThree(columns, kColorNames, isFloatType);
}

void repeatItems(std::vector<Property>& columns, std::span<const std::uint32_t> items) {
  for (Property& column : columns) column = repeated(column, items);
}

}  // namespace shbake
