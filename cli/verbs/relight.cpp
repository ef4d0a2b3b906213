// `shbake relight`: the colours that a baked mesh has under a light.
#include <algorithm>
#include <array>
#include <chrono>

#include "cli/format.h"
#include "cli/light_options.h"
#include "cli/options.h"
#include "cli/output_path.h"
#include "cli/verb.h"
#include "cli/view_light.h"

namespace shbake::cli {
namespace {

class Relight : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void checkPaths() const;
  void setColors(BakedPly& baked, const std::vector<Rgb>& radiance, const std::string& light, Session& session) const;

  std::string baked_, output_;
  ViewLightOptions light_;
  DisplayOptions display_;
  bool floats_ = false, clamp_ = false, dropSh_ = false, ascii_ = false, force_ = false;
};

void Relight::declare(CLI::App& app) {
  addFile(app, "BAKED", baked_, "a baked PLY file");
  addText(app, {"-o,--output", "FILE", "the PLY file to write; required"}, output_);
  light_.declare(app);
  addChoice<bool>(
      app,
      {"--colors", "KIND", "bytes: 8-bit sRGB, exposed and tone-mapped for display; floats: linear radiance as it is"},
      floats_, {{"bytes", false}, {"floats", true}});
  display_.declare(app, "bytes");
  addSwitch(app, "--clamp", clamp_, "set negative radiance in floats to 0 (bytes hold none anyway)");
  addSwitch(app, "--drop-sh", dropSh_, "leave the transfer out of the output, so that only colours remain");
  addSwitch(app, "--ascii", ascii_, "write the file as text instead of binary");
  addSwitch(app, "--force", force_, "let the output replace the baked file");
}

void Relight::checkPaths() const {
  const std::string usage = "usage: shbake relight BAKED.ply --light LIGHT -o OUT.ply";
  if (baked_.empty()) throw usageError("no baked file is named", usage);
  if (output_.empty()) throw usageError("no output is named", usage);
  checkOutput(output_, std::array{baked_}, "the file that is relit", force_);
}

/// Puts the colours in place of the mesh's own, and says in the file's comments what they are.
void Relight::setColors(BakedPly& baked, const std::vector<Rgb>& radiance, const std::string& light,
                        Session& session) const {
  Mesh& mesh = baked.mesh;
  if (baked.facts.albedo.origin == AlbedoOrigin::vertexColors) {
    session.warn("the mesh's own vertex colours, from which it was baked, are replaced in the output");
    baked.facts.albedo.origin = AlbedoOrigin::unknown;
  }
  std::erase_if(mesh.vertexProperties,
                [](const Property& p) { return p.name == "red" || p.name == "green" || p.name == "blue"; });
  std::erase_if(mesh.comments, [](const std::string& c) { return c.starts_with("relit: "); });
  std::string comment = "relit: red green blue are ";
  if (floats_) {
    mesh.vertexColors = radiance;
    mesh.vertexColorEncoding = ColorEncoding::linear;
    comment += "linear radiance";
  } else {
    mesh.vertexColors.clear();
    for (const Rgb& c : radiance) {
      const Rgb d = displayLight(c, display_.tone);
      mesh.vertexColors.emplace_back(static_cast<float>(encodedByte(d.x)) / 255,
                                     static_cast<float>(encodedByte(d.y)) / 255,
                                     static_cast<float>(encodedByte(d.z)) / 255);
    }
    mesh.vertexColorEncoding = ColorEncoding::srgb;
    comment += "sRGB, exposure " + formatNumber(display_.tone.exposure, 4);
  }
  std::string tidy = light;
  std::replace_if(
      tidy.begin(), tidy.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  mesh.comments.push_back(comment + ", under " + tidy);
}

void reportNegatives(const NegativeAudit& audit, Report& report) {
  report.data("negative.area_share", audit.areaShare);
  report.data("negative.worst", audit.worst);
  report.data("negative.worst_share", audit.worstShare);
  if (audit.worst < 0) {
    report.data("negative.worst_vertex", static_cast<std::int64_t>(audit.worstVertex));
    report.line("negative", formatPercent(audit.areaShare) + " of the surface; least " + formatNumber(audit.worst, 3) +
                                " at vertex " + std::to_string(audit.worstVertex) + ", " +
                                formatPercent(audit.worstShare) + " of the brightest");
    report.line("", "(ringing of the light; --window auto or hann damps it)");
  } else {
    report.line("negative", "none");
  }
}

void Relight::run(Session& session) {
  checkPaths();
  BakedPly baked = readBakedPly(baked_, session.progress);
  for (const std::string& note : baked.notes) session.warn(baked_ + ": " + note);
  if (!baked.facts.albedo.included) session.warn(baked_ + ": the albedo is not part of the transfer: colours lack it");
  const TransferSet& set = baked.transfer;
  const ViewLight light = light_.make(set.order, false, session);

  const auto start = std::chrono::steady_clock::now();
  const std::vector<Rgb> radiance =
      light.colors(set, baked.mesh.positions, {.clampNegative = floats_ && clamp_}, session.parallel);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<Rgb> audited = clamp_ ? light.colors(set, baked.mesh.positions, {}, session.parallel) : radiance;
  const NegativeAudit audit = auditNegatives(baked.mesh, audited);
  if (display_.automatic) display_.tone.exposure = automaticExposure(radiance, vertexAreas(baked.mesh));

  setColors(baked, radiance, light.description, session);
  if (dropSh_) {
    writePly(output_, baked.mesh, {ascii_ ? PlyEncoding::ascii : PlyEncoding::binaryLittleEndian}, session.progress);
  } else {
    writeBakedPly(output_, baked.mesh, set, baked.facts, baked.sourceVertex, {ascii_}, session.progress);
  }
  session.display.finish();
  Report& report = session.report;
  report.data("input.file", baked_);
  report.fact("light", light.description, "light", light.description);
  report.fact("order", std::int64_t(light.order()), "bands",
              std::to_string(light.order()) + " of " + std::to_string(set.order) + " that were baked");
  reportNegatives(audit, report);
  if (!floats_)
    report.fact("exposure", display_.tone.exposure, "exposure", formatNumber(display_.tone.exposure, 3) + " EV");
  report.data("seconds", seconds);
  if (!light.rig) {
    const double rate = 3.0 * light.order() * light.order() * static_cast<double>(set.size()) / seconds;
    report.data("multiply_adds_per_second", rate);
    // Of small meshes it tells how long threads take to start.
    if (session.verbose) {
      const int threads = session.parallel.threads();
      report.line("rate", formatShort(rate) + " multiply-adds/s on " + std::to_string(threads) +
                              (threads == 1 ? " thread" : " threads"));
    }
  }
  report.fact("output.file", output_, "output", output_);
}

}  // namespace

extern const VerbEntry relightVerb;
const VerbEntry relightVerb{"relight", "BAKED -o FILE", "light a baked mesh and write its colours",
                            "Lights a baked mesh and writes it again with the colours of its vertices under that "
                            "light, beside the transfer and "
                            "whatever else it holds. Tells where few bands of light make colours negative.\n"
                            "\n"
                            "Examples:\n"
                            "  shbake relight bunny.ply --light studio.exr -o lit.ply\n"
                            "  shbake relight city.ply --light clear --sun 30,200 -o evening.ply",
                            [] { return std::unique_ptr<Verb>(std::make_unique<Relight>()); }};

}  // namespace shbake::cli
