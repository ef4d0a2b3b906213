#include "mesh/ply_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kWindowBytes = 1 << 20;

}  // namespace

PlyInput::PlyInput(std::string path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info {};
  if (file_ < 0 || ::fstat(file_, &info) != 0) {
    const int error = errno;
    if (file_ >= 0) ::close(file_);
    throw Error({.file = path_,
                 .cause = std::string("cannot be opened: ") + std::strerror(error),
                 .remedy = "check the name and your permission to read it"});
  }
  try {
    if (S_ISDIR(info.st_mode)) throw Error({.file = path_, .cause = "is a folder", .remedy = "name a file in it"});
    if (S_ISREG(info.st_mode)) {
      unread_ = static_cast<std::uint64_t>(info.st_size);
    } else {
      readWhole();
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

PlyInput::~PlyInput() {
  ::close(file_);
}

std::size_t PlyInput::readSome(char* to, std::size_t bytes) {
  for (;;) {
    const ssize_t n = ::read(file_, to, bytes);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno == EINTR) continue;
    throw Error({.file = path_,
                 .cause = std::string("cannot be read: ") + std::strerror(errno),
                 .remedy = "check the disk or copy the file elsewhere"});
  }
}

void PlyInput::readWhole() {
  for (std::size_t n = 1; n > 0; end_ += n) {
    if (buffer_.size() - end_ < kWindowBytes) buffer_.resize(std::max(2 * buffer_.size(), kWindowBytes));
    n = readSome(buffer_.data() + end_, buffer_.size() - end_);
  }
}

std::string_view PlyInput::peek(std::size_t bytes) {
  if (end_ - begin_ < bytes && unread_ > 0) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= std::exchange(begin_, 0);
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(std::max(bytes, kWindowBytes), remaining()));
    if (buffer_.size() < wanted) buffer_.resize(wanted);
    while (end_ < wanted && unread_ > 0) {
      const std::size_t n = readSome(buffer_.data() + end_, wanted - end_);
      end_ += n;
      unread_ = n == 0 ? 0 : unread_ - n;  // 0: the file became shorter while it was read
    }
  }
  return {buffer_.data() + begin_, end_ - begin_};
}

bool PlyInput::getLine(std::string_view& line, char lineEnd, std::size_t longest) {
  std::size_t searched = 0;
  std::string_view view = peek(1);
  for (;;) {
    const std::size_t at = view.find(lineEnd, searched);
    if (at != std::string_view::npos || remaining() == view.size()) {
      if (view.empty()) return false;
      line = view.substr(0, at);
      skip(at == std::string_view::npos ? view.size() : at + 1);
      break;
    }
    searched = view.size();
    if (searched > longest) break;
    view = peek(2 * view.size());
  }
  ++lineNumber_;
  if (searched > longest || line.size() > longest) {
    throw Error({.file = path_,
                 .place = "line " + std::to_string(lineNumber_),
                 .cause = "is longer than " + std::to_string(longest) + " bytes",
                 .remedy = "check that the file is an intact PLY"});
  }
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

}  // namespace shbake
