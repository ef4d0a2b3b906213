// The one exception type of shbake: how its message is put together.
#include "base/error.h"

#include <utility>

namespace shbake {
namespace {

std::string message(const Error::Parts& p) {
  std::string text;
  if (!p.file.empty()) text += p.file + ": ";
  if (!p.place.empty()) text += p.place + ": ";
  text += p.cause;
  if (!p.remedy.empty()) text += "; " + p.remedy;
  return text;
}

}  // namespace

Error::Error(Parts parts) : std::runtime_error(message(parts)), parts_(std::move(parts)) {}

Error usageError(std::string cause, std::string remedy) {
  return Error({.kind = ErrorKind::usage, .cause = std::move(cause), .remedy = std::move(remedy)});
}

Error cancelledError() {
  return Error({.kind = ErrorKind::cancelled, .cause = "stopped"});
}

}  // namespace shbake
