// MTL: colours and textures, and a warning for each line that is left out.
#include <catch2/catch.hpp>

#include "mesh/obj_materials.h"
#include "test_ply_files.h"

using namespace shbake;

namespace {

struct Read {
  std::vector<ObjMaterial> materials;
  std::vector<std::string> warnings;
};

Read readText(const std::string& text) {
  const plytest::Folder folder;
  Progress progress;
  Read read;
  read.materials = readObjMaterials(folder.write("a.mtl", text), progress, read.warnings);
  return read;
}

}  // namespace

TEST_CASE("MTL: names hold blanks, colours one or three numbers") {
  const Read r =
      readText("# c\r\nnewmtl dark wood \r\nKa 1 1 1\r\n\tKd .1 .2 .3\r\nnewmtl grey\r\nKd 0.5\r\nnewmtl none\r\n");
  REQUIRE(r.materials.size() == 3);
  CHECK(r.materials[0].name == "dark wood");
  CHECK(r.materials[0].diffuse == Rgb(.1f, .2f, .3f));
  CHECK(r.materials[1].diffuse == Rgb(.5f, .5f, .5f));
  CHECK(r.materials[1].hasDiffuse);
  CHECK_FALSE(r.materials[2].hasDiffuse);
  CHECK(r.warnings.empty());
}

TEST_CASE("MTL: texture names follow their options and keep their blanks") {
  const auto texture = [](const std::string& argument) {
    return readText("newmtl a\nmap_Kd " + argument + "\n").materials.at(0).texture;
  };
  CHECK(texture("wall.png") == "wall.png");
  CHECK(texture("old wall.png") == "old wall.png");
  CHECK(texture("-blendu on -mm 0 1 -o 0 0 0 -s 2 2 1 dir\\wall.png") == "dir\\wall.png");
  CHECK(texture("-s 2 2 wall.png") == "wall.png");
  CHECK(texture("-o 1 old wall.png") == "old wall.png");
  CHECK(texture("-unknown.png") == "-unknown.png");
}

TEST_CASE("MTL: what cannot be used is left out with a warning at its line") {
  const Read r = readText(
      "Kd 1 1 1\nnewmtl a\nKd spectral file.rfl\nnewmtl b\nKd 1 2\nnewmtl c\nKd nan 0 0\nnewmtl d\nKd 2 0 -1\n");
  REQUIRE(r.materials.size() == 4);
  for (int i = 0; i < 3; ++i) CHECK_FALSE(r.materials[i].hasDiffuse);
  CHECK(r.materials[3].diffuse == Rgb(1, 0, 0));
  REQUIRE(r.warnings.size() == 5);
  const std::vector<std::string> places = {"line 1:", "line 3:", "line 5:", "line 7:", "line 9:"};
  for (std::size_t i = 0; i < places.size(); ++i) CHECK(r.warnings[i].find(places[i]) != std::string::npos);
}
