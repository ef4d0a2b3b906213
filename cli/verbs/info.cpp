// `shbake info`: what is in a mesh file, and in one that shbake has baked.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cli/describe_transfer.h"
#include "cli/format.h"
#include "cli/options.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

std::int64_t whole(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

/// Names joined by commas.
std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<std::string> namesOf(const std::vector<Property>& properties) {
  std::vector<std::string> names;
  for (const Property& p : properties) names.push_back(p.name);
  return names;
}

const char* describe(ColorEncoding encoding) {
  return encoding == ColorEncoding::srgb ? "8-bit, sRGB unless told otherwise" : "linear";
}

void reportBox(const Mesh& mesh, Report& report) {
  if (mesh.positions.empty()) return;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Vec3d& p : mesh.positions) {
    const std::array<double, 3> xyz{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], xyz[k]);
      high[k] = std::max(high[k], xyz[k]);
    }
  }
  const auto point = [](const std::array<double, 3>& v) {
    return "(" + formatNumber(v[0], 6) + ", " + formatNumber(v[1], 6) + ", " + formatNumber(v[2], 6) + ")";
  };
  report.data("mesh.box.low", std::vector<double>(low.begin(), low.end()));
  report.data("mesh.box.high", std::vector<double>(high.begin(), high.end()));
  report.line("box", point(low) + " to " + point(high));
}

void reportAttributes(const Mesh& mesh, Report& report) {
  std::vector<std::string> has;
  if (!mesh.vertexNormals.empty()) has.push_back("vertex normals");
  if (!mesh.cornerNormals.empty()) has.push_back("corner normals");
  if (!mesh.vertexColors.empty())
    has.push_back(std::string("vertex colours (") + describe(mesh.vertexColorEncoding) + ")");
  if (!mesh.faceColors.empty()) has.push_back(std::string("face colours (") + describe(mesh.faceColorEncoding) + ")");
  if (mesh.doublePositions) has.push_back("double-precision coordinates");
  report.fact("mesh.attributes", has, "attributes", has.empty() ? "none" : list(has));
  const std::vector<std::string> vertex = namesOf(mesh.vertexProperties), face = namesOf(mesh.faceProperties);
  report.data("mesh.vertex_properties", vertex);
  report.data("mesh.face_properties", face);
  if (!vertex.empty()) report.line("also", "of vertices: " + list(vertex));
  if (!face.empty()) report.line("also", "of faces: " + list(face));
  for (const PropertyElement& e : mesh.elements) {
    report.line("also", formatCount(e.count) + " x " + e.name + ": " + list(namesOf(e.properties)));
  }
}

void reportMesh(const Mesh& mesh, Progress& progress, Report& report) {
  report.data("mesh.vertices", whole(mesh.positions.size()));
  report.data("mesh.triangles", whole(mesh.triangles.size()));
  const MeshCheck check = checkMesh(mesh, progress);
  report.data("mesh.closed", check.closed());
  report.fact("mesh.parts", whole(check.parts), "mesh", describeShape(check));
  if (!mesh.sourcePolygons.empty()) {
    const std::size_t polygons =
        *std::max_element(mesh.sourcePolygons.begin(), mesh.sourcePolygons.end()) + std::size_t(1);
    report.fact("mesh.polygons", whole(polygons), "",
                formatCount(mesh.triangles.size()) + " triangles cut from " + formatCount(polygons) + " polygons");
  }
  reportBox(mesh, report);
  reportAttributes(mesh, report);
  const std::vector<std::string> findings = describeFindings(check);
  report.data("mesh.findings", findings);
  if (findings.empty()) report.line("check", "nothing found");
  for (std::size_t i = 0; i < findings.size(); ++i) report.line(i == 0 ? "check" : "", findings[i]);
}

/// The mean over points and channels of the squared coefficients of each degree: where the transfer's energy lies.
std::vector<double> energyPerBand(const TransferSet& set) {
  std::vector<double> energy(static_cast<std::size_t>(set.order), 0.0);
  for (std::size_t p = 0; p < set.size(); ++p) {
    for (int c = 0; c < set.channels; ++c) {
      const auto t = set.at(p, c);
      for (int l = 0; l < set.order; ++l) {
        for (int m = -l; m <= l; ++m) {
          const double v = t[static_cast<std::size_t>(l * (l + 1) + m)];
          energy[static_cast<std::size_t>(l)] += v * v;
        }
      }
    }
  }
  const double count = static_cast<double>(set.size()) * set.channels;
  for (double& e : energy) e /= std::max(count, 1.0);
  return energy;
}

/// The least and greatest value of band 0, which is the light of a constant sky, and of all others.
struct Ranges {
  double constantLow = std::numeric_limits<double>::infinity(), constantHigh = -constantLow;
  double restLow = 0, restHigh = 0;
};

Ranges valueRanges(const TransferSet& set) {
  Ranges r;
  for (std::size_t p = 0; p < set.size(); ++p) {
    for (int c = 0; c < set.channels; ++c) {
      const auto t = set.at(p, c);
      r.constantLow = std::min<double>(r.constantLow, t[0]);
      r.constantHigh = std::max<double>(r.constantHigh, t[0]);
      for (const float v : t.subspan(1)) {
        r.restLow = std::min<double>(r.restLow, v);
        r.restHigh = std::max<double>(r.restHigh, v);
      }
    }
  }
  return r;
}

std::string shortList(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : "  ") + formatNumber(v, 3);
  return text;
}

void reportValues(const TransferSet& set, Report& report) {
  if (set.size() == 0) return;
  const std::vector<double> energy = energyPerBand(set);
  report.fact("transfer.energy_per_band", energy, "energy",
              shortList(energy) + " (degrees 0 to " + std::to_string(set.order - 1) + ", mean of squares)");
  const Ranges r = valueRanges(set);
  report.data("transfer.constant_range", std::vector<double>{r.constantLow, r.constantHigh});
  report.data("transfer.other_range", std::vector<double>{r.restLow, r.restHigh});
  report.line(
      "values",
      "sh_0 " + formatNumber(r.constantLow, 4) + " to " + formatNumber(r.constantHigh, 4) +
          (set.order > 1 ? ", others " + formatNumber(r.restLow, 4) + " to " + formatNumber(r.restHigh, 4) : ""));
  if (!set.visibility.empty()) {
    const auto [low, high] = std::minmax_element(set.visibility.begin(), set.visibility.end());
    report.fact("transfer.visibility_range", std::vector<double>{*low, *high}, "sky",
                formatPercent(*low) + " to " + formatPercent(*high) + " seen");
  }
}

void reportTransfer(const BakedPly& baked, Report& report) {
  const TransferFacts& f = baked.facts;
  report.data("transfer.stated", baked.stated);
  if (baked.stated) {
    report.data("transfer.version", f.version);
    report.data("transfer.source", f.source);
    report.data("transfer.source_vertices", whole(f.sourceVertices));
    report.fact("transfer.points", whole(f.lightingPoints), "baked",
                "by shbake " + f.version + " from " + f.source + ": " + formatCount(f.lightingPoints) +
                    " lighting points of " + formatCount(f.sourceVertices) + " vertices");
  }
  describeTransfer(baked.transfer, baked.stated ? &f : nullptr, report);
  reportValues(baked.transfer, report);
  for (const std::string& note : baked.notes) report.line("note", note);
  report.data("transfer.notes", baked.notes);
}

/// Tells why a file with columns of coefficients is not taken as baked.
void warnOfContradiction(const std::string& file, const Mesh& mesh, Session& session) {
  const auto named = [](const Property& p) { return p.name.starts_with("sh_"); };
  if (std::none_of(mesh.vertexProperties.begin(), mesh.vertexProperties.end(), named)) return;
  try {
    readBakedPlyInfo(file);
  } catch (const Error& error) {
    session.warn(std::string("not taken as baked: ") + error.what());
  }
}

class Info : public Verb {
 public:
  void declare(CLI::App& app) override {
    addFile(app, "FILE", file_, "a mesh (PLY, OBJ, OFF, STL) or a baked PLY file");
  }
  void run(Session& session) override;

 private:
  std::string file_;
};

void Info::run(Session& session) {
  if (file_.empty()) throw usageError("no file is named", "usage: shbake info FILE");
  Report& report = session.report;
  report.data("file", file_);
  std::error_code none;
  const auto bytes = std::filesystem::file_size(file_, none);
  report.line("file", file_ + (none ? "" : ", " + formatBytes(static_cast<double>(bytes))));
  if (isBakedPly(file_)) {
    const BakedPly baked = readBakedPly(file_, session.progress);
    reportMesh(baked.mesh, session.progress, report);
    reportTransfer(baked, report);
    return;
  }
  const Mesh mesh = readMesh(file_, session.progress);
  session.display.finish();
  for (const std::string& sentence : mesh.warnings) session.warn(sentence);
  warnOfContradiction(file_, mesh, session);
  reportMesh(mesh, session.progress, report);
}

}  // namespace

extern const VerbEntry infoVerb;
const VerbEntry infoVerb{"info", "FILE", "tell what is in a mesh or a baked file",
                         "Tells what FILE holds: its size and shape, its attributes, what is wrong with the mesh and "
                         "what that means for the light; of a baked file also how it was baked, how exact it is, and "
                         "how its energy is spread over the bands.\n"
                         "\n"
                         "Example:\n"
                         "  shbake info bunny.ply",
                         [] { return std::unique_ptr<Verb>(std::make_unique<Info>()); }};

}  // namespace shbake::cli
