// Comparing bakes: errors put in by hand come out as derived, whatever the scale, order, channels and matching.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "transfer/baked_examples.h"
#include "transfer/compare.h"

using namespace shbake;
using bakedtest::openOctahedron;
using plytest::errorOf;

namespace {

const Rgb kGrey(0.5f, 0.5f, 0.5f);

// Coefficients are floats near 1: sums of a few relative errors of 6e-8 stay below this.
constexpr double kFloat = 1e-6;

/// Adds `amount` times the unshadowed norm (times albedo) to one coefficient of a vertex.
void disturb(BakedPly& baked, std::size_t vertex, int channel, int coefficient, double amount, double albedo = 0.5) {
  const auto n = static_cast<std::size_t>(baked.transfer.order * baked.transfer.order);
  const double norm = sh::unshadowedNorm(baked.transfer.order) * albedo;
  baked.transfer.coefficients[vertex * baked.transfer.stride() + static_cast<std::size_t>(channel) * n +
                              static_cast<std::size_t>(coefficient)] += static_cast<float>(amount * norm);
}

TransferComparison compared(const BakedPly& a, const BakedPly& b) {
  Progress progress;
  return compareTransfer(a, b, progress);
}

bool anyNote(const TransferComparison& c, const std::string& text) {
  for (const std::string& note : c.notes) {
    if (note.find(text) != note.npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("Compare: a bake with itself") {
  for (const int channels : {1, 3}) {
    const BakedPly baked = openOctahedron(4, channels, kGrey);
    const TransferComparison c = compared(baked, baked);
    CHECK(c.rmsError == 0);
    CHECK(c.worstError == 0);
    CHECK(c.matched == 6);
    CHECK(c.unmatchedA == 0);
    CHECK(c.unmatchedB == 0);
    CHECK(c.black == 0);
    CHECK(c.order == 4);
    CHECK(c.channels == channels);
    CHECK(c.errors == std::vector<float>(6, 0));
    CHECK(c.notes.empty());
    CHECK(c.statedRmsA == 0.0);  // what the header states
    CHECK_FALSE(c.shareBeyondStated);
  }
}

TEST_CASE("Compare: the error is relative to the unshadowed transfer with the same albedo") {
  const BakedPly b = openOctahedron(3, 1, kGrey);
  BakedPly a = b;
  disturb(a, 2, 0, 4, 0.1);
  const TransferComparison c = compared(a, b);
  CHECK(c.worstError == Approx(0.1).epsilon(kFloat));
  CHECK(c.worstVertex == 2);
  CHECK(c.worstPosition == Vec3d(0, 0, 1));
  CHECK(c.rmsError == Approx(0.1 / std::sqrt(6.0)).epsilon(kFloat));  // six vertices of the same area
  CHECK(c.errors[2] == Approx(0.1).epsilon(kFloat));
  CHECK(c.errors[0] == 0);
}

TEST_CASE("Compare: channels count together") {
  const Rgb albedo(0.8f, 0.4f, 0.2f);
  const BakedPly b = openOctahedron(3, 3, albedo);
  BakedPly a = b;
  disturb(a, 0, 1, 5, 0.1, 1);
  disturb(a, 0, 2, 6, 0.2, 1);
  const double expected = std::hypot(0.1, 0.2) / std::sqrt(0.8 * 0.8 + 0.4 * 0.4 + 0.2 * 0.2);
  CHECK(compared(a, b).worstError == Approx(expected).epsilon(kFloat));
}

TEST_CASE("Compare: the mean weighs vertices by their area") {
  // Two triangles apart, one with four times the area of the other; one corner of each is wrong.
  BakedPly b;
  b.mesh.source = "b.ply";
  b.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {7, 0, 0}, {5, 2, 0}};
  b.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  b.mesh.vertexNormals.assign(6, Vec3f(0, 0, 1));
  b.transfer.order = 1;
  const auto open = static_cast<float>(0.5 * sh::unshadowedNorm(1));
  b.transfer.coefficients.assign(6, open);
  b.facts.albedo = {true, AlbedoOrigin::uniform, kGrey, false};
  BakedPly a = b;
  a.transfer.coefficients[0] = open * 1.3f;
  a.transfer.coefficients[4] = open * 0.9f;
  const TransferComparison c = compared(a, b);
  // Areas 0.5 and 2, a third to each corner: (0.5 * 0.3^2 + 2 * 0.1^2) / (3 * 2.5).
  CHECK(c.rmsError == Approx(std::sqrt((0.5 * 0.09 + 2 * 0.01) / 7.5)).epsilon(1e-5));
  CHECK(c.worstVertex == 0);
  CHECK(c.worstError == Approx(0.3).epsilon(1e-5));

  SECTION("and a vertex stands for all its faces") {
    // A square of two triangles: corners 0 and 2 have both, 1 and 3 one of them.
    for (BakedPly* square : {&a, &b}) {
      square->mesh.positions.resize(4);
      square->mesh.positions[2] = {1, 1, 0};
      square->mesh.positions[3] = {0, 1, 0};
      square->mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
      square->mesh.vertexNormals.resize(4);
      square->transfer.coefficients.assign(4, open);
    }
    a.transfer.coefficients = {open * 1.2f, open * 1.1f, open, open};
    CHECK(compared(a, b).rmsError == Approx(std::sqrt((2 * 0.04 + 0.01) / 6)).epsilon(1e-5));
  }
  SECTION("and is the same at any scale and place") {
    for (const double scale : {1e-6, 1e6}) {
      BakedPly movedA = a, movedB = b;
      for (BakedPly* moved : {&movedA, &movedB}) {
        for (Vec3d& p : moved->mesh.positions) p = (p + Vec3d(1e3, -1e3, 0)) * scale;
      }
      const TransferComparison moved = compared(movedA, movedB);
      CHECK(moved.rmsError == Approx(c.rmsError).epsilon(1e-9));
      CHECK(moved.matched == 6);
    }
  }
  SECTION("faces without area leave equal weights") {
    for (BakedPly* flat : {&a, &b}) {
      for (Vec3d& p : flat->mesh.positions) p.y = 0;
    }
    CHECK(compared(a, b).rmsError == Approx(std::sqrt((0.09 + 0.01) / 6)).epsilon(1e-5));
  }
  SECTION("as do clouds of points") {
    a.mesh.triangles.clear();
    b.mesh.triangles.clear();
    CHECK(compared(a, b).rmsError == Approx(std::sqrt((0.09 + 0.01) / 6)).epsilon(1e-5));
  }
}

TEST_CASE("Compare: the order of vertices does not matter, and what has no partner is counted") {
  const BakedPly b = openOctahedron(3, 1, kGrey);
  BakedPly a = b;
  // A has its vertices reversed, one of them moved away, one turned, and a seventh that no face uses.
  const auto n = static_cast<std::ptrdiff_t>(9);
  for (std::size_t v = 0; v < 6; ++v) {
    a.mesh.positions[v] = b.mesh.positions[5 - v];
    a.mesh.vertexNormals[v] = b.mesh.vertexNormals[5 - v];
    std::copy_n(b.transfer.coefficients.begin() + static_cast<std::ptrdiff_t>(5 - v) * n, n,
                a.transfer.coefficients.begin() + static_cast<std::ptrdiff_t>(v) * n);
  }
  for (Triangle& t : a.mesh.triangles) {
    for (std::uint32_t& v : t) v = 5 - v;
  }
  CHECK(compared(a, b).rmsError == 0);
  CHECK(compared(a, b).matched == 6);
  a.mesh.positions[0].z -= 1e-4;
  a.mesh.vertexNormals[1] = Vec3f(0, -1, 1e-3f);
  a.mesh.positions.push_back({0, 0, 0});
  a.mesh.vertexNormals.push_back({0, 0, 1});
  a.transfer.coefficients.resize(63);
  const TransferComparison c = compared(a, b);
  CHECK(c.matched == 4);
  CHECK(c.unmatchedA == 2);
  CHECK(c.unmatchedB == 2);
  CHECK(std::isnan(c.errors[0]));
  CHECK(std::isnan(c.errors[6]));
  CHECK(c.rmsError == 0);
  CHECK(c.matchDistance == Approx(2e-6));
}

TEST_CASE("Compare: different orders meet on the bands that both have") {
  const BakedPly b = openOctahedron(5, 1, kGrey);
  BakedPly a = openOctahedron(3, 1, kGrey);
  const TransferComparison same = compared(a, b);
  CHECK(same.order == 3);
  CHECK(same.rmsError < 1e-7);
  CHECK(anyNote(same, "orders are 3 and 5"));
  disturb(a, 1, 0, 8, 0.2);
  CHECK(compared(a, b).worstError == Approx(0.2).epsilon(kFloat));
  CHECK(compared(b, a).worstError == Approx(0.2).epsilon(kFloat));
}

TEST_CASE("Compare: one channel stands for three") {
  const BakedPly grey = openOctahedron(3, 1, kGrey), colored = openOctahedron(3, 3, kGrey);
  for (const bool turned : {false, true}) {
    const TransferComparison c = turned ? compared(grey, colored) : compared(colored, grey);
    CHECK(c.channels == 3);
    CHECK(c.rmsError == 0);
    CHECK(anyNote(c, "one channel"));
  }
  BakedPly a = colored;
  disturb(a, 3, 2, 1, 0.3);
  CHECK(compared(a, grey).worstError == Approx(0.3 / std::sqrt(3.0)).epsilon(kFloat));
}

TEST_CASE("Compare: stated errors beside true ones") {
  BakedPly b = openOctahedron(2, 1, kGrey);
  BakedPly a = b;
  a.transfer.error = {0.01f, 0.02f, 0, 0.01f, 0, 0};
  disturb(a, 0, 0, 0, 0.029);   // within three times 0.01
  disturb(a, 1, 0, 0, -0.061);  // beyond three times 0.02
  disturb(a, 2, 0, 0, 0.001);   // stated as exact
  const TransferComparison c = compared(a, b);
  CHECK(c.statedRmsA == Approx(std::sqrt((1e-4 + 4e-4 + 1e-4) / 6)).epsilon(1e-5));
  CHECK(c.statedRmsB == 0.0);
  CHECK(c.shareBeyondStated == Approx(2.0 / 6));
  SECTION("the reference's own error counts in quadrature") {
    b.transfer.error = {0, 0.015f, 0.01f, 0, 0, 0};
    CHECK(compared(a, b).shareBeyondStated == 0.0);
    b.transfer.error = {0, 0.0f, 0.01f, 0, 0, 0};
    CHECK(compared(a, b).shareBeyondStated == Approx(1.0 / 6));
  }
  SECTION("rounding is no error") {
    BakedPly rounded = b;
    rounded.transfer.error.assign(6, 0);
    for (float& t : rounded.transfer.coefficients) t = std::nextafter(t, 2.0f);
    const TransferComparison r = compared(rounded, b);
    CHECK(r.worstError > 0);
    CHECK(r.shareBeyondStated == 0.0);
  }
  SECTION("files without sh_error state what their header does, or nothing") {
    b.facts.rmsError = 0.25;
    CHECK(compared(a, b).statedRmsB == 0.25);
    b.stated = false;
    CHECK_FALSE(compared(a, b).statedRmsB);
  }
}

TEST_CASE("Compare: where the albedo comes from") {
  const BakedPly b = openOctahedron(3, 1, kGrey);
  BakedPly a = b;
  disturb(a, 0, 0, 2, 0.1);
  BakedPly silentA = a, silentB = b;
  silentA.facts.albedo = silentB.facts.albedo = {};
  SECTION("from the other file") {
    const TransferComparison c = compared(a, silentB);
    CHECK(c.worstError == Approx(0.1).epsilon(kFloat));
    CHECK(anyNote(c, "relative to the albedo of octahedron.ply"));
  }
  SECTION("from the reference's brightest point, which here sees the whole sky") {
    for (std::size_t i = 9; i < 54; ++i) silentB.transfer.coefficients[i] *= 0.5f;
    silentA.transfer.coefficients = silentB.transfer.coefficients;
    disturb(silentA, 0, 0, 2, 0.1);
    const TransferComparison c = compared(silentA, silentB);
    CHECK(c.worstError == Approx(0.1).epsilon(kFloat));
    CHECK(anyNote(c, "neither file tells its albedo"));
  }
  SECTION("white where it is left out") {
    for (BakedPly* file : {&a, &silentB}) file->facts.albedo = {false, AlbedoOrigin::uniform, kGrey, false};
    CHECK(compared(a, silentB).worstError == Approx(0.05).epsilon(kFloat));
  }
  SECTION("black points have no relative error") {
    for (BakedPly* file : {&a, &silentB}) {
      file->facts.albedo = {true, AlbedoOrigin::vertexColors, {}, false};
      file->mesh.vertexColors.assign(6, kGrey);
      file->mesh.vertexColors[0] = Rgb(0, 0, 0);
    }
    const TransferComparison c = compared(a, silentB);
    CHECK(c.black == 1);
    CHECK(c.matched == 5);
    CHECK(c.worstError == 0);
    CHECK(std::isnan(c.errors[0]));
  }
}

TEST_CASE("Compare: different kinds of transfer are said") {
  const BakedPly b = openOctahedron(3, 1, kGrey);
  BakedPly a = b;
  a.facts.kind = TransferKind::interreflected;
  CHECK(anyNote(compared(a, b), "interreflected and unshadowed"));
}

TEST_CASE("Compare: what cannot be compared names the file") {
  const BakedPly b = openOctahedron(2, 1, kGrey);
  const auto fault = [&](auto change) {
    BakedPly a = b;
    a.mesh.source = "a.ply";
    change(a);
    const auto error = errorOf([&] { compared(a, b); });
    REQUIRE(error);
    CHECK_FALSE(error->remedy.empty());
    return error->file + ": " + error->cause;
  };
  CHECK_THAT(fault([](BakedPly& a) { a.mesh.vertexNormals.clear(); }), Catch::StartsWith("a.ply: has no normals"));
  CHECK_THAT(fault([](BakedPly& a) { a.facts.albedo.included = false; }),
             Catch::StartsWith("a.ply: differs from that of octahedron.ply"));
  CHECK_THAT(fault([](BakedPly& a) {
               for (Vec3d& p : a.mesh.positions) p.x += 1;
             }),
             Catch::StartsWith("a.ply: none of its lighting points"));
  BakedPly black = openOctahedron(2, 1, Rgb(0, 0, 0));
  CHECK_THAT(errorOf([&] { compared(black, black); })->cause, Catch::Contains("black wherever points match"));
  black.facts.albedo = {};
  CHECK_THAT(errorOf([&] { compared(black, black); })->cause, Catch::Contains("black wherever points match"));
}
