#include "mesh/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kChunkBytes = 4 << 20;  // 40 ms at 100 MB/s: short enough to cancel promptly

/// An open file of any kind but a folder.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0 || ::fstat(file_, &info_) != 0) {
      const int error = errno;
      if (file_ >= 0) ::close(file_);
      const char* remedy = error == ENOENT   ? "check the name and the folder"
                           : error == EACCES ? "ask its owner for permission to read it"
                                             : "check that it is a file that you can read";
      throw Error({.file = path, .cause = std::string("cannot be opened: ") + std::strerror(error), .remedy = remedy});
    }
    if (S_ISDIR(info_.st_mode)) {
      ::close(file_);
      throw Error({.file = path, .cause = "is a folder", .remedy = "name a file in it"});
    }
  }
  ~OpenFile() { ::close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool isRegular() const { return S_ISREG(info_.st_mode); }
  std::uint64_t size() const { return static_cast<std::uint64_t>(info_.st_size); }

  /// Reads up to `count` bytes; fewer only at the end of the file.
  std::size_t read(char* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t n = ::read(file_, to + done, count - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        throw Error({.file = path_,
                     .cause = std::string("cannot be read: ") + std::strerror(errno),
                     .remedy = "check the disk or copy the file elsewhere"});
      }
      if (n == 0) break;
      done += static_cast<std::size_t>(n);
    }
    return done;
  }

  [[noreturn]] void failEmpty() const {
    throw Error({.file = path_, .cause = "is empty", .remedy = "check the program that wrote it"});
  }

 private:
  const std::string& path_;
  int file_;
  struct stat info_ {};
};

std::unique_ptr<char[]> allocate(const std::string& path, std::size_t bytes) {
  try {
    return std::make_unique_for_overwrite<char[]>(bytes);
  } catch (const std::bad_alloc&) {
    throw Error({.file = path,
                 .cause = std::to_string(bytes >> 20) + " MiB do not fit into memory",
                 .remedy = "use a machine with more memory or a smaller mesh"});
  }
}

}  // namespace

FileBytes::FileBytes(const std::string& path, Progress& progress) {
  OpenFile file(path);
  if (file.isRegular() && file.size() == 0) file.failEmpty();
  progress.begin("loading", file.isRegular() ? static_cast<double>(file.size()) : 0.0, "bytes");
  // One byte more than the size says shows whether the file has grown, as a pipe always has.
  std::size_t capacity = file.isRegular() ? static_cast<std::size_t>(file.size()) + 1 : kChunkBytes;
  data_ = allocate(path, capacity);
  for (;;) {
    const std::size_t wanted = std::min(kChunkBytes, capacity - size_);
    const std::size_t got = file.read(data_.get() + size_, wanted);
    size_ += got;
    progress.advance(static_cast<double>(got));
    if (got < wanted) break;
    if (size_ == capacity) {
      capacity *= 2;
      auto larger = allocate(path, capacity);
      std::memcpy(larger.get(), data_.get(), size_);
      data_ = std::move(larger);
    }
  }
  if (size_ == 0) file.failEmpty();
  progress.end();
}

FileStart readFileStart(const std::string& path, std::size_t count) {
  OpenFile file(path);
  if (!file.isRegular()) {
    throw Error({.file = path, .cause = "is a pipe or a device", .remedy = "save the mesh to a file first"});
  }
  if (file.size() == 0) file.failEmpty();
  FileStart start{std::string(count, '\0'), file.size()};
  start.bytes.resize(file.read(start.bytes.data(), count));
  return start;
}

}  // namespace shbake
