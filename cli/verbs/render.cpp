// `shbake render`: pictures of baked meshes under a light, and of lights.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "cli/format.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/parse.h"
#include "cli/verb.h"
#include "cli/view_light.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

enum class BackgroundKind { gradient, light, plain };
enum class Turning { camera, light };

class Render : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void declareCamera(CLI::App& app);
  void declareLook(CLI::App& app);
  void checkOptions() const;
  bool drawsLight() const;
  void drawLight(Session& session);
  void drawMeshes(Session& session);
  std::vector<Picture> drawPanels(const std::vector<BakedPly>& baked, const std::vector<ViewLight>& lights, double turn,
                                  Session& session);
  std::vector<std::string> captionsOf(const std::vector<BakedPly>& baked) const;
  std::string framePath(int frame) const;

  std::vector<std::string> files_;
  std::string output_, captions_ = "auto";
  ViewLightOptions light_;
  CameraOptions camera_;
  RenderOptions render_;
  ToneMap tone_;
  BackgroundKind background_ = BackgroundKind::gradient;
  Turning turning_ = Turning::camera;
  bool automatic_ = true;
  int frames_ = 0, order_ = 5;
};

void Render::declare(CLI::App& app) {
  app.add_option("FILE", files_,
                 "baked PLY files, drawn side by side; or one .shlight file or image; without any --light is drawn")
      ->type_name("");
  addText(app, {"-o,--output", "FILE", "the picture to write, .png (sRGB) or .exr (radiance); required"}, output_);
  light_.declare(app);
  declareCamera(app);
  declareLook(app);
}

void Render::declareCamera(CLI::App& app) {
  addOption(app,
            {"--view", "VIEW",
             "from where: front, back, left, right, top, bottom, corner; or AZIMUTH,ELEVATION in degrees, clockwise "
             "from north (+y) and -90..90 above the horizon"},
            "corner", [this](const std::string& name, const std::string& text) {
              if (const auto view = viewNamed(text)) {
                camera_.view = *view;
                return;
              }
              if (text.find(',') == std::string::npos) failChoice(name, text, viewNames());
              const auto n = parseNumbers(name, text, 2, 2, "AZIMUTH,ELEVATION in degrees");
              camera_.view = {n[0], n[1]};
            });
  addReal(app, {"--fov", "DEG", "angle of view along the longer side of the picture, 1..150 degrees"},
          camera_.fieldOfView, 1, 150);
  addOption(app, {"--size", "WxH", "pixels of one picture, 16..8192 each way; of a light the height counts"}, "800x600",
            [this](const std::string& name, const std::string& text) {
              const std::size_t x = text.find('x');
              if (x == std::string::npos) throw usageError(name + ": '" + text + "' is not WIDTHxHEIGHT");
              render_.width = static_cast<int>(parseWhole(name, text.substr(0, x), 16, 8192));
              render_.height = static_cast<int>(parseWhole(name, text.substr(x + 1), 16, 8192));
            });
  addWhole(app, {"--samples", "N", "samples along each side of a pixel, 1..8"}, render_.samples, 1, 8);
  addSwitch(app, "--cull", render_.cullBackFaces, "leave out faces turned away, to look into closed rooms");
  addWhole(app,
           {"--turntable", "N", "draw N frames of a full turn, 2..9999, numbered NAME_0001.png on; 0: one picture"},
           frames_, 0, 9999);
  addChoice<Turning>(app, {"--turn", "WHAT", "what a turntable turns: camera or light"}, turning_,
                     {{"camera", Turning::camera}, {"light", Turning::light}});
}

void Render::declareLook(CLI::App& app) {
  addOption(app, {"--exposure", "EV", "brightens by 2^EV, -100..100, or auto: the brightest 1 % become white"}, "auto",
            [this](const std::string& name, const std::string& text) {
              automatic_ = text == "auto";
              if (!automatic_) tone_.exposure = parseReal(name, text, -100, 100);
            });
  addChoice<ToneCurve>(app, {"--tone", "CURVE", "how a .png ends at white: clip, reinhard or filmic"}, tone_.curve,
                       {{"clip", ToneCurve::clip}, {"reinhard", ToneCurve::reinhard}, {"filmic", ToneCurve::filmic}});
  addOption(app,
            {"--background", "B",
             "what is behind: gradient, light (what shines, exact where that is known), or a colour R,G,B in 0..1"},
            "gradient", [this](const std::string& name, const std::string& text) {
              background_ = text == "gradient" ? BackgroundKind::gradient
                            : text == "light"  ? BackgroundKind::light
                                               : BackgroundKind::plain;
              if (background_ != BackgroundKind::plain) return;
              render_.background.top = render_.background.bottom = parseRgb(name, text);
            });
  addOption(app,
            {"--captions", "A,B,...", "texts below the pictures; auto: kinds of transfer of several files, or none"},
            captions_, [this](const std::string&, const std::string& text) { captions_ = text; });
  addWhole(app, {"--order", "N", "bands that a drawn light keeps, 1..32"}, order_, 1, 32);
}

bool Render::drawsLight() const {
  if (files_.empty()) return true;
  std::string extension = fs::path(files_[0]).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return files_.size() == 1 && extension != ".ply";
}

void Render::checkOptions() const {
  if (output_.empty())
    throw usageError("no output is named", "usage: shbake render BAKED.ply --light LIGHT -o OUT.png");
  pictureFormatOf(output_);
  if (frames_ == 1) throw usageError("--turntable: 1 is out of range", "give 2 to 9999 frames");
  if (frames_ > 0 && drawsLight()) throw usageError("--turntable turns meshes, and none is given");
  checkWritable(frames_ > 0 ? framePath(0) : output_);
}

std::string Render::framePath(int frame) const {
  const fs::path path(output_);
  char number[16];
  std::snprintf(number, sizeof number, "_%04d", frame + 1);
  return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

/// The captions for the panels; none for a single one, unless they were given.
std::vector<std::string> Render::captionsOf(const std::vector<BakedPly>& baked) const {
  std::vector<std::string> captions;
  if (captions_ == "none" || (captions_ == "auto" && baked.size() == 1)) return captions;
  if (captions_ == "auto") {
    for (std::size_t i = 0; i < baked.size(); ++i) {
      captions.push_back(baked[i].stated ? transferName(baked[i].facts.kind) : fs::path(files_[i]).stem().string());
    }
    return captions;
  }
  for (std::size_t begin = 0; begin <= captions_.size();) {
    const std::size_t end = std::min(captions_.find(',', begin), captions_.size());
    captions.push_back(captions_.substr(begin, end - begin));
    begin = end + 1;
  }
  return captions;
}

/// One picture for each mesh, all with the same camera and exposure, everything turned by `turn` degrees.
std::vector<Picture> Render::drawPanels(const std::vector<BakedPly>& baked, const std::vector<ViewLight>& lights,
                                        double turn, Session& session) {
  CameraOptions options = camera_;
  options.up = light_.up;
  options.aspect = static_cast<double>(render_.width) / render_.height;
  if (turning_ == Turning::camera) options.view.azimuth += turn;
  std::vector<Vec3d> points;
  for (const BakedPly& b : baked) points.insert(points.end(), b.mesh.positions.begin(), b.mesh.positions.end());
  const Camera camera = fitCamera(points, options);
  const double angle = turning_ == Turning::light ? turn * std::numbers::pi / 180 : 0;
  const sh::Matrix3d rotation = sh::rotationAbout(axesFor(light_.up) * Vec3d{0, 0, 1}, angle);

  std::vector<Picture> panels;
  for (std::size_t i = 0; i < baked.size(); ++i) {
    const std::vector<Rgb> colors = relight(
        baked[i].transfer, angle == 0 ? lights[i].light : rotated(lights[i].light, rotation), {}, session.parallel);
    RenderOptions look = render_;
    if (pictureFormatOf(output_) == PictureFormat::png) look.tone = tone_;
    if (background_ == BackgroundKind::light) {
      look.background.radiance = [&, back = sh::transposed(rotation)](const Vec3d& d) {
        return Rgb(lights[i].radiance(back * d));
      };
    }
    panels.push_back(render(baked[i].mesh, colors, camera, look, session.parallel));
  }
  return panels;
}

/// The exposure that suits all meshes together, before anything turns.
double exposureOf(const std::vector<BakedPly>& baked, const std::vector<ViewLight>& lights, const Parallel& parallel) {
  std::vector<Rgb> colors;
  std::vector<double> areas;
  for (std::size_t i = 0; i < baked.size(); ++i) {
    const std::vector<Rgb> c = relight(baked[i].transfer, lights[i].light, {}, parallel);
    const std::vector<double> a = vertexAreas(baked[i].mesh);
    colors.insert(colors.end(), c.begin(), c.end());
    areas.insert(areas.end(), a.begin(), a.end());
  }
  return automaticExposure(colors, areas);
}

void Render::drawMeshes(Session& session) {
  std::vector<BakedPly> baked;
  std::vector<ViewLight> lights;
  for (const std::string& file : files_) {
    baked.push_back(readBakedPly(file, session.progress));
    for (const std::string& note : baked.back().notes) session.warn(file + ": " + note);
    const bool same = !lights.empty() && baked.back().transfer.order == baked.front().transfer.order;
    lights.push_back(same ? lights.front() : light_.make(baked.back().transfer.order, session));
  }
  const std::vector<std::string> captions = captionsOf(baked);
  if (automatic_) tone_.exposure = exposureOf(baked, lights, session.parallel);
  const int frames = std::max(frames_, 1);
  session.progress.begin("drawing", frames, "pictures");
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<Picture> panels = drawPanels(baked, lights, 360.0 * frame / frames, session);
    writePicture(frames_ > 0 ? framePath(frame) : output_, sideBySide(panels, captions));
    session.progress.advance(1);
  }
  session.progress.end();
  session.display.finish();
  session.report.fact("light", lights.front().description, "light", lights.front().description);
  for (std::size_t i = 0; i < baked.size(); ++i) {
    const NegativeAudit audit =
        auditNegatives(baked[i].mesh, relight(baked[i].transfer, lights[i].light, {}, session.parallel));
    if (audit.worst >= 0) continue;
    session.warn(files_[i] + ": " + formatPercent(audit.areaShare) +
                 " of the surface has negative radiance, drawn black where it is; --window auto damps it");
  }
}

void Render::drawLight(Session& session) {
  if (!files_.empty()) light_.name = files_[0];
  const int order = isLightFile(light_.name) ? readLightFile(light_.name).light.order : order_;
  const ViewLight light = light_.make(order, session);
  if (automatic_) tone_.exposure = automaticExposure(light.light);
  const auto coefficients = [&light](const Vec3d& d) { return radianceFrom(light.light, d); };
  std::vector<Picture> panels;
  std::vector<std::string> captions;
  if (light.exact) {
    panels.push_back(lightPicture(light.radiance, render_.height, tone_, session.parallel));
    captions.push_back("source");
  }
  panels.push_back(lightPicture(coefficients, render_.height, tone_, session.parallel));
  captions.push_back("order " + std::to_string(light.light.order));
  if (captions_ != "auto") captions = captionsOf(std::vector<BakedPly>(panels.size()));
  writePicture(output_, sideBySide(panels, captions));
  session.display.finish();
  session.report.fact("light", light.description, "light", light.description);
  describeLight(light.light, session.report);
}

void Render::run(Session& session) {
  checkOptions();
  if (drawsLight()) {
    drawLight(session);
  } else {
    drawMeshes(session);
  }
  session.report.fact("exposure", tone_.exposure, "exposure", formatNumber(tone_.exposure, 3) + " EV");
  session.report.fact("output.file", output_, "output", frames_ > 0 ? framePath(0) + " and on" : output_);
}

}  // namespace

extern const VerbEntry renderVerb;
const VerbEntry renderVerb{
    "render", "[FILE...] -o PICTURE", "draw baked meshes under a light, or a light itself",
    "Draws baked meshes under a light, several of them side by side with one camera and exposure; or a light as a "
    "lat-long map beside what it was made from, negative radiance in magenta.\n"
    "\n"
    "Examples:\n"
    "  shbake render bunny.ply --light clear --sun 40,150 -o bunny.png\n"
    "  shbake render unshadowed.ply shadowed.ply --light probe.exr -o both.png\n"
    "  shbake render probe.exr --order 4 -o light.png",
    [] { return std::unique_ptr<Verb>(std::make_unique<Render>()); }};

}  // namespace shbake::cli
