// Environment maps as rows: from files by a module that is loaded for the first of them, and from memory.
#include "light/map_rows.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "light/map_file_module.h"

namespace shbake {
namespace {

[[noreturn]] void fail(const std::string& path, std::string cause, std::string remedy) {
  throw Error({.file = path, .cause = std::move(cause), .remedy = std::move(remedy)});
}

void requireReadable(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail(path, "there is no such file", "correct the path");
  if (std::filesystem::is_directory(path, error)) fail(path, "is a folder", "name an image file");
  if (std::filesystem::file_size(path, error) == 0 && !error) fail(path, "is empty", "fetch it again");
}

/// The module, or why it could not be loaded. It stays loaded: the rows that it returns hold its code.
struct MapFileModule {
  decltype(&shbakeOpenMapFile) open = nullptr;
  std::string problem;

  // By its full path: a search along the program's run path does not work under the address sanitizer, whose own dlopen
  // is then the caller.
  MapFileModule() {
    void* const module = ::dlopen(SHBAKE_MAP_FILE_MODULE, RTLD_NOW | RTLD_LOCAL);
    void* const symbol = module == nullptr ? nullptr : ::dlsym(module, "shbakeOpenMapFile");
    open = reinterpret_cast<decltype(&shbakeOpenMapFile)>(symbol);
    if (symbol == nullptr) problem = ::dlerror();
  }
};

}  // namespace

MapRows openMapFile(const std::string& path, PixelEncoding encoding, int threads) {
  requireReadable(path);
  MapRows rows;
  static const MapFileModule module;
  if (module.open == nullptr) {
    fail(path, "the part of shbake that reads images cannot be loaded: " + module.problem,
         "build shbake again, with libopenimageio-dev installed");
  }
  module.open(path, encoding, threads, rows);
  return rows;
}

MapRows mapInMemory(int width, int height, std::span<const Rgb> pixels) {
  if (width < 1 || height < 1 || pixels.size() != static_cast<std::size_t>(width) * height) {
    throw usageError("an image of " + std::to_string(width) + "x" + std::to_string(height) + " pixels was given " +
                         std::to_string(pixels.size()),
                     "give width * height pixels");
  }
  MapRows rows;
  rows.name = "image";
  rows.width = width;
  rows.height = height;
  rows.read = [width, pixels](int begin, int end, std::span<Rgb> out) {
    const auto from =
        pixels.subspan(static_cast<std::size_t>(begin) * width, static_cast<std::size_t>(end - begin) * width);
    std::copy(from.begin(), from.end(), out.begin());
  };
  return rows;
}

}  // namespace shbake
