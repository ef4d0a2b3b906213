// How many vertices of a mesh get the wrong light.
#include "stability/sky_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "base/hash.h"
#include "sh/irradiance.h"
#include "sh/local_frame.h"
#include "stability/sky_oracle.h"

namespace shbake::stability {
namespace {

constexpr int kOrder = 3, kCoefficients = kOrder * kOrder;
constexpr int kBakedRays = 4096;
/// Of the oracle and the naive baker. Their lattice errs like the bake's, by about 0.4 % of an open point's transfer:
/// a fifth of what counts as wrong.
constexpr int kDirections = 2048;
constexpr std::uint64_t kSeed = 20240229;

Mesh placed(const Mesh& mesh, const Placement& p) {
  return shapes::translated(shapes::scaled(shapes::rotated(mesh, p.rotation), p.scale), p.offset);
}

Vec3d turnedBack(const Vec3d& v, const shapes::Matrix3& r) {
  return r[0] * v.x + r[1] * v.y + r[2] * v.z;
}

/// Directions distributed by cosine about a normal: a Fibonacci lattice, turned by a random angle.
std::vector<Vec3d> directionsAbout(const Vec3d& normal, std::uint64_t vertex) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  const sh::LocalFrame frame = sh::localFrame(normal, 2 * std::numbers::pi * hashUnit(kSeed, vertex));
  std::vector<Vec3d> directions(kDirections);
  for (int k = 0; k < kDirections; ++k) {
    const double s = (k + 0.5) / kDirections, r = std::sqrt(s), phi = golden * k;
    directions[static_cast<std::size_t>(k)] =
        frame.x * (r * std::cos(phi)) + frame.y * (r * std::sin(phi)) + frame.z * std::sqrt(1 - s);
  }
  return directions;
}

/// The naive baker.
class NaiveSky {
 public:
  NaiveSky(const Mesh& mesh, SelfHits rule) : mesh_(mesh), rule_(rule) {
    Vec3f low(1e30f, 1e30f, 1e30f), high(-low);
    for (const Vec3d& p : mesh.positions) {
      positions_.emplace_back(p);
      const Vec3f& q = positions_.back();
      low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
      high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
    }
    epsilon_ = 1e-4f * (rule == SelfHits::nearOnesByUnit ? 1 : length(high - low));
  }

  bool seesSky(std::uint32_t vertex, const Vec3f& normal, const Vec3f& d) const {
    const Vec3f origin = positions_[vertex] + normal * (rule_ == SelfHits::originMoved ? epsilon_ : 0.0f);
    const bool far = rule_ == SelfHits::nearOnes || rule_ == SelfHits::nearOnesByUnit;
    const float least = far ? epsilon_ : 0.0f;
    for (const Triangle& t : mesh_.triangles) {
      if (rule_ == SelfHits::facesOfVertex && std::find(t.begin(), t.end(), vertex) != t.end()) continue;
      if (hits(origin, d, t, least)) return false;
    }
    return true;
  }

 private:
  bool hits(const Vec3f& origin, const Vec3f& d, const Triangle& t, float least) const {
    const Vec3f& a = positions_[t[0]];
    const Vec3f ab = positions_[t[1]] - a, ac = positions_[t[2]] - a, p = cross(d, ac), s = origin - a;
    const float det = dot(ab, p), u = dot(s, p) / det;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3f q = cross(s, ab);
    const float v = dot(d, q) / det;
    return v >= 0 && u + v <= 1 && dot(ac, q) / det > least;
  }

  const Mesh& mesh_;
  SelfHits rule_;
  std::vector<Vec3f> positions_;
  float epsilon_ = 0;
};

/// Transfer of albedo 1 summed over directions.
struct Sum {
  std::array<double, kCoefficients> values{};
};

template <class SeesSky>
Sum sumOver(const std::vector<Vec3d>& directions, const SeesSky& seesSky) {
  Sum sum;
  std::array<double, kCoefficients> y{};
  for (const Vec3d& d : directions) {
    if (!seesSky(d)) continue;
    sh::evaluate(kOrder, d, y);
    for (std::size_t i = 0; i < y.size(); ++i) sum.values[i] += y[i] / kDirections;
  }
  return sum;
}

template <class Values>
bool isNoticeable(const Sum& truth, const Values& values) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    sum += std::pow(static_cast<double>(values[i]) - truth.values[i], 2);
  }
  // Written so that NaN counts as wrong.
  return !(std::sqrt(sum) <= kNoticeable * sh::unshadowedNorm(kOrder));
}

/// A bake, the exact geometry behind it and a naive baker of the same file.
struct Judged {
  const SkyCase& c;
  BakedMesh baked;
  SkyOracle oracle;
  NaiveSky naive;

  std::uint32_t fileVertex(std::uint32_t v) const { return baked.sourceVertex.empty() ? v : baked.sourceVertex[v]; }

  Outcome judge(std::uint32_t v) const {
    Outcome outcome;
    const Vec3d normal(baked.mesh.vertexNormals[v]);
    const std::vector<SkyOracle::Start> starts = oracle.startsAt(v, turnedBack(normal, c.placement.rotation));
    if (starts.empty() || normal == Vec3d()) return outcome;
    const std::vector<Vec3d> directions = directionsAbout(normal, v);
    const Sum guess =
        sumOver(directions, [&](const Vec3d& d) { return naive.seesSky(fileVertex(v), Vec3f(normal), Vec3f(d)); });
    bool ownIsWrong = true, naiveIsWrong = true;
    for (std::size_t i = 0; i < starts.size() && (ownIsWrong || naiveIsWrong); ++i) {
      const Sum truth = sumOver(
          directions, [&](const Vec3d& d) { return oracle.seesSky(starts[i], turnedBack(d, c.placement.rotation)); });
      naiveIsWrong = naiveIsWrong && isNoticeable(truth, guess.values);
      ownIsWrong = ownIsWrong && isNoticeable(truth, baked.transfer.at(v, 0));
    }
    outcome.naive.add(naiveIsWrong);
    outcome.own.add(ownIsWrong);
    return outcome;
  }
};

BakedMesh bake(const Mesh& mesh, const Bench& bench) {
  BakeMeshOptions options;
  options.albedo.uniform = {1, 1, 1};
  options.bake.kind = TransferKind::shadowed;
  options.bake.order = kOrder;
  options.bake.rays = kBakedRays;
  return bakeMesh(mesh, {}, options, bench.parallel, bench.progress);
}

SkyOracle oracleOf(const Mesh& exact, const BakedMesh& baked) {
  std::vector<Vec3d> positions = exact.positions;
  for (std::size_t v = positions.size(); v < baked.mesh.positions.size(); ++v) {
    positions.push_back(exact.positions[baked.sourceVertex[v]]);
  }
  return {std::move(positions), baked.mesh.triangles};
}

}  // namespace

Placement turned(int number) {
  if (number == 0) return {};
  const double k = number;
  return {.rotation = shapes::rotationAbout({1 + hashUnit(kSeed, 2 * number), k, 0.3 - k / 7}, 0.4 + 0.83 * k)};
}

Outcome judgeSky(const SkyCase& c, const Bench& bench) {
  const Mesh file = placed(c.mesh, c.placement);
  BakedMesh baked = bake(file, bench);
  SkyOracle oracle = oracleOf(c.mesh, baked);
  const Judged judged{c, std::move(baked), std::move(oracle), NaiveSky(file, c.naive)};
  const std::size_t all = judged.baked.mesh.positions.size();
  const std::size_t wanted = std::min(all, bench.brief ? c.vertices / 3 + 1 : c.vertices);
  std::vector<Outcome> outcomes(wanted);
  bench.parallel.forBlocks(wanted, 1, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      outcomes[i] = judged.judge(static_cast<std::uint32_t>(i * all / wanted));
    }
    bench.progress.advance(0);
  });
  Outcome sum;
  for (const Outcome& one : outcomes) sum += one;
  return sum;
}

Outcome judgeSkies(const std::vector<SkyCase>& cases, const Bench& bench) {
  Outcome sum;
  for (const SkyCase& c : cases) sum += judgeSky(c, bench);
  return sum;
}

}  // namespace shbake::stability
