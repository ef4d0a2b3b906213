// Lines, words and numbers of text formats, with the place of every mistake.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "base/vec3.h"

namespace shbake {

/// Reads a text line by line and a line word by word. Lines end in "\n", "\r\n" or, in a text without any "\n", "\r".
/// Words are separated by blanks and tabs; a word that begins with '#' starts a comment up to the end of its line.
/// Numbers do not depend on the locale; a leading '+' and exponents are fine.
class TextScanner {
 public:
  enum class Continuation { none, backslash };  ///< whether a '\' at the end of a line joins it to the next one

  /// Both strings must outlive the scanner. Scanned bytes are added to `progress`, whose stage the caller begins.
  TextScanner(const std::string& path, std::string_view text, Continuation continuation, Progress& progress);

  /// Moves to the next line; false at the end of the text.
  bool nextLine();
  /// The next word of the current line; false at its end.
  bool nextWord(std::string_view& word);
  /// The next word on this or any later line; false at the end of the text.
  bool nextWordAnywhere(std::string_view& word);
  /// What is left of the current line, '#' included, without blanks around it.
  std::string_view restOfLine() const;
  /// True when no word is left on the current line.
  bool atLineEnd() const;

  /// The next word of the line as a finite number. `what` names it in the error: "a coordinate".
  double number(const char* what);
  /// Three finite numbers from the current line.
  Vec3d numbers3(const char* what);
  /// A word as a finite number.
  double toNumber(std::string_view word, const char* what) const;
  /// A word as a whole number from 0 to 2^32 - 2, the most vertices or faces of a mesh.
  std::uint32_t toCount(std::string_view word, const char* what) const;

  /// The current line's number, from 1: the first of lines that are joined.
  std::size_t lineNumber() const { return lineNumber_; }
  /// Throws an Error at the current line.
  [[noreturn]] void fail(const std::string& cause, const std::string& remedy) const;

 private:
  std::string_view takeLine();

  const std::string& path_;
  std::string_view text_;
  bool joinLines_;
  char lineEnd_;
  Progress& progress_;
  std::size_t at_ = 0, reported_ = 0;
  std::size_t lineNumber_ = 0, linesTaken_ = 0;
  std::string joined_;
  const char* cursor_ = nullptr;
  const char* end_ = nullptr;
};

/// Parses a decimal number that fills the whole word, "inf" and "nan" too; too small ones become 0, too large ones
/// infinite. False when it is no number.
bool parseNumber(std::string_view word, double& value);

/// A word as a message shows it: in quotes, shortened, unprintable bytes as '?'.
std::string quotedWord(std::string_view word);

}  // namespace shbake
