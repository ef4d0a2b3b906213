// Headers of PLY files: Greg Turk, "The PLY Polygon File Format", 1994.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/property.h"

namespace shbake {

class PlyInput;

/// How the rows behind the header are stored.
enum class PlyEncoding { ascii, binaryLittleEndian, binaryBigEndian };

/// A declared property.
struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float32;
  bool isList = false;
  ScalarType countType = ScalarType::uint8;  ///< lists only
};

/// A declared element: `count` rows of `properties`.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The property of that name, or null.
  const PlyProperty* find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::binaryLittleEndian;
  std::vector<PlyElement> elements;   ///< in the order of the file
  std::vector<std::string> comments;  ///< without the word "comment"; "obj_info …" lines keep their first word
  char lineEnd = '\n';                ///< '\r' in files of old Macintoshes; "\r\n" counts as '\n'

  /// The element of that name, or null.
  const PlyElement* find(std::string_view element) const;
};

/// The word for a format line: "ascii", "binary_little_endian" or "binary_big_endian".
const char* encodingName(PlyEncoding encoding);
/// The type as headers name it: "char", "uchar", "short", "ushort", "int", "uint", "float", "double".
const char* scalarName(ScalarType type);

/// Reads the header of a PLY file. Types are understood under both styles of names (float and float32).
/// Throws an Error that names the header's line for anything that is not PLY 1.0: an empty file, unknown words,
/// elements or properties named twice, a list whose length is not an integer, a missing end_header.
PlyHeader readPlyHeader(const std::string& path);
/// The same on an open file, leaving it at the first byte of the body.
PlyHeader readPlyHeader(PlyInput& input);

/// The header as a file begins with it, "ply\n" to "end_header\n". Line ends within comments begin a further comment.
/// Throws a usage error for names that are empty, have blanks in them or stand twice.
std::string plyHeaderText(const PlyHeader& header);

}  // namespace shbake
