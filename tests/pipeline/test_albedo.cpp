// Albedo: where it comes from, how colours are decoded, what is refused and what is clamped.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "pipeline/albedo.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

Mesh withVertexColors(Mesh mesh, Rgb color, ColorEncoding encoding) {
  mesh.vertexColors.assign(mesh.positions.size(), color);
  mesh.vertexColorEncoding = encoding;
  return mesh;
}

Error errorOf(const Mesh& mesh, const AlbedoOptions& options) {
  try {
    resolveAlbedo(mesh, options);
  } catch (const Error& error) {
    return error;
  }
  FAIL("no Error was thrown");
  return Error({});
}

}  // namespace

TEST_CASE("a mesh without colours takes the uniform albedo", "[albedo]") {
  const ResolvedAlbedo grey = resolveAlbedo(shapes::cube(), {});
  CHECK(grey.albedo.per == Albedo::Per::mesh);
  CHECK(grey.albedo.values == std::vector<Rgb>{{0.8f, 0.8f, 0.8f}});
  CHECK(grey.note == "uniform 0.8");
  CHECK(grey.warnings.empty());
  CHECK(resolveAlbedo(shapes::cube(), {.uniform = {1, 0.5f, 0}}).note == "uniform 1,0.5,0");
}

TEST_CASE("the file's colours win over the uniform albedo, faces over vertices", "[albedo]") {
  const Mesh vertices = withVertexColors(shapes::cube(), {0.1f, 0.2f, 0.3f}, ColorEncoding::linear);
  const ResolvedAlbedo byVertex = resolveAlbedo(vertices, {});
  CHECK(byVertex.albedo.per == Albedo::Per::vertex);
  CHECK(byVertex.albedo.values == std::vector<Rgb>(8, {0.1f, 0.2f, 0.3f}));
  const Mesh both = shapes::colored(vertices, {0.4f, 0.5f, 0.6f});
  const ResolvedAlbedo byFace = resolveAlbedo(both, {});
  CHECK(byFace.albedo.per == Albedo::Per::face);
  CHECK(byFace.albedo.values == std::vector<Rgb>(12, {0.4f, 0.5f, 0.6f}));
  CHECK(resolveAlbedo(both, {.source = AlbedoSource::vertex}).albedo.per == Albedo::Per::vertex);
  CHECK(resolveAlbedo(both, {.source = AlbedoSource::uniform}).albedo.per == Albedo::Per::mesh);
}

TEST_CASE("8-bit colours are decoded from sRGB, floats are linear, and the note says so", "[albedo]") {
  // IEC 61966-2-1: 0.5 decodes to ((0.5 + 0.055) / 1.055)^2.4, 0.04 to 0.04 / 12.92.
  const double half = std::pow((0.5 + 0.055) / 1.055, 2.4), dark = 0.04 / 12.92;
  const Mesh bytes = withVertexColors(shapes::cube(), {0.5f, 0.04f, 1}, ColorEncoding::srgb);
  const ResolvedAlbedo decoded = resolveAlbedo(bytes, {});
  // Powers of floats are good to a few half ulps.
  CHECK(double(decoded.albedo.values[0].x) == Approx(half).epsilon(4e-7));
  CHECK(double(decoded.albedo.values[0].y) == Approx(dark).epsilon(4e-7));
  CHECK(decoded.albedo.values[0].z == 1);
  CHECK(decoded.note == "vertex colours, 8-bit sRGB decoded to linear");
  const ResolvedAlbedo taken = resolveAlbedo(bytes, {.bytesAreLinear = true});
  CHECK(taken.albedo.values[0] == Rgb(0.5f, 0.04f, 1));
  CHECK(taken.note == "vertex colours, 8-bit taken as linear");
  const ResolvedAlbedo floats = resolveAlbedo(shapes::colored(shapes::cube(), {0.5f, 0.04f, 1}), {});
  CHECK(floats.albedo.values[0] == Rgb(0.5f, 0.04f, 1));
  CHECK(floats.note == "face colours, floats taken as linear");
}

TEST_CASE("colours outside 0..1 are clamped with a warning that counts them", "[albedo]") {
  Mesh mesh = withVertexColors(shapes::cube(), {0.5f, 0.5f, 0.5f}, ColorEncoding::linear);
  mesh.vertexColors[1] = {2, -1, 0.5f};
  mesh.vertexColors[4] = {std::numeric_limits<float>::quiet_NaN(), 0, std::numeric_limits<float>::infinity()};
  const ResolvedAlbedo resolved = resolveAlbedo(mesh, {});
  CHECK(resolved.albedo.values[1] == Rgb(1, 0, 0.5f));
  CHECK(resolved.albedo.values[4] == Rgb(0, 0, 1));
  REQUIRE(resolved.warnings.size() == 1);
  CHECK(resolved.warnings[0].substr(0, 2) == "2 ");
}

TEST_CASE("what cannot be used is refused", "[albedo]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Rgb& c : {Rgb(1.01f, 0, 0), Rgb(0, -0.01f, 0), Rgb(0, 0, nan)}) {
    CHECK(errorOf(shapes::cube(), {.uniform = c}).kind() == ErrorKind::usage);
  }
  for (const auto source : {AlbedoSource::vertex, AlbedoSource::face}) {
    const Error error = errorOf(shapes::cube(), {.source = source});
    CHECK(error.kind() == ErrorKind::work);
    CHECK(error.parts().file == "cube");
    CHECK_THAT(error.what(), Catch::Contains(source == AlbedoSource::vertex ? "vertex" : "face"));
  }
}
