// Buffered reading of a file whose size is known: the place where promises of a header are checked against bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shbake {

/// A file read from front to back through a window. A pipe is read whole at once, since its size is not known before.
/// Views that it returns hold until the next call of peek() or getLine().
class PlyInput {
 public:
  /// Throws an Error when the file cannot be opened or is a folder.
  explicit PlyInput(std::string path);
  ~PlyInput();
  PlyInput(const PlyInput&) = delete;
  PlyInput& operator=(const PlyInput&) = delete;

  const std::string& path() const { return path_; }
  /// Bytes between the current place and the end of the file.
  std::uint64_t remaining() const { return unread_ + (end_ - begin_); }

  /// At least `bytes` bytes from the current place, or all up to the end of the file when there are fewer. The window
  /// grows to hold them, never beyond the size of the file.
  std::string_view peek(std::size_t bytes);
  /// Moves on by `bytes`, which a peek() has shown.
  void skip(std::size_t bytes) { begin_ += bytes; }

  /// The next line without its end; false at the end of the file. A line that ends in "\r\n" loses both. Lines longer
  /// than `longest` bytes throw an Error.
  bool getLine(std::string_view& line, char lineEnd, std::size_t longest);
  /// The number of the line that getLine() returned last, from 1.
  std::uint64_t lineNumber() const { return lineNumber_; }

 private:
  void readWhole();
  std::size_t readSome(char* to, std::size_t bytes);

  std::string path_;
  int file_ = -1;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // the unconsumed part of the buffer
  std::uint64_t unread_ = 0;         // bytes of the file behind the buffer
  std::uint64_t lineNumber_ = 0;
};

}  // namespace shbake
