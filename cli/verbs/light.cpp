// `shbake light`: probes, skies and simple lights in, a light file out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "cli/format.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/parse.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

/// An option that may be given several times, each time with one value.
void addRepeated(CLI::App& app, const OptionText& text, std::vector<std::string>& values) {
  app.add_option(text.names, values, text.help)->type_name(text.value)->allow_extra_args(false);
}

class MakeLight : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void declareSources(CLI::App& app);
  void declareMaps(CLI::App& app);
  void declareChanges(CLI::App& app);
  void checkInputs() const;
  void addFiles(Session& session);
  void addMap(const WeightedFile& file, Session& session);
  void addSky();
  void addSimpleLights();
  void change(Session& session);
  void add(const Light& light, const Vec3d& weight, const std::string& source);
  void note(const std::string& change) { file_.sources.push_back(change); }

  std::vector<std::string> inputs_, discs_, parallels_, constants_, gradients_, shadows_, turns_;
  std::string output_;
  bool force_ = false;
  int order_ = 4;
  EnvironmentMapOptions map_;
  std::string skyModel_ = "none";
  SkyOptions sky_;
  double exposure_ = 0, rotate_ = 0;
  sh::Window window_ = sh::Window::none;

  int workOrder_ = 4;  ///< above order_ where a shadow mixes bands
  LightFile file_;
};

void MakeLight::declare(CLI::App& app) {
  app.add_option(
         "FILE", inputs_,
         "environment maps (HDR, EXR and other images) and light files to sum; FILE@W or FILE@R,G,B weights one")
      ->type_name("");
  addText(app, {"-o,--output", "FILE", "the light file (.shlight) to write; required"}, output_);
  addWhole(app, {"--order", "N", "bands of spherical harmonics, 1..64: N x N coefficients a channel"}, order_, 1, 64);
  declareSources(app);
  declareMaps(app);
  declareChanges(app);
  addSwitch(app, "--force", force_, "let the output replace one of the inputs");
}

void MakeLight::declareSources(CLI::App& app) {
  addChoice<std::string>(
      app, {"--sky", "MODEL", "add a CIE sky: overcast, clear, partly-cloudy, or none"}, skyModel_,
      {{"none", "none"}, {"overcast", "overcast"}, {"clear", "clear"}, {"partly-cloudy", "partly-cloudy"}});
  addOption(
      app, {"--sun", "ALT,AZ", "where the sky's sun stands: altitude 0..90 degrees, azimuth clockwise from north (+y)"},
      "45,0", [this](const std::string& name, const std::string& text) {
        const auto n = parseNumbers(name, text, 2, 2, "ALTITUDE,AZIMUTH in degrees");
        sky_.sunAltitude = n[0];
        sky_.sunAzimuth = n[1];
      });
  addOption(app, {"--zenith", "L", "the sky's radiance at the zenith: grey or R,G,B, 0 or more"}, "1",
            [this](const std::string& name, const std::string& text) {
              sky_.zenith = colorFrom(parseNumbers(name, text, 1, 3, "GREY or R,G,B"), 0, name);
            });
  addOption(app, {"--ground", "A", "albedo of the ground below the sky: grey or R,G,B, 0..1"}, "0",
            [this](const std::string& name, const std::string& text) {
              sky_.groundAlbedo = colorFrom(parseNumbers(name, text, 1, 3, "GREY or R,G,B"), 0, name);
            });
  addRepeated(app,
              {"--disc", "X,Y,Z,DEG,L", "add a disc of radiance L (grey or R,G,B) within DEG (0..180) of a direction"},
              discs_);
  addRepeated(
      app, {"--parallel", "X,Y,Z,E", "add parallel light from a direction, which gives a facing surface irradiance E"},
      parallels_);
  addRepeated(app, {"--constant", "L", "add the same radiance from everywhere"}, constants_);
  addRepeated(app,
              {"--gradient", "R,G,B,R,G,B", "add radiance that runs from the first colour above to the second below"},
              gradients_);
}

void MakeLight::declareMaps(CLI::App& app) {
  std::vector<std::pair<std::string, MapLayout>> layouts;
  for (const std::string& name : layoutNames()) layouts.emplace_back(name, *layoutNamed(name));
  std::string names;
  for (const std::string& name : layoutNames()) names += (names.empty() ? "" : ", ") + name;
  addChoice<MapLayout>(app, {"--layout", "NAME", "layout of the maps: " + names}, map_.layout, layouts);
  addChoice<UpAxis>(app,
                    {"--up", "AXIS",
                     "axes of the light: z (maps have +z on top, +x in the centre, -y to the right) or y (+y, +x, +z)"},
                    map_.up, {{"z", UpAxis::z}, {"y", UpAxis::y}});
  addSwitch(app, "--mirror", map_.mirror, "the maps show the world mirrored: exchange left and right");
  addSwitch(app, "--keep-negative", map_.keepNegative, "count negative pixels as they are instead of as 0");
  addChoice<PixelEncoding>(
      app,
      {"--encoding", "KIND", "what pixels are: linear, srgb (display values), or auto: integers srgb, floats linear"},
      map_.encoding,
      {{"auto", PixelEncoding::automatic}, {"linear", PixelEncoding::linear}, {"srgb", PixelEncoding::srgb}});
}

void MakeLight::declareChanges(CLI::App& app) {
  addReal(app, {"--exposure", "EV", "multiply the sum by 2^EV, -100..100"}, exposure_, -100, 100);
  addReal(app, {"--rotate", "DEG", "then turn it about the up axis, counter-clockwise seen from above, -360..360"},
          rotate_, -360, 360);
  addRepeated(app, {"--turn", "X,Y,Z,DEG", "then turn it about any axis; may be repeated"}, turns_);
  addRepeated(app,
              {"--shadow", "X,Y,Z,DEG", "then block everything within DEG (0..180) of a direction; may be repeated"},
              shadows_);
  addChoice<sh::Window>(app,
                        {"--window", "KIND",
                         "then damp high bands against ringing: none, hann, lanczos, gauss, or auto: just enough to "
                         "leave nothing negative"},
                        window_,
                        {{"none", sh::Window::none},
                         {"hann", sh::Window::hann},
                         {"lanczos", sh::Window::lanczos},
                         {"gauss", sh::Window::gauss},
                         {"auto", sh::Window::automatic}});
}

void MakeLight::checkInputs() const {
  const std::string usage = "usage: shbake light FILE... -o OUT.shlight";
  const bool none = inputs_.empty() && skyModel_ == "none" && discs_.empty() && parallels_.empty() &&
                    constants_.empty() && gradients_.empty();
  if (none) throw usageError("nothing to make light from", usage + "; or add --sky, --disc, --parallel or --constant");
  if (output_.empty()) throw usageError("no output is named", usage);
  if (fs::path(output_).extension() != ".shlight") {
    throw Error({.kind = ErrorKind::usage,
                 .file = output_,
                 .cause = "is not named as a light file",
                 .remedy = "name it .shlight"});
  }
  for (const std::string& input : inputs_) {
    std::error_code missing;
    if (force_ || !fs::equivalent(parseWeightedFile(input).path, output_, missing)) continue;
    throw Error({.kind = ErrorKind::usage,
                 .file = output_,
                 .cause = "would replace one of the inputs",
                 .remedy = "name another output, or add --force"});
  }
  checkWritable(output_);
}

void MakeLight::add(const Light& light, const Vec3d& weight, const std::string& source) {
  addLight(file_.light, light, weight);
  note(source + (weight == Vec3d{1, 1, 1} ? "" : ", weight " + vectorText(weight)));
}

void MakeLight::addMap(const WeightedFile& file, Session& session) {
  const EnvironmentMapLight map =
      projectEnvironmentMap(file.path, workOrder_, map_, session.parallel, session.progress);
  const std::string size = std::to_string(map.width) + "x" + std::to_string(map.height);
  const std::string layout = layoutName(map.layout);
  session.report.line("map", file.path + ": " + size + ", " + layout +
                                 (map.layoutGuessed ? " (guessed from its shape; --layout tells otherwise)" : ""));
  for (const std::string& sentence : map.notes) session.report.line("", sentence);
  const BadPixels& bad = map.badPixels;
  if (bad.total() > 0) {
    session.warn(file.path + ": " + formatCount(bad.nan) + " pixels are not a number, " + formatCount(bad.infinite) +
                 " infinite and " + formatCount(bad.negative) + " negative, the first at column " +
                 std::to_string(bad.x) + ", row " + std::to_string(bad.y) +
                 "; NaN counts as black, infinity as 65504 " + "in half floats and 0 elsewhere, negative " +
                 (map_.keepNegative ? "as it is" : "as 0"));
  }
  add(map.light, file.weight, fs::path(file.path).filename().string() + ": " + layout + " " + size);
}

void MakeLight::addFiles(Session& session) {
  for (const std::string& input : inputs_) {
    const WeightedFile file = parseWeightedFile(input);
    if (fs::path(file.path).extension() != ".shlight") {
      addMap(file, session);
      continue;
    }
    const LightFile other = readLightFile(file.path);
    if (other.up != map_.up) {
      throw Error({.file = file.path,
                   .place = "field \"axes\"",
                   .cause = "its up axis is not that of --up",
                   .remedy = "give the other --up, or turn it with 'shbake sh'"});
    }
    if (other.light.order < order_) {
      session.warn(file.path + ": has order " + std::to_string(other.light.order) + ", its higher bands are zero");
    }
    add(other.light, file.weight,
        fs::path(file.path).filename().string() + ": order " + std::to_string(other.light.order));
  }
}

void MakeLight::addSky() {
  const std::optional<SkyModel> model = skyNamed(skyModel_);
  if (!model) return;
  sky_.model = *model;
  Light light = skyLight(workOrder_, sky_);
  if (map_.up != UpAxis::z) light = rotated(light, axesFor(map_.up));
  add(light, {1, 1, 1},
      "CIE " + skyModel_ + " sky: zenith " + vectorText(sky_.zenith) + ", sun at " + formatNumber(sky_.sunAltitude) +
          "," + formatNumber(sky_.sunAzimuth) + ", ground " + vectorText(sky_.groundAlbedo));
}

void MakeLight::addSimpleLights() {
  const Vec3d one{1, 1, 1};
  for (const std::string& text : discs_) {
    const auto n = parseNumbers("--disc", text, 5, 7, "X,Y,Z,DEG,L or X,Y,Z,DEG,R,G,B");
    add(discLight(workOrder_, {n[0], n[1], n[2]}, n[3], colorFrom(n, 4, "--disc")), one, "disc " + text);
  }
  for (const std::string& text : parallels_) {
    const auto n = parseNumbers("--parallel", text, 4, 6, "X,Y,Z,E or X,Y,Z,R,G,B");
    // Scaled for the bands that are kept in the end, so that its irradiance holds for them.
    add(withOrder(directionalLight(order_, {n[0], n[1], n[2]}, colorFrom(n, 3, "--parallel")), workOrder_), one,
        "parallel " + text);
  }
  for (const std::string& text : constants_) {
    const auto n = parseNumbers("--constant", text, 1, 3, "GREY or R,G,B");
    add(constantLight(workOrder_, colorFrom(n, 0, "--constant")), one, "constant " + text);
  }
  for (const std::string& text : gradients_) {
    const auto n = parseNumbers("--gradient", text, 6, 6, "R,G,B,R,G,B");
    const Vec3d up = map_.up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    add(gradientLight(workOrder_, up, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}), one, "gradient " + text);
  }
}

void MakeLight::change(Session& session) {
  Light& light = file_.light;
  if (exposure_ != 0) {
    light = scaled(light, Vec3d{1, 1, 1} * std::exp2(exposure_));
    note("exposure " + formatNumber(exposure_));
  }
  if (rotate_ != 0) {
    const Vec3d up = map_.up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    light = rotated(light, sh::rotationAbout(up, rotate_ * std::acos(-1.0) / 180));
    note("rotate " + formatNumber(rotate_));
  }
  for (const std::string& text : turns_) {
    light = rotated(light, parseTurn("--turn", text));
    note("turn " + text);
  }
  for (const std::string& text : shadows_) {
    const auto n = parseNumbers("--shadow", text, 4, 4, "X,Y,Z,DEG");
    light = withProxyShadow(light, {n[0], n[1], n[2]}, n[3], light.order);
    note("shadow " + text);
  }
  light = withOrder(light, order_);
  const double lambda = windowLight(window_, light);
  if (window_ == sh::Window::none) return;
  const std::string name(sh::windowName(window_));
  note("window " + name);
  session.report.fact("window.lambda", lambda, "window",
                      name + (window_ == sh::Window::automatic ? ", lambda " + formatNumber(lambda, 4) : ""));
}

void MakeLight::run(Session& session) {
  checkInputs();
  // A shadow's edge brings bands of the light above the output's down into it.
  workOrder_ = shadows_.empty() ? order_ : std::min(2 * order_ + 8, kMaxLightOrder);
  file_ = {};
  file_.light = Light(workOrder_);
  file_.up = map_.up;
  addFiles(session);
  addSky();
  addSimpleLights();
  change(session);
  writeLightFile(output_, file_);
  session.display.finish();
  describeLight(file_.light, session.report);
  session.report.data("sources", file_.sources);
  session.report.fact("output.file", output_, "output", output_);
}

}  // namespace

extern const VerbEntry lightVerb;
const VerbEntry lightVerb{
    "light", "[FILE...] -o FILE", "make a light file from probes, skies and simple lights",
    "Projects environment maps, CIE skies and simple lights onto spherical harmonics, sums them and writes a light "
    "file. "
    "Every pixel is integrated over the part of the sphere that it covers; nothing is clamped unless it is said.\n"
    "\n"
    "Examples:\n"
    "  shbake light room.hdr -o room.shlight --window auto\n"
    "  shbake light -o noon.shlight --sky clear --sun 60,180 --ground 0.2\n"
    "  shbake light a.exr@0.7 b.shlight@0.3 -o mixed.shlight --rotate 90",
    [] { return std::unique_ptr<Verb>(std::make_unique<MakeLight>()); }};

}  // namespace shbake::cli
