#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

[[noreturn]] void fail(const std::string& path, int error) {
  const bool full = error == ENOSPC || error == EDQUOT;
  throw Error({.file = path,
               .cause = std::string("cannot be written: ") + std::strerror(error),
               .remedy = full ? "free some space or write elsewhere" : "choose a folder that you may write to"});
}

}  // namespace

struct AtomicFile::State {
  std::string path;       // as the user named it
  std::string target;     // with symbolic links followed
  std::string temporary;  // empty: the target is written directly
  int file = -1;
  std::vector<char> buffer;

  void flush() {
    std::size_t done = 0;
    while (done < buffer.size()) {
      const ssize_t n = ::write(file, buffer.data() + done, buffer.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(path, errno);
      done += static_cast<std::size_t>(n);
    }
    buffer.clear();
  }

  ~State() {
    if (file >= 0) ::close(file);
    if (!temporary.empty()) ::unlink(temporary.c_str());
  }
};

AtomicFile::AtomicFile(std::string path) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = std::move(path);
  s.buffer.reserve(kBufferBytes);
  std::error_code ignored;
  const auto resolved = std::filesystem::weakly_canonical(s.path, ignored);
  s.target = resolved.empty() ? s.path : resolved.string();

  struct stat info {};
  const bool exists = ::stat(s.target.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) {
    throw Error({.file = s.path, .cause = "is a folder", .remedy = "name a file in it"});
  }
  if (exists && !S_ISREG(info.st_mode)) {
    s.file = ::open(s.target.c_str(), O_WRONLY | O_CLOEXEC);
    if (s.file < 0) fail(s.path, errno);
    return;
  }
  if (exists && ::access(s.target.c_str(), W_OK) != 0) fail(s.path, errno);
  std::string pattern = s.target + ".XXXXXX";
  s.file = ::mkostemp(pattern.data(), O_CLOEXEC);
  if (s.file < 0) fail(s.path, errno);
  s.temporary = pattern;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(s.file, exists ? info.st_mode & 07777 : 0666 & ~mask);
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(const void* data, std::size_t bytes) {
  State& s = *state_;
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const std::size_t room = std::min(bytes, kBufferBytes - s.buffer.size());
    s.buffer.insert(s.buffer.end(), from, from + room);
    from += room;
    bytes -= room;
    if (s.buffer.size() == kBufferBytes) s.flush();
  }
}

void AtomicFile::commit() {
  State& s = *state_;
  s.flush();
  if (s.temporary.empty()) return;
  if (::fsync(s.file) != 0) fail(s.path, errno);
  if (::close(std::exchange(s.file, -1)) != 0) fail(s.path, errno);
  if (::rename(s.temporary.c_str(), s.target.c_str()) != 0) fail(s.path, errno);
  s.temporary.clear();
}

}  // namespace shbake
