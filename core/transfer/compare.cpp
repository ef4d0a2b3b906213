#include "transfer/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "sh/irradiance.h"
#include "transfer/baked_albedo.h"
#include "transfer/point_matcher.h"

namespace shbake {
namespace {

// Coefficients are stored as floats: relative differences below this are rounding, whatever error is stated.
constexpr double kRounding = 1e-6;

/// The area that each vertex stands for, a third of each of its faces; equal weights where faces have no area.
/// Vertices of no face get a negative weight. Two passes.
std::vector<double> areaWeights(const Mesh& mesh, Passes& passes) {
  if (mesh.triangles.empty()) return std::vector<double>(mesh.positions.size(), 1.0);
  std::vector<double> weights(mesh.positions.size(), -1);
  double total = 0;
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Vec3d& p = mesh.positions[a];
    const double area = length(cross(mesh.positions[b] - p, mesh.positions[c] - p)) / 2;
    for (const std::uint32_t v : {a, b, c}) weights[v] = std::max(weights[v], 0.0) + area / 3;
    total += area;
  });
  const bool equal = !(total > 0);
  passes.forEach(weights.size(), [&](std::size_t v) { weights[v] = equal && weights[v] >= 0 ? 1 : weights[v]; });
  return weights;
}

[[noreturn]] void fail(const BakedPly& file, std::string place, std::string cause, std::string remedy) {
  throw Error(
      {.file = file.mesh.source, .place = std::move(place), .cause = std::move(cause), .remedy = std::move(remedy)});
}

/// One pass.
std::optional<double> statedRms(const BakedPly& baked, const std::vector<double>& weights, Passes& passes) {
  double sum = 0, total = 0;
  passes.forEach(baked.transfer.error.size(), [&](std::size_t v) {
    if (weights[v] <= 0) return;
    sum += weights[v] * baked.transfer.error[v] * baked.transfer.error[v];
    total += weights[v];
  });
  if (total > 0) return std::sqrt(sum / total);
  if (baked.stated) return baked.facts.rmsError;
  return {};
}

class Comparer {
 public:
  Comparer(const BakedPly& a, const BakedPly& b, Progress& progress)
      : a_(a),
        b_(b),
        passes_(progress, "comparing", a.mesh.positions.size() + b.mesh.positions.size(), "vertices", kPasses),
        weightsA_(areaWeights(a.mesh, passes_)),
        weightsB_(areaWeights(b.mesh, passes_)) {}

  TransferComparison compare() {
    requireComparable();
    result_.order = std::min(a_.transfer.order, b_.transfer.order);
    result_.channels = std::max(a_.transfer.channels, b_.transfer.channels);
    result_.statedRmsA = statedRms(a_, weightsA_, passes_);
    result_.statedRmsB = statedRms(b_, weightsB_, passes_);
    noteTerms();
    matchPoints();
    chooseAlbedo();
    measure();
    passes_.end();
    return std::move(result_);
  }

 private:
  // Weights 4, stated errors 2, points 4, partners 2, differences 1.
  static constexpr int kPasses = 13;

  void requireComparable() const {
    for (const BakedPly* file : {&a_, &b_}) {
      if (file->mesh.vertexNormals.size() != file->mesh.positions.size()) {
        fail(*file, "", "has no normals, by which points are matched", "bake the mesh anew");
      }
    }
    if (a_.facts.albedo.included != b_.facts.albedo.included) {
      fail(a_, "header field albedo", "differs from that of " + b_.mesh.source + ": included against separate",
           "bake both in the same way");
    }
  }

  void noteTerms() {
    std::vector<std::string>& notes = result_.notes;
    if (a_.transfer.order != b_.transfer.order) {
      notes.push_back("the orders are " + std::to_string(a_.transfer.order) + " and " +
                      std::to_string(b_.transfer.order) + ": compared on the first " + std::to_string(result_.order) +
                      " bands, while stated errors are for all bands of their file");
    }
    if (a_.transfer.channels != b_.transfer.channels) {
      notes.push_back("one file has one channel, which is compared with each of the other's three");
    }
    if (a_.stated && b_.stated && a_.facts.kind != b_.facts.kind) {
      notes.push_back(std::string("the files hold different kinds of transfer, ") + transferName(a_.facts.kind) +
                      " and " + transferName(b_.facts.kind) + ": the errors show that difference too");
    }
  }

  void matchPoints() {
    const PointMatcher inB(b_.mesh.positions, b_.mesh.vertexNormals, passes_);
    const PointMatcher inA(a_.mesh.positions, a_.mesh.vertexNormals, passes_);
    result_.matchDistance = inB.distance();
    partner_.resize(a_.mesh.positions.size());
    passes_.forEach<std::uint32_t>(partner_.size(), [&](std::uint32_t v) {
      if (weightsA_[v] < 0) return;
      partner_[v] = inB.find(a_.mesh.positions[v], a_.mesh.vertexNormals[v], v);
      result_.unmatchedA += partner_[v] ? 0 : 1;
    });
    passes_.forEach<std::uint32_t>(b_.mesh.positions.size(), [&](std::uint32_t v) {
      if (weightsB_[v] < 0) return;
      result_.unmatchedB += inA.find(b_.mesh.positions[v], b_.mesh.vertexNormals[v], v) ? 0 : 1;
    });
    if (std::ranges::none_of(partner_, [](const auto& p) { return p.has_value(); })) {
      fail(a_, "", "none of its lighting points lies on one of " + b_.mesh.source,
           "compare bakes of the same mesh with the same normals");
    }
  }

  /// B's albedo by B's vertices, or A's by A's, or one for all.
  void chooseAlbedo() {
    if (auto albedo = bakedAlbedo(b_)) {
      albedo_ = std::move(*albedo);
      albedoOfB_ = true;
    } else if (auto other = bakedAlbedo(a_)) {
      albedo_ = std::move(*other);
      result_.notes.push_back("errors are relative to the albedo of " + a_.mesh.source +
                              ", since the reference tells none");
    } else {
      albedo_.assign(a_.mesh.positions.size(), brightest());
      result_.notes.push_back(
          "neither file tells its albedo: errors are relative to the brightest point of the reference under a white "
          "sky, "
          "which is the albedo if that is uniform and the point sees the whole sky");
    }
  }

  Rgb brightest() const {
    const TransferSet& t = b_.transfer;
    Rgb most;
    const float perRadiance = static_cast<float>(2 * std::sqrt(std::numbers::pi));  // 1 / y_00
    for (std::size_t v = 0; v < t.size(); ++v) {
      const auto sent = [&](int channel) { return t.at(v, t.channels == 3 ? channel : 0)[0] * perRadiance; };
      most = {std::max(most.x, sent(0)), std::max(most.y, sent(1)), std::max(most.z, sent(2))};
    }
    return most;
  }

  /// The norm of the unshadowed transfer of a vertex of A with its partner's albedo.
  double unshadowed(std::uint32_t v) const {
    const Vec3d rho(albedo_[albedoOfB_ ? *partner_[v] : v]);
    return norm_ * (result_.channels == 3 ? length(rho) : rho.x);
  }

  double difference(std::uint32_t v) const {
    double sum = 0;
    for (int channel = 0; channel < result_.channels; ++channel) {
      const auto a = a_.transfer.at(v, a_.transfer.channels == 3 ? channel : 0);
      const auto b = b_.transfer.at(*partner_[v], b_.transfer.channels == 3 ? channel : 0);
      for (std::size_t i = 0; i < static_cast<std::size_t>(result_.order * result_.order); ++i) {
        const double d = static_cast<double>(a[i]) - b[i];
        sum += d * d;
      }
    }
    return std::sqrt(sum);
  }

  /// Three times the stated standard error of the difference.
  double bound(std::uint32_t v) const {
    const double b = b_.transfer.error.empty() ? 0 : b_.transfer.error[*partner_[v]];
    return 3 * std::hypot(a_.transfer.error[v], b) + kRounding;
  }

  void measure() {
    norm_ = sh::unshadowedNorm(result_.order);
    result_.errors.assign(partner_.size(), std::numeric_limits<float>::quiet_NaN());
    double sum = 0, total = 0, plainSum = 0;
    std::size_t beyond = 0;
    result_.worstError = -1;
    passes_.forEach<std::uint32_t>(partner_.size(), [&](std::uint32_t v) {
      if (!partner_[v]) return;
      const double whole = unshadowed(v);
      if (!(whole > 0)) {
        ++result_.black;
        return;
      }
      const double error = difference(v) / whole;
      ++result_.matched;
      result_.errors[v] = static_cast<float>(error);
      sum += weightsA_[v] * error * error;
      total += weightsA_[v];
      plainSum += error * error;
      if (!a_.transfer.error.empty()) beyond += error > bound(v) ? 1 : 0;
      if (error > result_.worstError) {
        result_.worstError = error;
        result_.worstVertex = v;
        result_.worstPosition = a_.mesh.positions[v];
      }
    });
    if (result_.matched == 0) {
      fail(b_, "", "its albedo is black wherever points match, so that no relative error exists",
           "compare lit surfaces");
    }
    // Where only corners of faces without area match, they weigh the same.
    const auto matched = static_cast<double>(result_.matched);
    result_.rmsError = std::sqrt(total > 0 ? sum / total : plainSum / matched);
    if (!a_.transfer.error.empty()) {
      result_.shareBeyondStated = static_cast<double>(beyond) / matched;
    }
  }

  const BakedPly& a_;
  const BakedPly& b_;
  Passes passes_;
  std::vector<double> weightsA_, weightsB_;
  std::vector<std::optional<std::uint32_t>> partner_;  // in B of each vertex of A
  std::vector<Rgb> albedo_;
  bool albedoOfB_ = false;  // albedo_ has B's vertices, else A's
  double norm_ = 0;         // of an unshadowed transfer with albedo 1
  TransferComparison result_;
};

}  // namespace

TransferComparison compareTransfer(const BakedPly& a, const BakedPly& b, Progress& progress) {
  return Comparer(a, b, progress).compare();
}

}  // namespace shbake
