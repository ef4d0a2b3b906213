// The one exception type of shbake.
#pragma once

#include <stdexcept>
#include <string>

namespace shbake {

/// What went wrong, which decides the program's exit code.
enum class ErrorKind {
  work,       ///< the work failed: a bad file, not enough memory, a full disk (exit code 1)
  usage,      ///< an option out of its range or options that contradict each other (exit code 2)
  cancelled,  ///< stopped by the user (exit code 130)
};

/// Thrown by every public function of shbake. what() reads "file: place: cause; remedy", leaving out what is empty.
class Error : public std::runtime_error {
 public:
  struct Parts {
    ErrorKind kind = ErrorKind::work;
    std::string file{};    ///< the file concerned, as the user named it
    std::string place{};   ///< the place in it: "line 12", "vertex 7", "header"
    std::string cause{};   ///< what is wrong
    std::string remedy{};  ///< what to do about it
  };

  explicit Error(Parts parts);

  const Parts& parts() const { return parts_; }
  ErrorKind kind() const { return parts_.kind; }

 private:
  Parts parts_;
};

/// An option that cannot be used as given.
Error usageError(std::string cause, std::string remedy = {});

/// The user stopped the work.
Error cancelledError();

}  // namespace shbake
