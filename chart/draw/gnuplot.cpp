// gnuplot as a child process: script, picture and complaints pass through files in memory, which never block.
#include "chart/draw/gnuplot.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/error.h"

extern char** environ;

namespace shbake::chart {
namespace {

/// Between two looks at whether it is done.
constexpr std::chrono::milliseconds kPoll{5};

[[noreturn]] void failSystem(const char* what) {
  throw Error({.cause = std::string("drawing failed: ") + what + ": " + std::strerror(errno),
               .remedy = "write .json, which needs no drawing"});
}

[[noreturn]] void failMissing(const std::string& program) {
  throw Error({.cause = "charts are drawn by '" + program + "', which is not installed",
               .remedy = "install it (Debian: apt-get install gnuplot-nox), or write .json, which needs no drawing"});
}

/// A file in memory that is closed when it goes.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("shbake-gnuplot", MFD_CLOEXEC)) {
    if (file_ < 0) failSystem("memfd_create");
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return file_; }

  void write(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::write(file_, text.data() + done, text.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) failSystem("write");
      done += static_cast<std::size_t>(n);
    }
    if (::lseek(file_, 0, SEEK_SET) < 0) failSystem("lseek");
  }

  std::string read() const {
    if (::lseek(file_, 0, SEEK_SET) < 0) failSystem("lseek");
    std::string all;
    std::array<char, 1 << 16> part;
    for (;;) {
      const ssize_t n = ::read(file_, part.data(), part.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) failSystem("read");
      if (n == 0) return all;
      all.append(part.data(), static_cast<std::size_t>(n));
    }
  }

 private:
  int file_;
};

/// A started process, which is ended and waited for when it goes.
class Child {
 public:
  Child(const std::string& program, const MemoryFile& in, const MemoryFile& out, const MemoryFile& errors) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, errors.descriptor(), STDERR_FILENO);
    // Signals that this program waits for on a thread of its own are blocked in all others, and would be in the child.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    std::string name = program, settings = "--default-settings", dash = "-";
    std::array<char*, 4> arguments{name.data(), settings.data(), dash.data(), nullptr};
    const int error = ::posix_spawnp(&process_, program.c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error == ENOENT) failMissing(program);
    errno = error;
    if (error != 0) failSystem(program.c_str());
  }
  ~Child() {
    if (running_) {
      ::kill(process_, SIGKILL);
      wait(0);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// True once it has ended.
  bool hasEnded() { return !running_ || wait(WNOHANG); }
  bool succeeded() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  bool wait(int options) {
    pid_t ended = 0;
    do ended = ::waitpid(process_, &status_, options);
    while (ended < 0 && errno == EINTR);
    if (ended == process_) running_ = false;
    return !running_;
  }

  pid_t process_ = 0;
  int status_ = 0;
  bool running_ = true;
};

}  // namespace

std::string runGnuplot(const std::string& script, Progress& progress, const std::string& program) {
  MemoryFile in;
  const MemoryFile out, errors;
  in.write(script);
  Child child(program, in, out, errors);
  while (!child.hasEnded()) {
    progress.advance(0);
    std::this_thread::sleep_for(kPoll);
  }
  std::string picture = out.read();
  if (!child.succeeded() || picture.empty()) {
    const std::string complaint = errors.read();
    throw Error({.cause = "gnuplot failed: " + (complaint.empty() ? "it said nothing" : complaint),
                 .remedy = "write .json, which needs no drawing, and report it with the version of gnuplot"});
  }
  return picture;
}

void requireGnuplot(const std::string& program) {
  Progress progress;
  runGnuplot("print 'shbake'\nset terminal svg\nplot 0\n", progress, program);
}

}  // namespace shbake::chart
