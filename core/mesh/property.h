// Named columns of a file that shbake carries through without understanding them (PLY properties).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace shbake {

/// The scalar types of PLY.
enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one scalar: 1, 2, 4 or 8.
constexpr std::size_t scalarSize(ScalarType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr bool isFloatType(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

/// Calls `f` with a std::type_identity of the C++ type that stores `type`, and returns what it returns.
template <class F>
constexpr decltype(auto) withScalarType(ScalarType type, F&& f) {
  switch (type) {
    case ScalarType::int8:
      return f(std::type_identity<std::int8_t>{});
    case ScalarType::uint8:
      return f(std::type_identity<std::uint8_t>{});
    case ScalarType::int16:
      return f(std::type_identity<std::int16_t>{});
    case ScalarType::uint16:
      return f(std::type_identity<std::uint16_t>{});
    case ScalarType::int32:
      return f(std::type_identity<std::int32_t>{});
    case ScalarType::uint32:
      return f(std::type_identity<std::uint32_t>{});
    case ScalarType::float32:
      return f(std::type_identity<float>{});
    case ScalarType::float64:
      break;
  }
  return f(std::type_identity<double>{});
}

/// One column: a scalar or a list of scalars for each item of its element, in the machine's own byte order.
struct Property {
  std::string name;
  ScalarType type = ScalarType::float32;
  bool isList = false;
  ScalarType countType = ScalarType::uint8;  ///< lists only: the type of the length in the file
  std::vector<std::byte> values;             ///< the scalars, tightly packed
  std::vector<std::uint64_t> listStarts;     ///< lists only: items + 1 offsets into `values`, counted in scalars

  /// Equal names, types and bits.
  friend bool operator==(const Property&, const Property&) = default;
};

/// An element such as PLY's `edge`, with all its columns.
struct PropertyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  friend bool operator==(const PropertyElement&, const PropertyElement&) = default;
};

}  // namespace shbake
