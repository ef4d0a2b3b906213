// Files that appear whole or not at all, by POSIX rename.
#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

const char* remedyFor(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or write elsewhere";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) or write elsewhere";
    case ENOENT:
    case ENOTDIR:
      return "create its folder first or correct the path";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    default:
      return "write elsewhere";
  }
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error(
      {.file = path, .cause = std::string("cannot be written: ") + std::strerror(error), .remedy = remedyFor(error)});
}

/// The files beside targets that exist at this moment.
struct Partials {
  std::mutex mutex;
  std::set<std::string> paths;
  unsigned next = 0;  // numbers the files of this process
};

Partials& partials() {
  static Partials all;
  return all;
}

/// Creates a file beside `target` that did not exist, with the permissions a new file gets; returns its descriptor and
/// sets `name`, or returns -1 with errno set.
int createPartial(const std::string& target, std::string& name) {
  Partials& all = partials();
  const std::lock_guard lock(all.mutex);
  int file = -1;
  do {
    name = target + ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(all.next++);
    file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file < 0 && (errno == EEXIST || errno == EINTR));
  if (file >= 0) all.paths.insert(name);
  return file;
}

/// The file that `path` names once symbolic links are followed, so that a link stays a link.
std::string followLinks(const std::string& path) {
  std::error_code error;
  const auto resolved = std::filesystem::weakly_canonical(path, error);
  return error ? path : resolved.string();
}

}  // namespace

struct AtomicFile::State {
  std::string path;     // as the user named it
  std::string target;   // with symbolic links followed
  std::string partial;  // empty: the target is written directly
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
    if (partial.empty()) return;
    const std::lock_guard lock(partials().mutex);
    if (partials().paths.erase(partial) > 0) ::unlink(partial.c_str());
  }
};

AtomicFile::AtomicFile(std::string path) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = std::move(path);
  if (s.path.empty()) throw usageError("the name of the file to write is empty", "name a file");
  s.buffer.reserve(kBufferBytes);
  s.target = followLinks(s.path);

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
  s.file = createPartial(s.target, s.partial);
  if (s.file < 0) fail(s.path, errno);
  if (exists && ::fchmod(s.file, info.st_mode & 07777) != 0) fail(s.path, errno);
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
  if (s.partial.empty()) return;
  if (::fsync(s.file) != 0) fail(s.path, errno);
  if (::close(std::exchange(s.file, -1)) != 0) fail(s.path, errno);
  const std::lock_guard lock(partials().mutex);
  if (::rename(s.partial.c_str(), s.target.c_str()) != 0) fail(s.path, errno);
  partials().paths.erase(s.partial);
  s.partial.clear();
}

void checkWritable(const std::string& path) {
  struct stat info {};
  const bool special = ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
  if (!special) {
    const AtomicFile probe(path);
  } else if (::access(path.c_str(), W_OK) != 0) {  // opening a pipe and closing it again would end its reader
    fail(path, errno);
  }
}

void discardOpenFiles() noexcept {
  Partials& all = partials();
  const std::lock_guard lock(all.mutex);
  for (const std::string& path : all.paths) ::unlink(path.c_str());
  all.paths.clear();
}

}  // namespace shbake
