#include "mesh/obj_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "mesh/file_bytes.h"
#include "mesh/text_scanner.h"

namespace shbake {
namespace {

/// The options of texture statements and the most arguments that each takes.
struct TextureOption {
  std::string_view name;
  int arguments;
};
constexpr TextureOption kTextureOptions[] = {
    {"-blendu", 1}, {"-blendv", 1}, {"-boost", 1}, {"-bm", 1}, {"-cc", 1},     {"-clamp", 1}, {"-imfchan", 1},
    {"-mm", 2},     {"-o", 3},      {"-s", 3},     {"-t", 3},  {"-texres", 1}, {"-type", 1},
};

/// The file name at the end of a texture statement: all that follows the options, since names may hold blanks.
std::string textureName(TextScanner& scanner) {
  std::string_view name = scanner.restOfLine(), word;
  while (name.starts_with('-') && scanner.nextWord(word)) {
    const auto option = std::find_if(std::begin(kTextureOptions), std::end(kTextureOptions),
                                     [&](const TextureOption& o) { return o.name == word; });
    if (option == std::end(kTextureOptions)) break;
    name = scanner.restOfLine();
    // -o, -s and -t may leave out their last numbers: an argument that is no number is already the name.
    for (int i = 0; i < option->arguments && scanner.nextWord(word); ++i) {
      double number = 0;
      if (option->arguments > 1 && !parseNumber(word, number)) break;
      name = scanner.restOfLine();
    }
  }
  return std::string(name);
}

/// `Kd r [g b]`; false for `Kd spectral …`, `Kd xyz …` and what is no colour.
bool readDiffuse(TextScanner& scanner, Rgb& color) {
  std::array<double, 3> rgb{};
  int count = 0;
  for (std::string_view word; count < 3 && scanner.nextWord(word); ++count) {
    if (!parseNumber(word, rgb[count]) || !std::isfinite(rgb[count])) return false;
  }
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  color = Rgb(Vec3d(rgb[0], rgb[1], rgb[2]));
  return count == 1 || count == 3;
}

}  // namespace

std::vector<ObjMaterial> readObjMaterials(const std::string& path, Progress& progress,
                                          std::vector<std::string>& warnings) {
  const FileBytes file(path, progress);
  progress.begin("reading materials", static_cast<double>(file.view().size()), "bytes");
  TextScanner scanner(path, file.view(), TextScanner::Continuation::backslash, progress);
  std::vector<ObjMaterial> materials;
  const auto warn = [&](const std::string& what) {
    warnings.push_back(path + ": line " + std::to_string(scanner.lineNumber()) + ": " + what);
  };
  while (scanner.nextLine()) {
    std::string_view keyword;
    if (!scanner.nextWord(keyword)) continue;
    if (keyword == "newmtl") {
      materials.push_back({});
      materials.back().name = scanner.restOfLine();
      continue;
    }
    if (keyword != "Kd" && keyword != "map_Kd") continue;
    if (materials.empty()) {
      warn("a " + std::string(keyword) + " before the first newmtl was left out");
    } else if (keyword == "map_Kd") {
      materials.back().texture = textureName(scanner);
    } else if (Rgb color; readDiffuse(scanner, color)) {
      const Rgb inside(std::clamp(color.x, 0.f, 1.f), std::clamp(color.y, 0.f, 1.f), std::clamp(color.z, 0.f, 1.f));
      if (inside != color) warn("a diffuse colour outside 0..1 was clamped");
      materials.back().diffuse = inside;
      materials.back().hasDiffuse = true;
    } else {
      warn("a diffuse colour that is not one or three numbers was left out");
    }
  }
  progress.end();
  return materials;
}

}  // namespace shbake
