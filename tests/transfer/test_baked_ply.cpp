// Baked files: the layout of the conventions, round trips to the bit, foreign files, contradictions.
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/ply_columns.h"
#include "mesh/ply_reader.h"
#include "mesh/ply_writer.h"
#include "sh/basis.h"
#include "transfer/baked_examples.h"
#include "transfer/transfer_facts.h"

using namespace shbake;
using bakedtest::openOctahedron;
using bakedtest::randomBake;
using plytest::errorOf;

namespace {

void write(const std::string& path, const BakedPly& baked, bool ascii = false) {
  Progress progress;
  writeBakedPly(path, baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, {ascii}, progress);
}

BakedPly read(const std::string& path) {
  Progress progress;
  return readBakedPly(path, progress);
}

void checkSame(const BakedPly& a, const BakedPly& b) {
  CHECK(plytest::difference(a.mesh, b.mesh) == "");
  CHECK(a.transfer.order == b.transfer.order);
  CHECK(a.transfer.channels == b.transfer.channels);
  CHECK(plytest::sameBits(a.transfer.coefficients, b.transfer.coefficients));
  CHECK(plytest::sameBits(a.transfer.error, b.transfer.error));
  CHECK(plytest::sameBits(a.transfer.visibility, b.transfer.visibility));
  CHECK(a.sourceVertex == b.sourceVertex);
  CHECK(factComments(a.facts, 1, 1) == factComments(b.facts, 1, 1));
}

/// One vertex with what a test puts behind x y z nx ny nz.
std::string pointFile(const std::string& comments, const std::string& properties, const std::string& values) {
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float "
         "ny\n"
         "property float nz\n" +
         properties + "end_header\n0 0 0 0 0 1 " + values + "\n";
}

const std::string kFour = "property float sh_0\nproperty float sh_1\nproperty float sh_2\nproperty float sh_3\n";

}  // namespace

TEST_CASE("Baked PLY: header and rows exactly as the conventions state them") {
  const plytest::Folder folder;
  BakedPly baked;
  baked.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1f}};
  baked.mesh.triangles = {{0, 1, 2}};
  baked.mesh.vertexNormals.assign(3, Vec3f(0, 0, 1));
  baked.mesh.comments = {"VCGLIB generated", "shbake order=9 seed=77"};
  baked.mesh.vertexColors.assign(3, Rgb(1, 0, 0));
  baked.mesh.vertexColorEncoding = ColorEncoding::srgb;
  plytest::Random random(1);
  baked.mesh.vertexProperties.push_back(
      {"temperature", ScalarType::int16, false, ScalarType::uint8, std::vector<std::byte>(6), {}});
  baked.transfer.order = 1;
  baked.transfer.channels = 3;
  baked.transfer.coefficients = {0.1f, 0.2f, 0.3f, 1, 2, 3, 4, 5, 6};
  baked.transfer.error = {0.5f, 0, 0.25f};
  baked.transfer.visibility = {1, 0.75f, 0};
  baked.sourceVertex = {0, 1, kNewVertex};
  baked.facts = {
      "0.1.0",    TransferKind::interreflected, 3, false, 256, 1, "cosine-fibonacci", 0.01, 0.05, 0.02, {}, 3, 2,
      "bunny.ply"};
  const std::string path = folder.path("a.ply");
  write(path, baked, true);
  CHECK(plytest::readBytes(path) ==
        "ply\nformat ascii 1.0\n"
        "comment shbake version=0.1.0 transfer=interreflected bounces=3 bounces_converged=0\n"
        "comment shbake order=1 channels=3 index=l*(l+1)+m basis=real-orthonormal condon_shortley=0\n"
        "comment shbake axes=as-file handed=right units=radiance_out_per_radiance_in albedo=included\n"
        "comment shbake sampler=cosine-fibonacci rays=256 seed=1 rms_error=0.01 max_error=0.05 tolerance=0.02\n"
        "comment shbake lighting_points=3 source_vertices=2 source=bunny.ply\n"
        "comment VCGLIB generated\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
        "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty short temperature\n"
        "property float quality\nproperty float sh_r_0\nproperty float sh_g_0\nproperty float sh_b_0\n"
        "property float sh_error\nproperty int source_vertex\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 1 255 0 0 0 1 0.1 0.2 0.3 0.5 0\n"
        "1 0 0 0 0 1 255 0 0 0 0.75 1 2 3 0 1\n"
        "0 1 0.1 0 0 1 255 0 0 0 0 4 5 6 0.25 -1\n"
        "3 0 1 2\n");
}

TEST_CASE("Baked PLY: any bake reads back to the bit") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  std::uint64_t seed = 0;
  for (const int channels : {1, 3}) {
    for (const int order : {1, 2, 3, 4, 6, 9}) {
      for (const bool ascii : {false, true}) {
        INFO("order " << order << ", " << channels << " channels" << (ascii ? ", ascii" : ""));
        const BakedPly baked = randomBake(seed++, order, channels);
        write(path, baked, ascii);
        const BakedPly back = read(path);
        checkSame(back, baked);
        CHECK(back.stated);
        CHECK(back.notes.empty());
        CHECK(back.mesh.source == path);
      }
    }
  }
}

TEST_CASE("Baked PLY: baking a baked file again replaces what the first bake wrote") {
  const plytest::Folder folder;
  const std::string path = folder.path("a.ply");
  BakedPly first = randomBake(4, 3, 3);
  first.transfer.error.assign(first.transfer.size(), 0.5f);
  first.transfer.visibility.assign(first.transfer.size(), 0.5f);
  first.sourceVertex.assign(first.transfer.size(), 0);
  write(path, first);
  // As the pipeline does: the file is read as any mesh, so that the old columns and comments are carried.
  Progress progress;
  BakedPly second = randomBake(4, 2, 1);
  second.mesh = readPly(path, progress);
  CHECK(findColumn(second.mesh.vertexProperties, "sh_g_8"));
  second.transfer.error.clear();
  second.transfer.visibility.clear();
  second.sourceVertex.clear();
  second.facts.seed = 99;
  write(path, second);
  const BakedPly back = read(path);
  CHECK(plytest::difference(back.mesh, first.mesh) == "");
  CHECK(back.transfer.order == 2);
  CHECK(back.transfer.channels == 1);
  CHECK(back.transfer.error.empty());
  CHECK(back.transfer.visibility.empty());
  CHECK(back.sourceVertex.empty());
  CHECK(back.facts.seed == 99);
}

TEST_CASE("Baked PLY: corner normals give way to the normals of the points") {
  const plytest::Folder folder;
  BakedPly baked = openOctahedron(2, 1, Rgb(1, 1, 1));
  baked.mesh.cornerNormals.assign(24, Vec3f(1, 0, 0));
  write(folder.path("a.ply"), baked);
  const BakedPly back = read(folder.path("a.ply"));
  CHECK(back.mesh.cornerNormals.empty());
  CHECK(back.mesh.vertexNormals == baked.mesh.vertexNormals);
  CHECK(back.mesh.faceProperties.empty());
}

TEST_CASE("Baked PLY: Condon-Shortley phase is converted") {
  const plytest::Folder folder;
  const BakedPly baked = openOctahedron(4, 1, Rgb(1, 1, 1));
  BakedPly phased = baked;
  for (std::size_t i = 0; i < phased.transfer.coefficients.size(); ++i) {
    const int m = sh::orderOf(static_cast<int>(i % 16));
    phased.transfer.coefficients[i] *= m % 2 == 0 ? 1.0f : -1.0f;
  }
  const std::string path = folder.path("a.ply");
  write(path, phased, true);
  std::string bytes = plytest::readBytes(path);
  bytes.replace(bytes.find("condon_shortley=0"), 17, "condon_shortley=1");
  folder.write("a.ply", bytes);
  const BakedPly back = read(path);
  CHECK(back.transfer.coefficients == baked.transfer.coefficients);
  CHECK(back.transfer.coefficients != phased.transfer.coefficients);
  REQUIRE(back.notes.size() == 1);
  CHECK_THAT(back.notes[0], Catch::Contains("odd m change their sign"));
  CHECK(readBakedPlyInfo(path)->condonShortley);
}

TEST_CASE("Baked PLY: files of other programs") {
  const plytest::Folder folder;
  const auto foreign = [&](const std::string& comments, const std::string& properties, const std::string& values) {
    return read(folder.write("a.ply", pointFile(comments, properties, values)));
  };
  const BakedPly plain = foreign(
      "",
      "property float quality\nproperty double sh_3\nproperty double sh_1\nproperty double sh_0\nproperty float sh_2\n",
      "0.5 4 2 1 3");
  CHECK_FALSE(plain.stated);
  CHECK(plain.transfer.order == 2);
  CHECK(plain.transfer.channels == 1);
  CHECK(plain.transfer.coefficients == std::vector<float>{1, 2, 3, 4});
  CHECK(plain.transfer.visibility.empty());  // whose quality it is nobody says
  CHECK(findColumn(plain.mesh.vertexProperties, "quality"));
  REQUIRE(plain.notes.size() == 1);
  CHECK_THAT(plain.notes[0], Catch::Contains("no shbake comments"));

  const BakedPly partly =
      foreign("comment shbake order=2 channels=1\n", "property double quality\n" + kFour, "2.5 1 2 3 4");
  CHECK(partly.stated);
  CHECK(partly.transfer.visibility.empty());
  CHECK(scalarAt(*findColumn(partly.mesh.vertexProperties, "quality"), 0) == 2.5);
  REQUIRE(partly.notes.size() == 2);
  CHECK_THAT(partly.notes[0], Catch::Contains("does not state, so it is assumed: index"));
  CHECK_THAT(partly.notes[1], Catch::Contains("quality is not within 0..1"));

  const BakedPly odd =
      foreign("comment shbake order=2\n",
              "property int sh_error\nproperty float source_vertex\nproperty uchar quality\n" + kFour, "1 0 1 1 2 3 4");
  CHECK(odd.transfer.error.empty());
  CHECK(odd.sourceVertex.empty());
  CHECK(odd.mesh.vertexProperties.size() == 3);
  CHECK(odd.notes.size() == 4);
}

TEST_CASE("Baked PLY: contradictions in a file are named") {
  const plytest::Folder folder;
  const auto fault = [&](const std::string& comments, const std::string& properties, const std::string& values) {
    const std::string path = folder.write("a.ply", pointFile(comments, properties, values));
    const auto error = errorOf([&] { read(path); });
    REQUIRE(error);
    CHECK(error->kind == ErrorKind::work);
    CHECK(error->file == path);
    CHECK_FALSE(error->remedy.empty());
    return error->place + ": " + error->cause;
  };
  CHECK_THAT(fault("", "", ""), Catch::StartsWith("header: its vertices have no coefficients"));
  CHECK_THAT(fault("comment shbake order=3\n", kFour, "1 2 3 4"), Catch::Contains("sh_4 is missing: order=3"));
  CHECK_THAT(fault("comment shbake order=1\n", kFour, "1 2 3 4"),
             Catch::StartsWith("header field order: order=1 asks for 1"));
  CHECK_THAT(fault("comment shbake channels=3\n", kFour, "1 2 3 4"), Catch::StartsWith("header field channels"));
  CHECK_THAT(fault("comment shbake condon_shortley=2\n", kFour, "1 2 3 4"),
             Catch::StartsWith("header field condon_shortley"));
  CHECK_THAT(fault("comment shbake basis=hazel\n", kFour, "1 2 3 4"), Catch::StartsWith("header field basis: 'hazel'"));
  CHECK_THAT(fault("", kFour, "1 2 nan 4"), Catch::StartsWith("vertex 0: its sh_2 is not finite"));
  CHECK_THAT(fault("", kFour, "1 2 3 1e39"), Catch::StartsWith("vertex 0: its sh_3 is not finite"));
  CHECK_THAT(fault("", kFour + "property float sh_error\n", "1 2 3 4 -1"),
             Catch::StartsWith("vertex 0: its sh_error is not"));
  CHECK_THAT(fault("", kFour + "property float sh_error\n", "1 2 3 4 nan"),
             Catch::StartsWith("vertex 0: its sh_error is not"));
  CHECK_THAT(fault("", kFour + "property int source_vertex\n", "1 2 3 4 -2"),
             Catch::StartsWith("vertex 0: its source_vertex is -2"));
  CHECK_THAT(fault("comment shbake source_vertices=5\n", kFour + "property int source_vertex\n", "1 2 3 4 5"),
             Catch::StartsWith("vertex 0: its source_vertex is 5, but source_vertices=5"));
}

TEST_CASE("Baked PLY: what cannot be written is refused, and nothing appears") {
  const plytest::Folder folder;
  const auto refused = [&](auto change) {
    BakedPly baked = openOctahedron(2, 3, Rgb(1, 1, 1));
    baked.transfer.error.assign(6, 0);
    baked.transfer.visibility.assign(6, 1);
    baked.sourceVertex.assign(6, 0);
    change(baked);
    const auto error = errorOf([&] { write(folder.path("a.ply"), baked); });
    return error && error->kind == ErrorKind::usage && folder.files() == 0;
  };
  CHECK(refused([](BakedPly& b) { b.mesh.vertexNormals.clear(); }));
  CHECK(refused([](BakedPly& b) { b.transfer.coefficients.pop_back(); }));
  CHECK(refused([](BakedPly& b) { b.transfer.coefficients[7] = NAN; }));
  CHECK(refused([](BakedPly& b) { b.transfer.error.pop_back(); }));
  CHECK(refused([](BakedPly& b) { b.transfer.error[2] = INFINITY; }));
  CHECK(refused([](BakedPly& b) { b.transfer.visibility.pop_back(); }));
  CHECK(refused([](BakedPly& b) { b.transfer.visibility[1] = 1.5f; }));
  CHECK(refused([](BakedPly& b) { b.sourceVertex.pop_back(); }));
  CHECK(refused([](BakedPly& b) { b.sourceVertex[0] = 0x80000000u; }));
  CHECK(refused([](BakedPly& b) { b.transfer.order = 0; }));
  CHECK(refused([](BakedPly& b) { b.transfer.channels = 2; }));
}

TEST_CASE("Baked PLY: the header alone tells what a file is") {
  const plytest::Folder folder;
  BakedPly baked = openOctahedron(3, 3, Rgb(0.5f, 0.5f, 0.5f));
  baked.transfer.error.assign(6, 0);
  baked.facts.source = "octa hedron.obj";
  const std::string path = folder.path("a.ply");
  write(path, baked);
  CHECK(isBakedPly(path));
  const auto info = readBakedPlyInfo(path);
  REQUIRE(info);
  CHECK(info->order == 3);
  CHECK(info->channels == 3);
  CHECK(info->stated);
  CHECK(info->hasError);
  CHECK_FALSE(info->hasVisibility);
  CHECK_FALSE(info->hasSourceVertex);
  CHECK_FALSE(info->condonShortley);
  CHECK(info->facts.source == "octa hedron.obj");
  CHECK(info->facts.kind == TransferKind::unshadowed);
  CHECK(info->header.find("vertex")->count == 6);
  CHECK(info->header.find("face")->count == 8);
  CHECK(info->notes.empty());

  Progress progress;
  writePly(folder.path("mesh.ply"), baked.mesh, {}, progress);
  CHECK_FALSE(readBakedPlyInfo(folder.path("mesh.ply")));
  CHECK_FALSE(isBakedPly(folder.path("mesh.ply")));
  CHECK_FALSE(isBakedPly(folder.path("none.ply")));
  CHECK_FALSE(isBakedPly(folder.write("text.ply", "not a mesh\n")));
  CHECK_FALSE(isBakedPly(folder.write("gap.ply", pointFile("", "property float sh_1\n", "1"))));
  CHECK_FALSE(readBakedPlyInfo(folder.write("faces.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n")));
}

TEST_CASE("Baked PLY: damaged files give a bake or an Error") {
  const plytest::Folder folder;
  BakedPly baked = openOctahedron(2, 1, Rgb(0.5f, 0.5f, 0.5f));
  baked.transfer.error.assign(6, 0.25f);
  baked.transfer.visibility.assign(6, 1);
  baked.sourceVertex.assign(6, 0);
  baked.facts.sourceVertices = 6;
  std::size_t errors = 0, valid = 0;
  for (const bool ascii : {false, true}) {
    write(folder.path("a.ply"), baked, ascii);
    const std::string file = plytest::readBytes(folder.path("a.ply"));
    const auto tryReading = [&](const std::string& bytes) {
      const std::string path = folder.write("damaged.ply", bytes);
      const auto error = errorOf([&] {
        const BakedPly back = read(path);
        CHECK(back.transfer.size() == back.mesh.positions.size());
        for (const float t : back.transfer.coefficients) REQUIRE(std::isfinite(t));
        for (const std::uint32_t v : back.sourceVertex) REQUIRE((v == kNewVertex || v < 0x80000000u));
      });
      if (error) CHECK(error->file == path);
      ++(error ? errors : valid);
    };
    for (std::size_t size = 0; size < file.size(); size += 3) tryReading(file.substr(0, size));
    for (std::size_t at = 0; at < file.size(); ++at) {
      for (const int change : {1, 0x80}) {
        std::string damaged = file;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        tryReading(damaged);
      }
    }
  }
  CHECK(errors > 1000);
  CHECK(valid > 1000);
}
