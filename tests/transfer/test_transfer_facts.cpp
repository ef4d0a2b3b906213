// Facts in headers: the text exactly as the conventions state it, every fact read back, every contradiction named.
#include <catch2/catch.hpp>
#include <limits>

#include "mesh/test_ply_files.h"
#include "transfer/transfer_facts.h"

using namespace shbake;
using plytest::errorOf;

namespace {

TransferFacts example() {
  TransferFacts facts;
  facts.version = "1.2.3";
  facts.kind = TransferKind::shadowed;
  facts.bounces = 3;
  facts.bouncesConverged = true;
  facts.rays = 1024;
  facts.seed = std::numeric_limits<std::uint64_t>::max();
  facts.sampler = "cosine-fibonacci";
  facts.rmsError = 0.1 / 3;
  facts.maxError = 1e-300;
  facts.tolerance = 0.01;
  facts.lightingPoints = 34834;
  facts.sourceVertices = 34817;
  facts.source = "bunny.ply";
  return facts;
}

const std::vector<std::string> kMinimal = {
    "shbake order=3 channels=1 index=l*(l+1)+m basis=real-orthonormal condon_shortley=0",
    "shbake axes=as-file handed=right units=radiance_out_per_radiance_in albedo=included"};

/// The minimal comments and one more.
StatedFacts parseWith(const std::string& comment) {
  std::vector<std::string> comments = kMinimal;
  comments.push_back(comment);
  return parseFacts(comments, "a.ply");
}

}  // namespace

TEST_CASE("Transfer facts: the text of the conventions") {
  TransferFacts facts = example();
  CHECK(factComments(facts, 3, 3) ==
        std::vector<std::string>{
            "shbake version=1.2.3 transfer=shadowed bounces=3 bounces_converged=1",
            "shbake order=3 channels=3 index=l*(l+1)+m basis=real-orthonormal condon_shortley=0",
            "shbake axes=as-file handed=right units=radiance_out_per_radiance_in albedo=included",
            "shbake sampler=cosine-fibonacci rays=1024 seed=18446744073709551615 rms_error=0.03333333333333333 "
            "max_error=1e-300 tolerance=0.01",
            "shbake lighting_points=34834 source_vertices=34817 source=bunny.ply"});
  facts.albedo = {false, AlbedoOrigin::uniform, Rgb(0.8f, 0.5f, 0.25f), false};
  const auto uniform = factComments(facts, 3, 3);
  REQUIRE(uniform.size() == 6);
  CHECK(uniform[2] == "shbake axes=as-file handed=right units=radiance_out_per_radiance_in albedo=separate");
  CHECK(uniform[5] == "shbake albedo_from=uniform albedo_rgb=0.8,0.5,0.25");
  facts.albedo = {true, AlbedoOrigin::vertexColors, {}, false};
  CHECK(factComments(facts, 3, 3)[5] == "shbake albedo_from=vertex_colors albedo_bytes=srgb");
  facts.albedo = {true, AlbedoOrigin::faceColors, {}, true};
  CHECK(factComments(facts, 3, 3)[5] == "shbake albedo_from=face_colors albedo_bytes=linear");
}

TEST_CASE("Transfer facts: limits and the surface error are stated where there are any, and read back") {
  TransferFacts facts = example();
  facts.twoSided = true;
  CHECK(factComments(facts, 3, 3).back() == "shbake two_sided=1");
  facts.maxDistance = 0.1;
  facts.blockers = 2;
  CHECK(factComments(facts, 3, 3).back() == "shbake two_sided=1 max_distance=0.1 blockers=2");
  facts.surface = {1024, 2048, 0.1, 0.05, 1.0 / 3, 0.7, Vec3d(-1e300, 2.5, 0.1 + 0.2)};
  const std::vector<std::string> comments = factComments(facts, 3, 3);
  REQUIRE(comments.size() == 7);
  CHECK(comments[6] ==
        "shbake surface_samples=1024 surface_rays=2048 surface_rms=0.1 surface_low=0.05 "
        "surface_high=0.3333333333333333 surface_worst=0.7 surface_worst_at=-1e+300,2.5,0.30000000000000004");
  const StatedFacts stated = parseFacts(comments, "a.ply");
  CHECK(stated.notes.empty());
  CHECK(stated.facts.twoSided);
  CHECK(stated.facts.maxDistance == 0.1);
  CHECK(stated.facts.blockers == 2);
  CHECK(stated.facts.surface == facts.surface);
  facts.fit = {3000, 12, 0.5, 0.25};
  const std::vector<std::string> fitted = factComments(facts, 3, 3);
  REQUIRE(fitted.size() == 8);
  CHECK(fitted[6] == "shbake fit=surface fit_points=3000 fit_smoothed=12 fit_error_before=0.5 fit_error_after=0.25");
  CHECK(parseFacts(fitted, "a.ply").facts.fit == facts.fit);
  facts.fit.fittedPoints = 0;
  CHECK(factComments(facts, 3, 3)[6].starts_with("shbake fit=smoothed fit_points=0 fit_smoothed=12 "));
  CHECK(parseFacts(factComments(facts, 3, 3), "a.ply").facts.fit == facts.fit);
  CHECK(parseWith("shbake fit=vertex").facts.fit == FitFacts());
  const TransferFacts silent = parseFacts(factComments(example(), 3, 3), "a.ply").facts;
  CHECK_FALSE(silent.twoSided);
  CHECK(silent.maxDistance == std::numeric_limits<double>::infinity());
  CHECK(silent.blockers == 0);
  CHECK(silent.fit == FitFacts());
  CHECK(silent.surface == SurfaceError());
}

TEST_CASE("Transfer facts: every fact is read back") {
  TransferFacts facts = example();
  for (const char* source :
       {"bunny.ply", "", "my bunny.ply", "100%.ply", "%41", "a=b c", "tab\tnew\nline\x7f", "grün.ply", "%"}) {
    for (const TransferKind kind : {TransferKind::unshadowed, TransferKind::shadowed, TransferKind::interreflected}) {
      for (const AlbedoFacts albedo : {AlbedoFacts{},
                                       {false, AlbedoOrigin::unknown, {}, false},
                                       {true, AlbedoOrigin::uniform, Rgb(0.1f, 1, 0), false},
                                       {true, AlbedoOrigin::vertexColors, {}, true},
                                       {true, AlbedoOrigin::faceColors, {}, false}}) {
        facts.source = source;
        facts.kind = kind;
        facts.albedo = albedo;
        std::vector<std::string> comments = factComments(facts, 7, 1);
        for (const std::string& c : comments) CHECK(c.find_first_of("\n\r\t") == c.npos);
        comments.insert(comments.begin(), "made by hand");
        const StatedFacts stated = parseFacts(comments, "a.ply");
        CHECK(stated.any);
        CHECK(stated.notes.empty());
        CHECK(stated.order == 7);
        CHECK(stated.channels == 1);
        CHECK_FALSE(stated.condonShortley);
        const TransferFacts& back = stated.facts;
        CHECK(back.version == facts.version);
        CHECK(back.kind == facts.kind);
        CHECK(back.bounces == facts.bounces);
        CHECK(back.bouncesConverged == facts.bouncesConverged);
        CHECK(back.rays == facts.rays);
        CHECK(back.seed == facts.seed);
        CHECK(back.sampler == facts.sampler);
        CHECK(back.rmsError == facts.rmsError);
        CHECK(back.maxError == facts.maxError);
        CHECK(back.tolerance == facts.tolerance);
        CHECK(back.lightingPoints == facts.lightingPoints);
        CHECK(back.sourceVertices == facts.sourceVertices);
        CHECK(back.source == facts.source);
        CHECK(back.albedo.included == albedo.included);
        CHECK(back.albedo.origin == albedo.origin);
        CHECK(back.albedo.uniform == albedo.uniform);
        CHECK(back.albedo.bytesAreLinear == albedo.bytesAreLinear);
        CHECK(factComments(back, 7, 1) == factComments(facts, 7, 1));
      }
    }
  }
}

TEST_CASE("Transfer facts: what counts as a comment of facts") {
  CHECK(isFactComment("shbake order=3"));
  CHECK(isFactComment("shbake  order=3 words"));
  for (const char* other : {"", "shbake", "shbake ", "shbake is quick", "shbake is a=b", "shbaked order=3",
                            " shbake order=3", "VCGLIB a=b"}) {
    INFO(other);
    CHECK_FALSE(isFactComment(other));
  }
}

TEST_CASE("Transfer facts: without comments the assumptions are said") {
  const StatedFacts stated = parseFacts({"VCGLIB generated", "shbake is quick"}, "a.ply");
  CHECK_FALSE(stated.any);
  CHECK_FALSE(stated.order);
  CHECK_FALSE(stated.channels);
  REQUIRE(stated.notes.size() == 1);
  CHECK_THAT(stated.notes[0],
             Catch::Contains("no shbake comments") && Catch::Contains("without Condon-Shortley phase"));
}

TEST_CASE("Transfer facts: facts that are missing or not known are noted") {
  const StatedFacts bare = parseFacts({"shbake order=2 handed=right future=1 also=2"}, "a.ply");
  REQUIRE(bare.notes.size() == 2);
  CHECK_THAT(bare.notes[0], Catch::EndsWith("index=l*(l+1)+m, basis=real-orthonormal, axes=as-file, "
                                            "units=radiance_out_per_radiance_in, condon_shortley=0"));
  CHECK_THAT(bare.notes[1], Catch::EndsWith("ignored: also, future"));
  CHECK(parseFacts(kMinimal, "a.ply").notes.empty());
}

TEST_CASE("Transfer facts: Condon-Shortley phase is stated as 0 or 1") {
  CHECK(parseFacts({"shbake condon_shortley=1"}, "a.ply").condonShortley);
  CHECK_FALSE(parseFacts({"shbake condon_shortley=0"}, "a.ply").condonShortley);
}

TEST_CASE("Transfer facts: the same fact may stand twice, two different ones may not") {
  CHECK(parseWith("shbake order=3").order == 3);
  CHECK_THAT(errorOf([] { parseWith("shbake order=4"); })->cause, Catch::Contains("stated as '3' and as '4'"));
}

TEST_CASE("Transfer facts: faults name their field") {
  struct Fault {
    std::string field, value;
  };
  const std::vector<Fault> faults = {{"transfer", "shiny"},
                                     {"transfer", "Shadowed"},
                                     {"bounces", "-1"},
                                     {"bounces", "2.5"},
                                     {"bounces", "3x"},
                                     {"bounces", ""},
                                     {"bounces", "9999999999"},
                                     {"bounces_converged", "2"},
                                     {"rays", "-5"},
                                     {"seed", "-1"},
                                     {"seed", "18446744073709551616"},
                                     {"rms_error", "-0.1"},
                                     {"rms_error", "nan"},
                                     {"rms_error", "inf"},
                                     {"max_error", "1e999"},
                                     {"tolerance", "0,01"},
                                     {"two_sided", "yes"},
                                     {"max_distance", "0"},
                                     {"max_distance", "inf"},
                                     {"blockers", "-1"},
                                     {"surface_samples", "many"},
                                     {"surface_rays", "-1"},
                                     {"surface_rms", "-0.1"},
                                     {"surface_low", "nan"},
                                     {"surface_high", "inf"},
                                     {"surface_worst", "x"},
                                     {"surface_worst_at", "1,2"},
                                     {"surface_worst_at", "1,2,nan"},
                                     {"lighting_points", "-1"},
                                     {"source_vertices", "x"},
                                     {"albedo_from", "texture"},
                                     {"albedo_bytes", "gamma"},
                                     {"albedo_rgb", "0.5"},
                                     {"albedo_rgb", "0.5,0.5"},
                                     {"albedo_rgb", "0.5,0.5,2"},
                                     {"albedo_rgb", "0.5,0.5,0.5,0.5"},
                                     {"albedo_rgb", "0.5;0.5;0.5"},
                                     {"albedo_rgb", "-1,0,0"}};
  for (const Fault& fault : faults) {
    INFO(fault.field << "=" << fault.value);
    const auto error = errorOf([&] { parseWith("shbake " + fault.field + "=" + fault.value); });
    REQUIRE(error);
    CHECK(error->kind == ErrorKind::work);
    CHECK(error->file == "a.ply");
    CHECK(error->place == "header field " + fault.field);
    CHECK_THAT(error->cause, Catch::Contains("'" + fault.value + "'"));
    CHECK_FALSE(error->remedy.empty());
  }
  // What the file's basis depends on cannot be repeated with another value, so each stands alone here.
  for (const Fault& fault : std::vector<Fault>{{"order", "0"},
                                               {"order", "-3"},
                                               {"order", "1001"},
                                               {"order", "three"},
                                               {"channels", "2"},
                                               {"channels", "4"},
                                               {"index", "l*l"},
                                               {"basis", "hazel"},
                                               {"basis", "complex"},
                                               {"condon_shortley", "yes"},
                                               {"axes", "y-up"},
                                               {"handed", "left"},
                                               {"units", "irradiance"},
                                               {"albedo", "maybe"}}) {
    INFO(fault.field << "=" << fault.value);
    const auto error = errorOf([&] { parseFacts({"shbake " + fault.field + "=" + fault.value}, "a.ply"); });
    REQUIRE(error);
    CHECK(error->place == "header field " + fault.field);
    CHECK_THAT(error->cause, Catch::Contains("'" + fault.value + "'"));
  }
  CHECK_THAT(errorOf([] { parseWith("shbake albedo_from=uniform"); })->cause, Catch::Contains("is missing"));
  CHECK(errorOf([] { parseWith("shbake rays=1 and more"); })->place == "header field and");
  CHECK(errorOf([] { parseWith("shbake rays=1 =2"); }));
}
