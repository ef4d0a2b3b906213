// Lines, words and numbers, and the place of mistakes.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "mesh/text_scanner.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

/// All words of a text, line by line, each line as "number:word,word".
std::vector<std::string> linesOf(std::string_view text,
                                 TextScanner::Continuation continuation = TextScanner::Continuation::none) {
  Progress progress;
  const std::string path = "file";
  TextScanner in(path, text, continuation, progress);
  std::vector<std::string> lines;
  while (in.nextLine()) {
    std::string line = std::to_string(in.lineNumber()) + ":";
    for (std::string_view word; in.nextWord(word);) line += std::string(word) + ",";
    lines.push_back(line);
  }
  return lines;
}

double parsed(std::string_view word) {
  double value = 99;
  REQUIRE(parseNumber(word, value));
  return value;
}

bool isNumber(std::string_view word) {
  double value = 0;
  return parseNumber(word, value);
}

}  // namespace

TEST_CASE("lines end in any convention, and the last one needs no end") {
  const std::vector<std::string> expected = {"1:a,b,", "2:", "3:c,"};
  CHECK(linesOf("a b\n\nc") == expected);
  CHECK(linesOf("a\tb \r\n\r\n c\r\n") == expected);
  CHECK(linesOf("a b\r\rc\r") == expected);
  CHECK(linesOf("\xEF\xBB\xBF"
                "a b\n\nc\n") == expected);
}

TEST_CASE("comments run from a word's '#' to the end of the line") {
  CHECK(linesOf("a # b\n#c\nd#e f") == std::vector<std::string>{"1:a,", "2:", "3:d#e,f,"});
}

TEST_CASE("a backslash joins lines only where it is asked for") {
  using enum TextScanner::Continuation;
  CHECK(linesOf("a\\\nb \\\r\n\\\nc\nd", backslash) == std::vector<std::string>{"1:a,b,c,", "5:d,"});
  CHECK(linesOf("a\\\nb", none) == std::vector<std::string>{"1:a\\,", "2:b,"});
  CHECK(linesOf("a\\", backslash) == std::vector<std::string>{"1:a,"});
}

TEST_CASE("numbers are read to the last bit in all their spellings") {
  CHECK(parsed("+1.0") == 1.0);
  CHECK(parsed("1.") == 1.0);
  CHECK(parsed(".5") == 0.5);
  CHECK(parsed("-1e-3") == -0.001);
  CHECK(parsed("1E5") == 1e5);
  CHECK(parsed("0.1") == 0.1);
  CHECK(parsed("123456789.123456789") == 123456789.123456789);
  CHECK(std::signbit(parsed("-0")));
  CHECK(std::isnan(parsed("nan")));
  CHECK(std::isinf(parsed("-inf")));
}

TEST_CASE("numbers too small for double are zero, too large ones infinite") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(parsed("1e-400") == 0);
  CHECK(parsed("-1e-400") == 0);
  CHECK(parsed("0." + std::string(400, '0') + "1") == 0);
  CHECK(parsed("1e400") == infinity);
  CHECK(parsed("-1e+400") == -infinity);
  CHECK(parsed(std::string(400, '9')) == infinity);
}

TEST_CASE("what is no number is not taken for one") {
  for (const char* word : {"", "+", "-", "e5", "1,5", "0x10", "1e", "+-1", "1.#QNAN", "1.0f", "--1"}) {
    INFO(word);
    CHECK_FALSE(isNumber(word));
  }
}

TEST_CASE("mistakes name the file, the line, the word and what should stand there") {
  Progress progress;
  const std::string path = "file.obj";
  TextScanner in(path, "1\n2,5 nan", TextScanner::Continuation::none, progress);
  REQUIRE(in.nextLine());
  auto error = errorOf([&] { in.numbers3("a coordinate"); });
  REQUIRE(error);
  CHECK(error->file == "file.obj");
  CHECK(error->place == "line 1");
  CHECK(error->cause == "the line ends where a coordinate should stand");
  REQUIRE(in.nextLine());
  error = errorOf([&] { in.number("a coordinate"); });
  REQUIRE(error);
  CHECK(error->place == "line 2");
  CHECK(error->cause == "\"2,5\" is not a number where a coordinate should stand");
  CHECK(error->remedy == "write decimals with a point, not a comma");
  error = errorOf([&] { in.number("a coordinate"); });
  REQUIRE(error);
  CHECK(error->cause == "\"nan\" is not finite where a coordinate should stand");
}

TEST_CASE("counts are whole numbers that 32 bits can hold") {
  Progress progress;
  const std::string path = "file";
  TextScanner in(path, "", TextScanner::Continuation::none, progress);
  CHECK(in.toCount("4294967294", "a count") == 4294967294u);
  CHECK(in.toCount("+7", "a count") == 7);
  for (const char* word : {"4294967295", "99999999999999999999", "-1", "1.0", "x"}) {
    INFO(word);
    CHECK(errorOf([&] { in.toCount(word, "a count"); }));
  }
}

TEST_CASE("words in messages are short and printable") {
  CHECK(quotedWord("abc") == "\"abc\"");
  CHECK(quotedWord(std::string("a\0\x1b\xff", 4)) == "\"a???\"");
  CHECK(quotedWord(std::string(100, 'x')) == "\"" + std::string(40, 'x') + "…\"");
}

TEST_CASE("scanning stops when it is cancelled") {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "v 1 2 3\n";
  const std::string path = "file";
  Progress cancelling([&](const ProgressState& state) { return state.done == 0; });
  cancelling.begin("parsing", static_cast<double>(text.size()), "bytes");
  TextScanner some(path, text, TextScanner::Continuation::none, cancelling);
  const auto error = errorOf([&] {
    while (some.nextLine()) {
      if (some.lineNumber() % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  REQUIRE(error);
  CHECK(error->kind == ErrorKind::cancelled);
}
