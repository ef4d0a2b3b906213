// Buffered input: windows that slide and grow, lines at their edges, pipes.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <limits>
#include <thread>

#include "mesh/ply_input.h"
#include "test_ply_files.h"

using namespace shbake;
using plytest::errorOf;

namespace {

constexpr std::size_t kWindow = 1 << 20;
constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

/// Bytes that differ from place to place.
std::string pattern(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>('a' + hashBits(1, i) % 26);
  return bytes;
}

std::vector<std::string> lines(PlyInput& input, char end = '\n') {
  std::vector<std::string> all;
  std::string_view line;
  while (input.getLine(line, end, kAnyLength)) all.emplace_back(line);
  return all;
}

}  // namespace

TEST_CASE("PLY input: what is peeked at and skipped adds up to the file") {
  const plytest::Folder folder;
  const std::string bytes = pattern(3 * kWindow + 17);
  PlyInput input(folder.write("a", bytes));
  std::string seen;
  std::size_t step = 1;
  while (input.remaining() > 0) {
    CHECK(input.remaining() == bytes.size() - seen.size());
    const std::string_view view = input.peek(step);
    REQUIRE(view.size() >= std::min<std::uint64_t>(step, input.remaining()));
    const std::size_t taken = std::min(step, view.size());
    seen.append(view.substr(0, taken));
    input.skip(taken);
    step = (step * 7 + 3) % (2 * kWindow);
  }
  CHECK(seen == bytes);
  CHECK(input.peek(5).empty());
}

TEST_CASE("PLY input: lines whose end falls on either side of the window's") {
  const plytest::Folder folder;
  for (std::size_t length = kWindow - 3; length <= kWindow + 3; ++length) {
    for (const std::string end : {"\n", "\r\n"}) {
      const std::vector<std::string> text = {"first", pattern(length), "", "last"};
      std::string bytes;
      for (const std::string& line : text) bytes += line + end;
      PlyInput input(folder.write("a", bytes));
      CHECK(lines(input) == text);
      CHECK(input.lineNumber() == 4);
      // Without the line in front, the long one begins with the window.
      PlyInput whole(folder.write("a", bytes.substr(5 + end.size())));
      CHECK(lines(whole) == std::vector<std::string>(text.begin() + 1, text.end()));
    }
  }
}

TEST_CASE("PLY input: the last line may lack its end, and old line ends do") {
  const plytest::Folder folder;
  PlyInput open(folder.write("a", "one\ntwo"));
  CHECK(lines(open) == std::vector<std::string>{"one", "two"});
  PlyInput old(folder.write("a", "one\r\rtwo\r"));
  CHECK(lines(old, '\r') == std::vector<std::string>{"one", "", "two"});
  PlyInput empty(folder.write("a", ""));
  CHECK(lines(empty).empty());
  CHECK(empty.remaining() == 0);
}

TEST_CASE("PLY input: a line that is too long is named") {
  const plytest::Folder folder;
  PlyInput input(folder.write("a", "one\n" + pattern(2 * kWindow) + "\n"));
  std::string_view line;
  REQUIRE(input.getLine(line, '\n', 10));
  const auto error = errorOf([&] { input.getLine(line, '\n', 10); });
  REQUIRE(error);
  CHECK(error->place == "line 2");
  PlyInput exact(folder.write("a", "0123456789\n01234567890\n"));
  CHECK(exact.getLine(line, '\n', 10));
  CHECK(errorOf([&] { exact.getLine(line, '\n', 10); }));
}

TEST_CASE("PLY input: a pipe is read whole") {
  const plytest::Folder folder;
  const std::string path = folder.path("pipe");
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  const std::string bytes = pattern(2 * kWindow + 5) + "\nend\n";
  std::thread writer([&] { std::ofstream(path, std::ios::binary) << bytes; });
  PlyInput input(path);
  writer.join();
  CHECK(input.remaining() == bytes.size());
  const auto all = lines(input);
  REQUIRE(all.size() == 2);
  CHECK(all[0] + "\n" + all[1] + "\n" == bytes);
}

TEST_CASE("PLY input: a file that shrinks while it is read ends there") {
  const plytest::Folder folder;
  const std::string path = folder.write("a", pattern(3 * kWindow));
  PlyInput input(path);
  REQUIRE(input.peek(1).size() == kWindow);
  std::filesystem::resize_file(path, kWindow + 10);
  CHECK(input.peek(3 * kWindow).size() == kWindow + 10);
  CHECK(input.remaining() == kWindow + 10);
}

TEST_CASE("PLY input: folders and missing files") {
  const plytest::Folder folder;
  CHECK_THAT(errorOf([&] { PlyInput input(folder.path("")); })->cause, Catch::Contains("is a folder"));
  CHECK_THAT(errorOf([&] { PlyInput input(folder.path("none")); })->cause, Catch::Contains("cannot be opened"));
}
