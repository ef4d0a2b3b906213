// Headers of PLY files: all that the format allows is understood, all else is refused with the line that is at fault.
#include <catch2/catch.hpp>

#include "mesh/ply_header.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

PlyHeader parse(const std::string& text) {
  const plytest::Folder folder;
  return readPlyHeader(folder.write("a.ply", text));
}

}  // namespace

TEST_CASE("PLY header: types go by two styles of names") {
  const char* const styles[2][8] = {{"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
                                    {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}};
  for (const auto& names : styles) {
    std::string text = "ply\nformat ascii 1.0\nelement thing 12\n";
    for (int t = 0; t < 8; ++t) text += std::string("property ") + names[t] + " p" + std::to_string(t) + "\n";
    for (int t = 0; t < 6; ++t)
      text += std::string("property list ") + names[t] + " double l" + std::to_string(t) + "\n";
    const PlyHeader header = parse(text + "end_header\n");
    REQUIRE(header.elements.size() == 1);
    const PlyElement& e = header.elements[0];
    CHECK(e.name == "thing");
    CHECK(e.count == 12);
    REQUIRE(e.properties.size() == 14);
    for (std::size_t t = 0; t < 8; ++t) {
      CHECK(e.properties[t].type == static_cast<ScalarType>(t));
      CHECK_FALSE(e.properties[t].isList);
    }
    for (std::size_t t = 0; t < 6; ++t) {
      CHECK(e.properties[8 + t].isList);
      CHECK(e.properties[8 + t].countType == static_cast<ScalarType>(t));
      CHECK(e.properties[8 + t].type == ScalarType::float64);
    }
  }
}

TEST_CASE("PLY header: encodings, comments and blank lines") {
  CHECK(parse("ply\nformat binary_big_endian 1.0\nend_header\n").encoding == PlyEncoding::binaryBigEndian);
  CHECK(parse("ply\nformat binary_little_endian 1.0\nend_header\n").encoding == PlyEncoding::binaryLittleEndian);
  const PlyHeader header = parse(
      "ply\ncomment first\nformat ascii 1.0\n\ncomment\ncomment  kept  as it is \nobj_info angle 3\n"
      "element vertex 1\ncomment comment\n  property   float\tx \nend_header\n");
  CHECK(header.comments == std::vector<std::string>{"first", "", " kept  as it is ", "obj_info angle 3", "comment"});
  CHECK(header.find("vertex")->find("x"));
  CHECK_FALSE(header.find("vertex")->find("y"));
  CHECK_FALSE(header.find("face"));
}

TEST_CASE("PLY header: the first line tells how lines end") {
  const std::string text = "ply\nformat ascii 1.0\ncomment a b\nelement vertex 3\nproperty float x\nend_header\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string turned;
    for (const char c : text) turned += c == '\n' ? end : std::string(1, c);
    const PlyHeader header = parse(turned);
    CHECK(header.comments == std::vector<std::string>{"a b"});
    CHECK(header.find("vertex")->count == 3);
    CHECK(header.lineEnd == (end == "\r" ? '\r' : '\n'));
  }
}

TEST_CASE("PLY header: every fault is named with its line") {
  struct Fault {
    std::string text, place, cause;
  };
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::vector<Fault> faults = {
      {"", "", "is empty"},
      {"OFF\n3 1 0\n", "", "is not a PLY file"},
      {"plyx\nformat ascii 1.0\nend_header\n", "", "is not a PLY file"},
      {" ply\nformat ascii 1.0\nend_header\n", "", "is not a PLY file"},
      {"ply", "header line 1", "ends before end_header"},
      {start + "element vertex 3\n", "header line 3", "ends before end_header"},
      {"ply\nend_header\n", "header line 2", "no format line"},
      {"ply\nformat ascii 2.0\nend_header\n", "header line 2", "format is not known"},
      {"ply\nformat binary 1.0\nend_header\n", "header line 2", "format is not known"},
      {"ply\nformat ascii\nend_header\n", "header line 2", "format is not known"},
      {start + "format ascii 1.0\nend_header\n", "header line 3", "second format line"},
      {start + "elements vertex 3\nend_header\n", "header line 3", "'elements' is not known"},
      {start + "element vertex\nend_header\n", "header line 3", "declared wrongly"},
      {start + "element vertex -1\nend_header\n", "header line 3", "declared wrongly"},
      {start + "element vertex 3.5\nend_header\n", "header line 3", "declared wrongly"},
      {start + "element vertex 99999999999999999999\nend_header\n", "header line 3", "declared wrongly"},
      {start + "element vertex 3 4\nend_header\n", "header line 3", "declared wrongly"},
      {start + "property float x\nend_header\n", "header line 3", "before the first element"},
      {start + "element vertex 3\nproperty float\nend_header\n", "header line 4", "declared wrongly"},
      {start + "element vertex 3\nproperty float x y\nend_header\n", "header line 4", "declared wrongly"},
      {start + "element vertex 3\nproperty half x\nend_header\n", "header line 4", "type 'half' is not known"},
      {start + "element face 3\nproperty list uchar v\nend_header\n", "header line 4", "declared wrongly"},
      {start + "element face 3\nproperty list float int v\nend_header\n", "header line 4", "not of an integer type"},
      {start + "element a 3\nproperty float x\nproperty int x\nend_header\n", "header line 5",
       "property 'x' of element 'a' is declared twice"},
      {start + "element a 3\nelement b 3\nelement a 3\nend_header\n", "header line 5", "element 'a' is declared twice"},
      {start + "comment " + std::string(1 << 20, 'a') + "\nend_header\n", "line 3", "is longer than"},
      {start + std::string("\x01\x02\x7f", 3) + "\nend_header\n", "header line 3", "'\?\?\?' is not known"},
  };
  for (const Fault& fault : faults) {
    INFO(fault.text.substr(0, 200));
    const auto error = errorOf([&] { parse(fault.text); });
    REQUIRE(error);
    CHECK(error->kind == ErrorKind::work);
    CHECK(error->file.ends_with("a.ply"));
    CHECK(error->place == fault.place);
    CHECK_THAT(error->cause, Catch::Contains(fault.cause));
    CHECK_FALSE(error->remedy.empty());
  }
}

TEST_CASE("PLY header: files that cannot be opened") {
  const plytest::Folder folder;
  CHECK_THAT(errorOf([&] { readPlyHeader(folder.path("none.ply")); })->cause, Catch::Contains("cannot be opened"));
  CHECK_THAT(errorOf([&] { readPlyHeader(folder.path("")); })->cause, Catch::Contains("is a folder"));
}

TEST_CASE("PLY header: the text written is the text meant") {
  PlyHeader header;
  header.comments = {"a", "", "obj_info b c", "two\nlines", "obj_info x\ny"};
  header.elements = {{"vertex", 4000000000u, {{"x", ScalarType::float32}, {"q", ScalarType::float64}}},
                     {"face", 0, {{"vertex_indices", ScalarType::int32, true, ScalarType::uint8}}},
                     {"empty", 2, {}}};
  const std::string text = plyHeaderText(header);
  CHECK(text ==
        "ply\nformat binary_little_endian 1.0\ncomment a\ncomment\nobj_info b c\ncomment two\ncomment lines\n"
        "obj_info x\ncomment y\nelement vertex 4000000000\nproperty float x\nproperty double q\nelement face 0\n"
        "property list uchar int vertex_indices\nelement empty 2\nend_header\n");
  CHECK(plyHeaderText(parse(text)) == text);
}

TEST_CASE("PLY header: names that cannot be written are a usage error") {
  for (const char* name : {"", "a b", "a\n", "\t"}) {
    PlyHeader header;
    header.elements = {{name, 0, {}}};
    CHECK(errorOf([&] { plyHeaderText(header); })->kind == ErrorKind::usage);
    header.elements = {{"vertex", 0, {{name, ScalarType::int8}}}};
    CHECK(errorOf([&] { plyHeaderText(header); })->kind == ErrorKind::usage);
  }
  PlyHeader header;
  header.elements = {{"vertex", 0, {{"x"}, {"x"}}}};
  CHECK_THAT(errorOf([&] { plyHeaderText(header); })->cause, Catch::Contains("would stand twice"));
  header.elements = {{"vertex", 0, {}}, {"vertex", 0, {}}};
  CHECK_THAT(errorOf([&] { plyHeaderText(header); })->cause, Catch::Contains("would stand twice"));
}
