// Whole files in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace shbake {

/// The bytes of one file, read at once: a copy, so that nothing breaks when another program shortens the file
/// meanwhile.
class FileBytes {
 public:
  /// Reads `path` to its end; a pipe too. Progress counts bytes. Throws an Error when the file is missing, a folder,
  /// empty, may not be read or does not fit into memory.
  FileBytes(const std::string& path, Progress& progress);

  std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

/// The beginning of a regular file and its size, for telling formats apart.
struct FileStart {
  std::string bytes;       ///< at most the number asked for
  std::uint64_t size = 0;  ///< of the whole file
};

/// Reads the first `count` bytes. Throws like FileBytes, and for pipes and devices, of which nothing can be read twice.
FileStart readFileStart(const std::string& path, std::size_t count);

}  // namespace shbake
