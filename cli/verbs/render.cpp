// `shbake render`: pictures of baked meshes under a light, and of lights.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>

#include "cli/baked_scene.h"
#include "cli/format.h"
#include "cli/light_options.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/output_path.h"
#include "cli/parse.h"
#include "cli/verb.h"
#include "cli/view_light.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

enum class BackgroundKind { gradient, light, plain };
enum class Turning { camera, light };

/// Room on each side of a picture for the ground around the mesh, as a share of it.
constexpr double kGroundMargin = 0.15;

/// A mesh to be drawn and the light for its bands.
struct LitScene {
  BakedScene scene;
  ViewLight light;
};

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
  std::vector<Picture> drawPanels(const std::vector<LitScene>& scenes, double turn, Session& session) const;
  std::vector<std::string> captionsOf(std::vector<std::string> titles) const;
  std::string framePath(int frame) const;

  std::vector<std::string> files_;
  std::string output_, captions_ = "auto";
  ViewLightOptions light_;
  CameraOptions camera_;
  RenderOptions render_;
  DisplayOptions display_;
  std::optional<Rgb> ground_;
  BackgroundKind background_ = BackgroundKind::gradient;
  Turning turning_ = Turning::camera;
  int frames_ = 0, order_ = 5;
  bool force_ = false;
};

void Render::declare(CLI::App& app) {
  addList(
      app,
      {"FILE", "", "baked PLY files, drawn side by side; or one .shlight file or image; without any --light is drawn"},
      files_);
  addText(app, {"-o,--output", "FILE", "the picture to write, .png (sRGB) or .exr (radiance); required"}, output_);
  addSwitch(app, "--force", force_, "let the picture replace one of the inputs");
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
  display_.declare(app, "pictures");
  addOption(app,
            {"--background", "B",
             "what is behind: gradient, light (what shines: the sky or the image itself), or a colour R,G,B in 0..1"},
            "gradient", [this](const std::string& name, const std::string& text) {
              background_ = text == "gradient" ? BackgroundKind::gradient
                            : text == "light"  ? BackgroundKind::light
                                               : BackgroundKind::plain;
              if (background_ != BackgroundKind::plain) return;
              render_.background.top = render_.background.bottom = parseRgb(name, text);
            });
  addOption(app,
            {"--ground-plane", "A",
             "stand the mesh on a plane of this albedo, R or R,G,B in 0..1, that shows its shadow and what it reflects "
             "(the mesh itself stays as it was baked)"},
            "none", [this](const std::string& name, const std::string& text) { ground_ = parseRgb(name, text); });
  addOption(app,
            {"--captions", "A,B,...", "texts below the pictures; auto: kinds of transfer of several files, or none"},
            captions_, [this](const std::string&, const std::string& text) { captions_ = text; });
  addWhole(app, {"--order", "N", "bands that a drawn light keeps, 1..32"}, order_, 1, 32);
}

bool Render::drawsLight() const {
  if (files_.empty()) return true;
  return files_.size() == 1 && lowerExtension(files_[0]) != ".ply";
}

void Render::checkOptions() const {
  if (output_.empty())
    throw usageError("no output is named", "usage: shbake render BAKED.ply --light LIGHT -o OUT.png");
  pictureFormatOf(output_);
  if (frames_ == 1) throw usageError("--turntable: 1 is out of range", "give 2 to 9999 frames");
  if (frames_ > 0 && drawsLight()) throw usageError("--turntable turns meshes, and none is given");
  if (ground_ && drawsLight()) throw usageError("--ground-plane is for meshes, and none is given");
  std::vector<std::string> inputs = files_;
  inputs.push_back(light_.name);
  checkOutput(frames_ > 0 ? framePath(0) : output_, inputs, "one of the inputs", force_);
}

std::string Render::framePath(int frame) const {
  const fs::path path(output_);
  char number[16];
  std::snprintf(number, sizeof number, "_%04d", frame + 1);
  return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

/// The captions for panels of these titles; none for a single one, unless they were given.
std::vector<std::string> Render::captionsOf(std::vector<std::string> titles) const {
  if (captions_ == "none" || (captions_ == "auto" && titles.size() == 1)) return {};
  if (captions_ == "auto") return titles;
  std::vector<std::string> captions;
  for (std::size_t begin = 0; begin <= captions_.size();) {
    const std::size_t end = std::min(captions_.find(',', begin), captions_.size());
    captions.push_back(captions_.substr(begin, end - begin));
    begin = end + 1;
  }
  return captions;
}

/// The middle of the bounding box.
Vec3d centreOf(const std::vector<Vec3d>& points) {
  Vec3d low = points.at(0), high = low;
  for (const Vec3d& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 0.5 * (low + high);
}

/// One picture for each mesh, all with the same camera and exposure, everything turned by `turn` degrees.
std::vector<Picture> Render::drawPanels(const std::vector<LitScene>& scenes, double turn, Session& session) const {
  CameraOptions options = camera_;
  options.up = light_.up;
  options.aspect = static_cast<double>(render_.width) / render_.height;
  if (ground_) options.margin = kGroundMargin;
  if (turning_ == Turning::camera) options.view.azimuth += turn;
  std::vector<Vec3d> points;
  for (const LitScene& s : scenes) {
    points.insert(points.end(), s.scene.mesh().positions.begin(), s.scene.mesh().positions.end());
  }
  const Camera camera = fitCamera(points, options);
  const double angle = turning_ == Turning::light ? turn * std::numbers::pi / 180 : 0;
  const sh::Matrix3d rotation = sh::rotationAbout(axesFor(light_.up) * Vec3d{0, 0, 1}, angle);

  std::vector<Picture> panels;
  for (const LitScene& s : scenes) {
    const Vec3d centre = centreOf(s.scene.mesh().positions);
    const ViewLight light = angle == 0 ? s.light : s.light.turned(rotation, centre);
    RenderOptions look = render_;
    if (pictureFormatOf(output_) == PictureFormat::png) look.tone = display_.tone;
    if (background_ == BackgroundKind::light) {
      look.background.radiance = [seen = light.seenFrom(centre)](const Vec3d& d) { return Rgb(seen(d)); };
    }
    const BakedScene::Drawn drawn = s.scene.drawn(light, camera, session.parallel);
    panels.push_back(render(drawn.mesh, drawn.colors, camera, look, session.parallel));
  }
  return panels;
}

/// The exposure that suits all meshes together, before anything turns.
double exposureOf(const std::vector<LitScene>& scenes, const Parallel& parallel) {
  std::vector<Rgb> colors;
  std::vector<double> areas;
  for (const LitScene& s : scenes) {
    const std::vector<Rgb> c = s.scene.colors(s.light, parallel);
    const std::vector<double> a = vertexAreas(s.scene.mesh());
    colors.insert(colors.end(), c.begin(), c.end());
    areas.insert(areas.end(), a.begin(), a.end());
  }
  return automaticExposure(colors, areas);
}

void Render::drawMeshes(Session& session) {
  std::vector<LitScene> scenes;
  std::vector<std::string> titles;
  for (const std::string& file : files_) {
    BakedScene scene(file, session);
    const int order = scene.transfer().order;
    const bool same = !scenes.empty() && order == scenes.front().scene.transfer().order;
    titles.push_back(scene.title());
    ViewLight light = same ? scenes.front().light : light_.make(order, background_ == BackgroundKind::light, session);
    scenes.push_back({std::move(scene), std::move(light)});
  }
  const std::vector<std::string> captions = captionsOf(titles);
  if (ground_) {
    for (LitScene& s : scenes) s.scene.addGround(*ground_, light_.up, session);
  }
  if (display_.automatic) display_.tone.exposure = exposureOf(scenes, session.parallel);
  const int frames = std::max(frames_, 1);
  session.progress.begin("drawing", frames, "pictures");
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<Picture> panels = drawPanels(scenes, 360.0 * frame / frames, session);
    writePicture(frames_ > 0 ? framePath(frame) : output_, sideBySide(panels, captions));
    session.progress.advance(1);
  }
  session.progress.end();
  session.display.finish();
  const std::string& description = scenes.front().light.description;
  session.report.fact("light", description, "light", description);
  for (const LitScene& s : scenes) {
    const NegativeAudit audit = auditNegatives(s.scene.mesh(), s.scene.colors(s.light, session.parallel));
    if (audit.worst >= 0) continue;
    session.warn(s.scene.path() + ": " + formatPercent(audit.areaShare) +
                 " of the surface has negative radiance, drawn black where it is; --window auto damps it");
  }
}

void Render::drawLight(Session& session) {
  if (!files_.empty()) light_.name = files_[0];
  const ViewLight light = light_.make(isLightFile(light_.name) ? kMaxLightOrder : order_, true, session);
  std::vector<LightSample> samples{{Vec3d{}, light.light}};
  if (light.rig) samples = light.rig->samples();
  if (display_.automatic) display_.tone.exposure = automaticExposure(samples[0].light);
  std::vector<Picture> panels;
  std::vector<std::string> titles;
  const auto draw = [&](const RadianceFunction& radiance, const std::string& title) {
    panels.push_back(lightPicture(radiance, render_.height, render_.samples, display_.tone, session.parallel));
    titles.push_back(title);
  };
  if (light.source) draw(light.source, "source");
  for (const LightSample& s : samples) {
    draw([&s](const Vec3d& d) { return radianceFrom(s.light, d); },
         light.rig ? "at " + vectorText(s.position) : "order " + std::to_string(light.order()));
  }
  std::vector<std::string> captions = captionsOf(titles);
  if (captions_ == "auto") captions = titles;
  writePicture(output_, sideBySide(panels, captions));
  session.display.finish();
  session.report.fact("light", light.description, "light", light.description);
  if (!light.rig) describeLight(light.light, session.report);
}

void Render::run(Session& session) {
  checkOptions();
  if (drawsLight()) {
    drawLight(session);
  } else {
    drawMeshes(session);
  }
  const double exposure = display_.tone.exposure;
  session.report.fact("exposure", exposure, "exposure", formatNumber(exposure, 3) + " EV");
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
    "  shbake render bunny.ply --light probe.exr --background light -o probe.png\n"
    "  shbake render bunny.ply --light clear --ground-plane 0.4 -o shadow.png\n"
    "  shbake render unshadowed.ply shadowed.ply --light probe.exr -o both.png\n"
    "  shbake render probe.exr --order 4 -o light.png",
    [] { return std::unique_ptr<Verb>(std::make_unique<Render>()); }};

}  // namespace shbake::cli
