// Writes the scenes of this folder, or checks that the files here are what it would write.
//
// Usage: make_scenes FOLDER          write the scenes into FOLDER
//        make_scenes --check FOLDER  exit 1 when a file there differs or is missing
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "support/shapes.h"

namespace {

using namespace shbake;

struct SceneFile {
  std::string name, text;
};

// printf() into a string.
[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

// Six decimals, and no negative zero: the same text whatever the last bit of a platform's sine.
void appendVector(std::string& text, const char* name, Vec3d v) {
  const auto tidy = [](double x) { return std::round(x * 1e6) / 1e6 + 0.0; };
  append(text, "%s%.6f %.6f %.6f\n", name, tidy(v.x), tidy(v.y), tidy(v.z));
}

std::string objOf(const Mesh& mesh, const std::string& title) {
  std::string text = "# " + title + "\n";
  for (const Vec3d& p : mesh.positions) appendVector(text, "v ", p);
  for (const Triangle& t : mesh.triangles) append(text, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

// An OBJ file whose faces are grouped by their colour, and the MTL file that names the colours.
void addColored(std::vector<SceneFile>& files, const std::string& stem, const Mesh& mesh, const std::string& title) {
  std::map<std::tuple<float, float, float>, std::vector<Triangle>> groups;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Rgb& c = mesh.faceColors[f];
    groups[{c.x, c.y, c.z}].push_back(mesh.triangles[f]);
  }
  std::string obj = "# " + title + "\nmtllib " + stem + ".mtl\n", mtl = "# " + title + "\n";
  for (const Vec3d& p : mesh.positions) appendVector(obj, "v ", p);
  int number = 0;
  for (const auto& [color, faces] : groups) {
    const auto& [red, green, blue] = color;
    append(mtl, "newmtl color%d\n", ++number);
    appendVector(mtl, "Kd ", Vec3d(red, green, blue));
    append(obj, "usemtl color%d\n", number);
    for (const Triangle& t : faces) append(obj, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  files.push_back({stem + ".obj", obj});
  files.push_back({stem + ".mtl", mtl});
}

std::string plyOf(const Mesh& mesh, const std::string& title) {
  std::string text = "ply\nformat ascii 1.0\ncomment " + title + "\n";
  append(text, "element vertex %zu\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) append(text, "property float %s\n", name);
  append(text, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    appendVector(text, "", mesh.positions[v]);
    text.back() = ' ';
    appendVector(text, "", Vec3d(mesh.vertexNormals[v]));
  }
  for (const Triangle& t : mesh.triangles) append(text, "3 %u %u %u\n", t[0], t[1], t[2]);
  return text;
}

std::vector<SceneFile> allScenes() {
  std::vector<SceneFile> files;
  addColored(files, "room", shapes::cornellRoom(8),
             "A room open to one side, with a red and a green wall and two boxes");
  files.push_back({"columns.obj", objOf(shapes::columns(2, 24), "Four columns on a floor")});
  files.push_back({"city.obj", objOf(shapes::city(6, 3, 4),
                                     "Houses on a ground plane that they touch without sharing "
                                     "vertices")});
  files.push_back({"bowl.ply", plyOf(shapes::bowl(std::numbers::pi / 3, 16, 48, true),
                                     "The inside of a unit sphere, open 60 degrees around +z, with exact normals")});
  return files;
}

bool write(const SceneFile& file, const std::string& folder) {
  std::ofstream out(folder + "/" + file.name, std::ios::binary);
  out << file.text;
  out.close();
  if (!out) std::fprintf(stderr, "%s/%s: cannot be written\n", folder.c_str(), file.name.c_str());
  return bool(out);
}

bool check(const SceneFile& file, const std::string& folder) {
  std::ifstream in(folder + "/" + file.name, std::ios::binary);
  const std::string found((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const bool same = in.is_open() && found == file.text;
  if (!same) std::fprintf(stderr, "%s/%s: not what make_scenes writes\n", folder.c_str(), file.name.c_str());
  return same;
}

}  // namespace

int main(int count, char** arguments) {
  const bool checking = count == 3 && std::string_view(arguments[1]) == "--check";
  if (count != 2 && !checking) {
    std::fprintf(stderr, "usage: make_scenes [--check] FOLDER\n");
    return 2;
  }
  bool good = true;
  for (const SceneFile& file : allScenes()) {
    good &= checking ? check(file, arguments[2]) : write(file, arguments[1]);
  }
  return good ? 0 : 1;
}
