#include "mesh/mesh_reader.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "base/file_name.h"
#include "mesh/file_bytes.h"
#include "mesh/obj_reader.h"
#include "mesh/off_reader.h"
#include "mesh/ply_reader.h"
#include "mesh/stl_reader.h"

namespace shbake {
namespace {

using Reader = Mesh (*)(const std::string&, Progress&);

struct Format {
  std::string_view extension;
  Reader read;
};
constexpr Format kFormats[] = {{"ply", readPly}, {"obj", readObj}, {"off", readOff}, {"stl", readStl}};

constexpr std::size_t kStartBytes = 4096;

/// The first word that is not part of a '#' comment.
std::string_view firstWord(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('#')) return text.substr(0, text.find_first_of(" \t\r\n"));
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
}

bool isObjKeyword(std::string_view word) {
  constexpr std::string_view kKeywords[] = {"v", "vt", "vn", "vp", "f", "o", "g", "s", "mtllib", "usemtl"};
  return std::find(std::begin(kKeywords), std::end(kKeywords), word) != std::end(kKeywords);
}

/// The reader that the content asks for, or nullptr.
Reader readerOfContent(const FileStart& start) {
  const std::string_view bytes = start.bytes;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return readPly;
  if (isBinaryStl(bytes, start.size) || isAsciiStl(bytes)) return readStl;
  const std::string_view word = firstWord(bytes);
  if (isOffHeader(word)) return readOff;
  return isObjKeyword(word) ? readObj : nullptr;
}

/// The extension of a file's name in lower case, without the dot.
std::string extensionOf(const std::string& path) {
  const std::string extension = lowerExtension(path);
  return extension.empty() ? extension : extension.substr(1);
}

Reader readerOfName(const std::string& path) {
  const std::string extension = extensionOf(path);
  for (const Format& format : kFormats) {
    if (format.extension == extension) return format.read;
  }
  return nullptr;
}

[[noreturn]] void failUnknown(const std::string& path, std::string_view bytes) {
  std::string cause = "is no mesh file that shbake knows", remedy = "convert it to one of these:";
  if (bytes.starts_with("\x1F\x8B") || bytes.starts_with("PK\x03\x04") ||
      bytes.starts_with("\xFD"
                        "7zXZ")) {
    cause = "is compressed";
    remedy = "unpack it first; shbake reads";
  } else if (bytes.starts_with("glTF")) {
    cause = "is a binary glTF file, which shbake does not read";
  }
  for (const Format& format : kFormats) remedy += " ." + std::string(format.extension);
  throw Error({.file = path, .cause = cause, .remedy = remedy});
}

}  // namespace

Mesh readMesh(const std::string& path, Progress& progress) {
  const FileStart start = readFileStart(path, kStartBytes);
  Reader read = readerOfContent(start);
  if (!read) read = readerOfName(path);
  if (!read) failUnknown(path, start.bytes);
  return read(path, progress);
}

std::vector<std::string> readableExtensions() {
  std::vector<std::string> extensions;
  for (const Format& format : kFormats) extensions.emplace_back(format.extension);
  return extensions;
}

}  // namespace shbake
