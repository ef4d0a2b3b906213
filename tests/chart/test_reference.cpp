// References and the file that keeps them: resumed, complete, damaged, of another mesh; cancelled without loss.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "chart/sweep/reference.h"
#include "chart/sweep/reference_cache.h"
#include "chart/sweep/transfer_error.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

const Deadline kLong(1000), kOver(0);

MadeReference make(Bench& bench, const ReferenceOptions& options, const Deadline& deadline = kLong) {
  return makeReference(bench.points, bench.bed.exact(), bench.all, options, deadline, Parallel(1), bench.progress);
}

std::string read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a reference is kept, and the next run takes it whole", "[reference]") {
  Folder folder;
  Bench bench(shapes::redFloorWhiteWall(6));
  const ReferenceOptions options{.order = 3, .rays = 256, .cache = folder.file("cache")};
  const MadeReference first = make(bench, options);
  CHECK(first.cache == CacheUse::fresh);
  CHECK(first.reference.points == bench.points.size());
  const MadeReference second = make(bench, options, kOver);
  CHECK(second.cache == CacheUse::complete);
  CHECK(second.reference.first == first.reference.first);
  CHECK(second.reference.second == first.reference.second);
  CHECK(folder.files() == 1);
  CHECK(make(bench, {.order = 3, .rays = 256, .cache = {}}).cache == CacheUse::none);
}

TEST_CASE("a reference that ran out of time goes on where it stopped", "[reference]") {
  Folder folder;
  Bench bench(shapes::redFloorWhiteWall(6));
  const ReferenceOptions options{.order = 3, .rays = 256, .cache = folder.file("cache")};
  const MadeReference begun = make(bench, options, kOver);
  REQUIRE(begun.reference.points < bench.points.size());
  CHECK(begun.reference.points > 0);
  const MadeReference rest = make(bench, options);
  CHECK(rest.cache == CacheUse::resumed);
  CHECK(rest.reference.points == bench.points.size());
  const MadeReference anew = make(bench, {.order = 3, .rays = 256, .cache = {}});
  CHECK(rest.reference.first == anew.reference.first);
  CHECK(rest.reference.second == anew.reference.second);
}

TEST_CASE("a damaged cache is found out and remade", "[reference]") {
  Folder folder;
  Bench bench(shapes::redFloorWhiteWall(4));
  const ReferenceOptions options{.order = 2, .rays = 256, .cache = folder.file("cache")};
  const MadeReference good = make(bench, options);
  const std::string bytes = read(options.cache);
  std::vector<std::string> damaged{"", "x", bytes.substr(0, 20), bytes.substr(0, bytes.size() - 1), bytes + "y"};
  for (std::size_t at = 0; at < bytes.size(); at += 97) {
    damaged.push_back(bytes);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 4);
  }
  for (const std::string& bad : damaged) {
    write(options.cache, bad);
    Reference untouched;
    untouched.order = 2;
    const CacheState state =
        readReferenceCache(options.cache, referenceKey(bench.points, bench.all, options), untouched);
    CHECK(state == CacheState::damaged);
    CHECK(untouched.first.empty());
  }
  const MadeReference remade = make(bench, options);
  CHECK(remade.cache == CacheUse::remade);
  CHECK(remade.reference.first == good.reference.first);
  CHECK(read(options.cache) == bytes);
}

TEST_CASE("a cache belongs to its mesh, sample and options", "[reference]") {
  Bench bench(shapes::redFloorWhiteWall(4)), moved(shapes::redFloorWhiteWall(5));
  const ReferenceOptions options{.order = 2, .rays = 256, .cache = "unused"};
  const ReferenceKey key = referenceKey(bench.points, bench.all, options);
  CHECK(referenceKey(bench.points, bench.all, {.order = 2, .rays = 256, .cache = "elsewhere"}) == key);
  CHECK(referenceKey(moved.points, bench.all, options) != key);
  CHECK(referenceKey(bench.points, std::span(bench.all).first(3), options) != key);
  CHECK(referenceKey(bench.points, bench.all, {.order = 3, .rays = 256, .cache = {}}) != key);
  CHECK(referenceKey(bench.points, bench.all, {.order = 2, .rays = 512, .cache = {}}) != key);
  LightingPoints bent = bench.points;
  bent.pointNormal[1] = {0, 0, 1};
  bent.pointNormal[2] = {1, 0, 0};
  CHECK(referenceKey(bent, bench.all, options) != key);
}

TEST_CASE("a cancelled reference keeps what it has, and no half file", "[reference]") {
  Folder folder;
  Bench bench(shapes::icosphere(3, 0.25));
  const ReferenceOptions options{.order = 3, .rays = 1024, .cache = folder.file("cache")};
  const double enough = 100.0 * (1024 + 960);  // rays of 100 points: in the fourth batch
  Progress stopped([&](const ProgressState& s) { return s.done < enough; }, Progress::Duration(0));
  CHECK_THROWS_AS(makeReference(bench.points, bench.bed.exact(), bench.all, options, kLong, Parallel(1), stopped),
                  Error);
  CHECK(folder.files() == 1);
  const MadeReference rest = make(bench, options);
  CHECK(rest.cache == CacheUse::resumed);
  CHECK(rest.reference.points == bench.points.size());
}

TEST_CASE("errors are freed from the reference's noise", "[reference]") {
  // References of few rays, judging an estimate of many: its own error is nothing beside theirs. What is measured then
  // scatters about zero, far below the references' noise, which a plain difference would show.
  Bench bench(shapes::icosphere(3, 0.25));
  const MadeReference coarse = make(bench, {.order = 3, .rays = 256, .cache = {}});
  const Estimate fine = bench.run(methodNamed("shbake"), 3, 1 << 14, 9);
  const TransferJudge judge(bench.points, bench.all, coarse.reference, 3, bench.points.size());
  const double noise = judge.referenceNoise();
  CHECK(noise > 1e-3);
  // The product of two independent noises of 642 points x 9 values has a standard deviation of about
  // 2 noise^2 / sqrt(642) where few of the nine carry it all.
  CHECK(std::abs(judge.squaredError(fine.transfer)) < 5 * 2 * noise * noise / std::sqrt(642.0));
}

TEST_CASE("the judge measures an error that is put in", "[reference]") {
  Bench bench(shapes::icosphere(2));  // convex: shbake and both references are exact
  const MadeReference exact = make(bench, {.order = 3, .rays = 256, .cache = {}});
  Estimate e = bench.run(methodNamed("shbake"), 3, 256, 1);
  const TransferJudge judge(bench.points, bench.all, exact.reference, 3, bench.points.size());
  for (float& t : e.transfer) t *= 0.9f;  // t - t* = -t* / 10
  CHECK(std::sqrt(judge.squaredError(e.transfer)) == Approx(0.1).epsilon(1e-5));
  CHECK(std::sqrt(judge.sharedError(e.transfer, e.transfer)) == Approx(0.1).epsilon(1e-5));
  CHECK(judge.referenceNoise() < 1e-6);
}
