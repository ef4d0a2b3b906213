// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace shbake {

/// Writes beside the target and renames over it on commit(). Destroyed without commit(), it leaves nothing behind and
/// an existing target untouched. A target that is not a regular file ("/dev/stdout", a pipe) is written directly. The
/// file beside is named TARGET.partial-PROCESS-NUMBER; only a process killed outright leaves one.
class AtomicFile {
 public:
  /// Throws an Error naming `path` when its folder cannot be written, or when `path` is empty or a folder.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes (buffered). Throws an Error naming the file and the cause, such as a full disk.
  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Flushes, fsyncs and renames onto the target. Throws an Error, leaving the target untouched, when one of these
  /// fails.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws the Error that opening an AtomicFile on `path` would throw, and leaves no trace: asked before long work
/// starts.
void checkWritable(const std::string& path);

/// Removes what the AtomicFiles of this process have written beside their targets, for a program that must end at once
/// without unwinding (`_exit`). A commit() that follows throws.
void discardOpenFiles() noexcept;

}  // namespace shbake
