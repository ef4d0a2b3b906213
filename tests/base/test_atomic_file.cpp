// Files that appear whole or not at all: on success, on every kind of failure, and when given up.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"

using namespace shbake;
namespace fs = std::filesystem;

namespace {

/// A folder of its own that goes with the test.
struct Folder {
  fs::path path;
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "shbake-test-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(path)) all.push_back(entry.path().filename().string());
    std::sort(all.begin(), all.end());
    return all;
  }
};

/// Limits the size of files that this process may write, for the life of the object.
struct FileSizeLimit {
  rlimit before{};
  void (*handler)(int);
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    handler = std::signal(SIGXFSZ, SIG_IGN);  // otherwise the kernel ends the process
    const rlimit limited{bytes, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limited) == 0);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
};

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

mode_t permissions(const std::string& path) {
  struct stat info {};
  REQUIRE(::stat(path.c_str(), &info) == 0);
  return info.st_mode & 07777;
}

template <class Work>
Error::Parts failureOf(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.parts();
  }
  FAIL("no Error was thrown");
  return {};
}

const std::vector<std::string> kOnlyOut{"out"};

}  // namespace

TEST_CASE("a committed file holds all that was written, in order and across buffers") {
  Folder folder;
  std::string expected;
  {
    AtomicFile file(folder / "out");
    for (int i = 0; i < 400000; ++i) {
      const std::string line = std::to_string(i) + "\n";
      expected += line;
      file.write(line);
    }
    CHECK_FALSE(fs::exists(folder / "out"));
    file.commit();
  }
  REQUIRE(expected.size() > (2u << 20));  // several of the writer's buffers
  CHECK(contents(folder / "out") == expected);
  CHECK(folder.names() == kOnlyOut);
}

TEST_CASE("a single write larger than the buffer arrives whole") {
  Folder folder;
  std::string big(5'000'001, 'x');
  big.back() = 'y';
  AtomicFile file(folder / "out");
  file.write(big);
  file.commit();
  CHECK(contents(folder / "out") == big);
}

TEST_CASE("a file that is given up leaves nothing, and an existing one untouched") {
  Folder folder;
  { AtomicFile(folder / "new").write("half"); }
  CHECK(folder.names().empty());
  put(folder / "out", "old");
  {
    AtomicFile file(folder / "out");
    file.write("half of the new one");
    CHECK(contents(folder / "out") == "old");
  }
  CHECK(contents(folder / "out") == "old");
  CHECK(folder.names() == kOnlyOut);
}

TEST_CASE("a write past the limit on file sizes fails, names the file and leaves nothing") {
  Folder folder;
  put(folder / "out", "old");
  Error::Parts parts;
  {
    const FileSizeLimit limit(4096);
    parts = failureOf([&] {
      AtomicFile file(folder / "out");
      file.write(std::string(10000, 'x'));
      file.commit();
    });
  }
  CHECK(parts.kind == ErrorKind::work);
  CHECK(parts.file == folder / "out");
  CHECK_THAT(parts.cause, Catch::Contains("cannot be written"));
  CHECK_THAT(parts.remedy, Catch::Contains("ulimit"));
  CHECK(contents(folder / "out") == "old");
  CHECK(folder.names() == kOnlyOut);
}

TEST_CASE("a full disk is named as such") {
  const auto parts = failureOf([] {
    AtomicFile file("/dev/full");
    file.write("anything");
    file.commit();
  });
  CHECK(parts.file == "/dev/full");
  CHECK_THAT(parts.cause, Catch::Contains("No space left"));
  CHECK_THAT(parts.remedy, Catch::Contains("free some space"));
  CHECK(fs::is_character_file("/dev/full"));  // written, never replaced
}

TEST_CASE("a folder that cannot be written fails at once, and checkWritable() says the same") {
  Folder folder;
  struct Case {
    std::string path, cause, remedy;
  };
  std::vector<Case> cases{{folder / "missing/out", "No such file", "create its folder"},
                          {folder.path.string(), "is a folder", "name a file"},
                          {"/proc/shbake-test", "cannot be written", ""},
                          {"", "empty", "name a file"}};
  put(folder / "file", "");
  cases.push_back({folder / "file/out", "Not a directory", "create its folder"});
  if (::geteuid() != 0) {  // root may write everywhere
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    cases.push_back({folder / "locked/out", "Permission denied", "that you may write to"});
    put(folder / "readonly", "");
    fs::permissions(folder / "readonly", fs::perms::owner_read);
    cases.push_back({folder / "readonly", "Permission denied", "that you may write to"});
  }
  for (const Case& c : cases) {
    INFO(c.path);
    const auto opened = failureOf([&] { AtomicFile file(c.path); });
    CHECK_THAT(opened.cause, Catch::Contains(c.cause));
    CHECK_THAT(opened.remedy, Catch::Contains(c.remedy));
    const auto checked = failureOf([&] { checkWritable(c.path); });
    CHECK(checked.cause == opened.cause);
    CHECK(checked.remedy == opened.remedy);
  }
}

TEST_CASE("checkWritable() leaves no trace, and does not end the reader of a pipe") {
  Folder folder;
  checkWritable(folder / "new");
  CHECK(folder.names().empty());
  put(folder / "out", "old");
  checkWritable(folder / "out");
  CHECK(contents(folder / "out") == "old");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  checkWritable(folder / "pipe");  // opening it would wait for a reader for ever
  checkWritable("/dev/full");
}

TEST_CASE("a symbolic link stays a link and its target is replaced") {
  Folder folder;
  put(folder / "target", "old");
  fs::create_symlink("target", folder / "out");
  AtomicFile file(folder / "out");
  file.write("new");
  file.commit();
  CHECK(fs::is_symlink(folder / "out"));
  CHECK(contents(folder / "target") == "new");
}

TEST_CASE("a replaced file keeps its permissions, and a new one respects the umask") {
  Folder folder;
  put(folder / "old", "");
  fs::permissions(folder / "old", fs::perms(0640));
  const mode_t mask = ::umask(027);
  for (const char* name : {"old", "new"}) {
    AtomicFile file(folder / name);
    file.commit();
  }
  ::umask(mask);
  CHECK(permissions(folder / "old") == 0640);
  CHECK(permissions(folder / "new") == 0640);
}

TEST_CASE("files of one target at a time do not share what lies beside it: the last commit wins whole") {
  Folder folder;
  AtomicFile first(folder / "out"), second(folder / "out");
  first.write("first");
  second.write("second");
  second.commit();
  CHECK(contents(folder / "out") == "second");
  first.commit();
  CHECK(contents(folder / "out") == "first");
  CHECK(folder.names() == kOnlyOut);
}

TEST_CASE("discardOpenFiles() removes what is half written, and a later commit fails") {
  Folder folder;
  put(folder / "out", "old");
  AtomicFile file(folder / "out");
  file.write("half");
  REQUIRE(folder.names().size() == 2);
  discardOpenFiles();
  CHECK(folder.names() == kOnlyOut);
  CHECK_THROWS_AS(file.commit(), Error);
  CHECK(contents(folder / "out") == "old");
}
