// Environment maps as rows: from files by a module that is loaded for the first of them, and from memory.
#include "light/map_rows.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/module.h"
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

}  // namespace

MapRows openMapFile(const std::string& path, PixelEncoding encoding, int threads) {
  requireReadable(path);
  MapRows rows;
  // The rows that the module returns hold its code.
  static const ModuleFunction module =
      moduleFunction(SHBAKE_MAP_FILE_MODULE, SHBAKE_MODULE_FOLDER, "shbakeOpenMapFile");
  if (module.address == nullptr) {
    fail(path, "the part of shbake that reads images cannot be loaded: " + module.problem,
         "build shbake again with libopenimageio-dev installed, or install it whole");
  }
  reinterpret_cast<decltype(&shbakeOpenMapFile)>(module.address)(path, encoding, threads, rows);
  return rows;
}

ChosenLayout chooseLayout(const MapRows& rows, MapLayout asked) {
  if (asked != MapLayout::automatic) return {asked};
  const std::optional<MapLayout> guess = rows.layout ? rows.layout : guessLayout(rows.width, rows.height);
  if (guess) return {*guess, !rows.layout};
  throw Error({.file = rows.name,
               .place = std::to_string(rows.width) + "x" + std::to_string(rows.height) + " pixels",
               .cause = "width : height does not tell the layout (2:1 lat-long, 1:1 angular, 4:3 and 3:4 cube "
                        "crosses, 6:1 and 1:6 cube strips)",
               .remedy = "name the layout"});
}

void rethrowNaming(const Error& error, const std::string& name) {
  Error::Parts parts = error.parts();
  parts.file = name;
  throw Error(parts);
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
