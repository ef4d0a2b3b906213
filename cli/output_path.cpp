#include "cli/output_path.h"

#include <algorithm>
#include <filesystem>

#include "shbake.h"

namespace shbake::cli {

void checkOutput(const std::string& output, std::span<const std::string> inputs, const std::string& what, bool force) {
  const bool replaces = std::any_of(inputs.begin(), inputs.end(), [&](const std::string& input) {
    std::error_code missing;
    return std::filesystem::equivalent(input, output, missing);
  });
  if (replaces && !force) {
    throw Error({.kind = ErrorKind::usage,
                 .file = output,
                 .cause = "would replace " + what,
                 .remedy = "name another output, or add --force"});
  }
  checkWritable(output);
}

void requirePlyName(const std::string& output, const std::string& verb) {
  const std::string extension = lowerExtension(output);
  if (extension.empty() || extension == ".ply") return;
  throw Error({.kind = ErrorKind::usage,
               .file = output,
               .cause = "'" + extension + "' is not a format that shbake " + verb + " writes",
               .remedy = "name the output .ply"});
}

}  // namespace shbake::cli
