// Bodies of PLY files: bytes laid out by hand decode to the numbers meant, in every encoding; faults name their item.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "mesh/ply_body.h"
#include "mesh/ply_columns.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

/// Reads all elements of a file.
std::vector<std::vector<Property>> decode(const std::string& bytes, Progress& progress) {
  const plytest::Folder folder;
  PlyInput input(folder.write("a.ply", bytes));
  const PlyHeader header = readPlyHeader(input);
  PlyBody body(input, header, progress);
  std::vector<std::vector<Property>> all;
  for (const PlyElement& e : header.elements) all.push_back(body.readElement(e));
  return all;
}

std::vector<std::vector<Property>> decode(const std::string& bytes) {
  Progress progress;
  return decode(bytes, progress);
}

/// The bytes of a value as this machine stores it, turned round on request.
template <class T>
std::string bytesOf(T value, bool turned) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
  if (turned) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const std::string kAllTypes =
    "element e 2\nproperty char a\nproperty uchar b\nproperty short c\nproperty ushort d\nproperty int e\n"
    "property uint f\nproperty float g\nproperty double h\n";

std::string allTypesBinary(bool turned) {
  std::string body;
  for (const int sign : {-1, 1}) {
    body += bytesOf<std::int8_t>(static_cast<std::int8_t>(sign * 100), turned);
    body += bytesOf<std::uint8_t>(200, turned);
    body += bytesOf<std::int16_t>(static_cast<std::int16_t>(sign * 30000), turned);
    body += bytesOf<std::uint16_t>(60000, turned);
    body += bytesOf<std::int32_t>(sign * 2000000000, turned);
    body += bytesOf<std::uint32_t>(4000000000u, turned);
    body += bytesOf<float>(static_cast<float>(sign) * 0.1f, turned);
    body += bytesOf<double>(sign * 0.1, turned);
  }
  return body;
}

void checkAllTypes(const std::vector<Property>& columns) {
  REQUIRE(columns.size() == 8);
  for (const std::size_t item : {0u, 1u}) {
    const double sign = item == 0 ? -1 : 1;
    const double expected[] = {sign * 100, 200, sign * 30000, 60000, sign * 2e9, 4e9, sign * static_cast<double>(0.1f),
                               sign * 0.1};
    for (std::size_t c = 0; c < 8; ++c) CHECK(scalarAt(columns[c], item) == expected[c]);
  }
}

const bool kBigMachine = std::endian::native == std::endian::big;

}  // namespace

TEST_CASE("PLY body: scalars of all types in all encodings") {
  checkAllTypes(
      decode("ply\nformat binary_little_endian 1.0\n" + kAllTypes + "end_header\n" + allTypesBinary(kBigMachine))[0]);
  checkAllTypes(
      decode("ply\nformat binary_big_endian 1.0\n" + kAllTypes + "end_header\n" + allTypesBinary(!kBigMachine))[0]);
  checkAllTypes(decode("ply\nformat ascii 1.0\n" + kAllTypes +
                       "end_header\n-100 200 -30000 60000 -2000000000 4000000000 -0.1 -0.1\n"
                       "\n  +100\t+200 30000 60000 2000000000 4000000000 .1 1e-1  \r\n")[0]);
}

TEST_CASE("PLY body: scalars keep their bits, whatever they mean") {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement e 2\nproperty float a\nproperty double b\nend_header\n";
  const std::uint32_t signalling = 0x7FA00001u;
  const std::uint64_t wide = 0xFFF4000000000001ull;
  const std::string row = bytesOf(signalling, !kBigMachine) + bytesOf(wide, !kBigMachine);
  const auto columns = decode(header + row + row)[0];
  for (std::size_t item = 0; item < 2; ++item) {
    CHECK(std::memcmp(columns[0].values.data() + 4 * item, &signalling, 4) == 0);
    CHECK(std::memcmp(columns[1].values.data() + 8 * item, &wide, 8) == 0);
  }
}

TEST_CASE("PLY body: lists between scalars, elements in a row") {
  const std::string header =
      "element e 3\nproperty uchar a\nproperty list ushort short l\nproperty char b\n"
      "element none 5\nelement f 1\nproperty list int double m\nend_header\n";
  const std::vector<std::vector<int>> lists = {{-1, 2, 300}, {}, {7}};
  for (const bool big : {false, true}) {
    const bool turned = big != kBigMachine;
    std::string body;
    for (std::size_t i = 0; i < 3; ++i) {
      body += bytesOf<std::uint8_t>(static_cast<std::uint8_t>(10 + i), turned);
      body += bytesOf<std::uint16_t>(static_cast<std::uint16_t>(lists[i].size()), turned);
      for (const int v : lists[i]) body += bytesOf<std::int16_t>(static_cast<std::int16_t>(v), turned);
      body += bytesOf<std::int8_t>(static_cast<std::int8_t>(-5), turned);
    }
    body += bytesOf<std::int32_t>(2, turned) + bytesOf(0.5, turned) + bytesOf(-3.25, turned);
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    const auto all = decode("ply\nformat " + format + " 1.0\n" + header + body);
    const auto text = decode("ply\nformat ascii 1.0\n" + header + "10 3 -1 2 300 -5\n11 0 -5\n12 1 7 -5\n2 0.5 -3.25");
    CHECK(all == text);
    const Property& l = all[0][1];
    CHECK(l.listStarts == std::vector<std::uint64_t>{0, 3, 3, 4});
    const double expected[] = {-1, 2, 300, 7};
    for (std::size_t i = 0; i < 4; ++i) CHECK(scalarAt(l, i) == expected[i]);
    CHECK(scalarAt(all[2][0], 1) == -3.25);
    CHECK(all[1].empty());
  }
}

TEST_CASE("PLY body: text becomes the nearest number, also at the ends of the range") {
  const auto columns = decode(
      "ply\nformat ascii 1.0\nelement e 6\nproperty float a\nproperty double b\nend_header\n"
      "1.17549435e-38 5e-324\n1e-45 1.7976931348623157e308\n1e-60 1e-400\n1e60 -1e400\nnan inf\n16777217 0.1\n")[0];
  const float floats[] = {1.17549435e-38f, 1e-45f, 0, std::numeric_limits<float>::infinity(), NAN, 16777216};
  const double infinity = std::numeric_limits<double>::infinity();
  const double doubles[] = {5e-324, 1.7976931348623157e308, 0, -infinity, infinity, 0.1};
  for (std::size_t i = 0; i < 6; ++i) {
    INFO(i);
    CHECK(
        (scalarAt(columns[0], i) == static_cast<double>(floats[i]) || (i == 4 && std::isnan(scalarAt(columns[0], i)))));
    CHECK(scalarAt(columns[1], i) == doubles[i]);
  }
}

TEST_CASE("PLY body: faults of text name item and line") {
  struct Fault {
    std::string rows, place, cause;
  };
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty uchar c\nproperty list char int "
      "l\nend_header\n";
  const std::vector<Fault> faults = {
      {"1 2 1 5\n", "vertex 1 (line 8)", "header declares 2 of element vertex"},
      {"1 2 1 5\n\n1 2 2 5\n", "vertex 1 (line 10)", "ends before property l"},
      {"1 2\n1 2 0\n", "vertex 0 (line 8)", "ends before property l"},
      {"1 2 0 9\n1 2 0\n", "vertex 0 (line 8)", "more values on the line"},
      {"1 2 0\n1 256 0\n", "vertex 1 (line 9)", "'256' does not fit the type of property c"},
      {"1 2 0\n1 -1 0\n", "vertex 1 (line 9)", "'-1' does not fit the type of property c"},
      {"1 2.5 0\n1 1 0\n", "vertex 0 (line 8)", "'2.5' is not an integer, as property c asks for"},
      {"1 2 0\none 1 0\n", "vertex 1 (line 9)", "'one' is not a number, as property x asks for"},
      {"1,5 2 0\n1 1 0\n", "vertex 0 (line 8)", "'1,5' is not a number"},
      {"0x10 2 0\n1 1 0\n", "vertex 0 (line 8)", "'0x10' is not a number"},
      {"+-1 2 0\n1 1 0\n", "vertex 0 (line 8)", "'+-1' is not a number"},
      {"1 2 -3\n1 2 0\n", "vertex 0 (line 8)", "negative length -3"},
      {"1 2 128\n1 2 0\n", "vertex 0 (line 8)", "does not fit the type of property l"},
      {"1 2 1 5000000000\n1 2 0\n", "vertex 0 (line 8)", "'5000000000' does not fit"},
  };
  for (const Fault& fault : faults) {
    INFO(fault.rows);
    const auto error = errorOf([&] { decode(header + fault.rows); });
    REQUIRE(error);
    CHECK(error->place == fault.place);
    CHECK_THAT(error->cause, Catch::Contains(fault.cause));
    CHECK_FALSE(error->remedy.empty());
  }
}

TEST_CASE("PLY body: a file cut short names the element and item where it ends") {
  const std::string fixedHeader =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty uchar c\n"
      "element face 2\nproperty list uchar int v\nproperty uchar q\nend_header\n";
  const std::string vertices(15, '\1');
  const std::string face = bytesOf<std::uint8_t>(3, false) + std::string(12, '\0') + "q";
  const std::string whole = fixedHeader + vertices + face + face;
  REQUIRE(decode(whole)[1][0].listStarts.back() == 6);
  for (std::size_t size = fixedHeader.size(); size < whole.size(); ++size) {
    INFO(size - fixedHeader.size());
    const std::size_t body = size - fixedHeader.size();
    const auto error = errorOf([&] { decode(whole.substr(0, size)); });
    REQUIRE(error);
    CHECK(error->place ==
          (body < 15 ? "vertex " + std::to_string(body / 5) : "face " + std::to_string((body - 15) / face.size())));
    CHECK_THAT(error->cause, Catch::Contains("the file ends here"));
  }
}

TEST_CASE("PLY body: lists whose length lies") {
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list ";
  const auto lying = [&](const std::string& type, const std::string& length) {
    return *errorOf([&] { decode(header + type + " double v\nend_header\n" + length + "12345678"); });
  };
  CHECK_THAT(lying("uint", "\xff\xff\xff\xff").cause, Catch::Contains("the file ends here"));
  CHECK_THAT(lying("int", "\xff\xff\xff\x7f").cause, Catch::Contains("the file ends here"));
  CHECK_THAT(lying("int", "\xff\xff\xff\xff").cause, Catch::Contains("list v has the negative length -1"));
  CHECK_THAT(lying("char", "\x80").cause, Catch::Contains("list v has the negative length -128"));
}

TEST_CASE("PLY body: rows longer than the window, and lists that a sink takes") {
  const std::size_t length = 700000;  // 2.8 MB in one row
  std::string body;
  for (int row = 0; row < 2; ++row) {
    body += bytesOf(static_cast<std::uint32_t>(length), kBigMachine);
    for (std::size_t i = 0; i < length; ++i)
      body += bytesOf(static_cast<std::int32_t>(i) * (row == 0 ? 1 : -1), kBigMachine);
  }
  const plytest::Folder folder;
  PlyInput input(folder.write(
      "a.ply", "ply\nformat binary_little_endian 1.0\nelement e 2\nproperty list uint int v\nend_header\n" + body));
  const PlyHeader header = readPlyHeader(input);
  Progress progress;
  PlyBody reader(input, header, progress);
  std::size_t rows = 0, wrong = 0;
  const auto columns =
      reader.readElement(header.elements[0], "v", [&](std::uint64_t item, std::span<const std::int64_t> list) {
        CHECK(item == rows++);
        REQUIRE(list.size() == length);
        for (std::size_t i = 0; i < length; ++i)
          wrong += list[i] != static_cast<std::int64_t>(i) * (item == 0 ? 1 : -1);
      });
  CHECK(columns.empty());
  CHECK(rows == 2);
  CHECK(wrong == 0);
}

TEST_CASE("PLY body: cancelling stops after a block, whatever the encoding") {
  for (const std::string format : {"ascii", "binary_little_endian"}) {
    for (const std::string second : {"uchar b", "list uchar uchar l"}) {
      INFO(format << " " << second);
      const std::string row = format == "ascii" ? "1 0\n" : std::string(2, '\0');
      const std::size_t rows = (4 << 20) / row.size();
      std::string text = "ply\nformat " + format + " 1.0\nelement e " + std::to_string(rows) +
                         "\nproperty uchar a\nproperty " + second + "\nend_header\n";
      for (std::size_t i = 0; i < rows; ++i) text += row;
      std::vector<double> told;
      Progress progress([&](const ProgressState& state) {
        told.push_back(state.done);
        // The callback is due again as soon as its interval has passed: at the first block that is told.
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        return told.size() < 2;
      });
      progress.begin("reading", static_cast<double>(text.size()), "bytes");
      const auto error = errorOf([&] { decode(text, progress); });
      REQUIRE(error);
      CHECK(error->kind == ErrorKind::cancelled);
      REQUIRE(told.size() == 2);
      CHECK(told[1] > 0);
      CHECK(told[1] <= 1.01 * (1 << 20));
    }
  }
}
