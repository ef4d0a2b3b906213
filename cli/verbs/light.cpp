// `shbake light`: probes, skies and simple lights in, a light file out.
#include <algorithm>
#include <filesystem>

#include "cli/format.h"
#include "cli/light_options.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/output_path.h"
#include "cli/parse.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

/// A light and what it is, for the list of sources.
struct NamedLight {
  Light light;
  std::string source;
};

/// A place and a file from "X,Y,Z,FILE".
struct PlacedFile {
  Vec3d place;
  WeightedFile file;
};

PlacedFile parseSample(const std::string& text) {
  std::size_t end = 0;
  for (int comma = 0; comma < 3 && end != std::string::npos; ++comma) end = text.find(',', end + (comma > 0));
  if (end == std::string::npos || end + 1 >= text.size()) {
    throw usageError("--sample: '" + text + "' is not X,Y,Z,FILE", "give a place and a file, such as 0,0,1.5,hall.hdr");
  }
  const auto n = parseNumbers("--sample", text.substr(0, end), 3, 3, "X,Y,Z,FILE");
  return {{n[0], n[1], n[2]}, parseWeightedFile(text.substr(end + 1))};
}

class MakeLight : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void declareSources(CLI::App& app);
  void declareMaps(CLI::App& app);
  void declareRig(CLI::App& app);
  void declareChanges(CLI::App& app);
  void checkInputs() const;
  NamedLight read(const std::string& path, Session& session) const;
  NamedLight readMap(const std::string& path, Session& session) const;
  NamedLight readFile(const std::string& path, Session& session) const;
  void addFiles(Session& session);
  void addSky();
  void addSimpleLights();
  void addSamples(Session& session);
  void turn(const sh::Matrix3d& rotation);
  void change(Session& session);
  void add(const Light& light, const Vec3d& weight, const std::string& source);
  void note(const std::string& change) { sources_.push_back(change); }
  void write(Session& session) const;

  std::vector<std::string> inputs_, discs_, parallels_, constants_, gradients_, samples_, shadows_, turns_;
  std::string output_;
  bool force_ = false;
  int order_ = 4;
  EnvironmentMapOptions map_;
  std::string skyModel_ = "none";
  SkyOptions sky_;
  double exposure_ = 0, rotate_ = 0;
  sh::Window window_ = sh::Window::none;

  int workOrder_ = 4;          ///< above order_ where a shadow mixes bands
  std::vector<Light> lights_;  ///< the one light, or that of each sample of a rig
  std::vector<Vec3d> places_;  ///< of the samples; empty for one light
  RigOptions blend_;
  std::vector<std::string> sources_;
};

void MakeLight::declare(CLI::App& app) {
  addList(app,
          {"FILE", "",
           "environment maps (HDR, EXR and other images) and light files to sum; FILE@W or FILE@R,G,B weights one"},
          inputs_);
  addText(app, {"-o,--output", "FILE", "the light file (.shlight) to write; required"}, output_);
  addWhole(app, {"--order", "N", "bands of spherical harmonics, 1..64: N x N coefficients a channel"}, order_, 1, 64);
  declareSources(app);
  declareMaps(app);
  declareRig(app);
  declareChanges(app);
  addSwitch(app, "--force", force_, "let the output replace one of the inputs");
}

void MakeLight::declareSources(CLI::App& app) {
  addChoice<std::string>(
      app, {"--sky", "MODEL", "add a CIE sky: overcast, clear, partly-cloudy, or none"}, skyModel_,
      {{"none", "none"}, {"overcast", "overcast"}, {"clear", "clear"}, {"partly-cloudy", "partly-cloudy"}});
  addSkyOptions(app, sky_);
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
  addMapOptions(app, map_);
  addChoice<UpAxis>(app,
                    {"--up", "AXIS",
                     "axes of the light: z (maps have +z on top, +x in the centre, -y to the right) or y (+y, +x, +z)"},
                    map_.up, {{"z", UpAxis::z}, {"y", UpAxis::y}});
}

void MakeLight::declareRig(CLI::App& app) {
  addRepeated(app,
              {"--sample", "X,Y,Z,FILE",
               "make a rig of local lights: FILE (an image or light file) as it is at a place, plus all that is not a "
               "sample; may be repeated"},
              samples_);
  addChoice<RigMethod>(
      app,
      {"--blend", "KIND",
       "light between samples: inverse-distance, or barycentric: linear in the tetrahedra that they span"},
      blend_.method,
      {{blendName(RigMethod::inverseDistance), RigMethod::inverseDistance},
       {blendName(RigMethod::barycentric), RigMethod::barycentric}});
  addReal(app, {"--power", "P", "inverse-distance: weights fall with this power of the distance, 0.1..100"},
          blend_.power, 0.1, 100);
}

void MakeLight::declareChanges(CLI::App& app) {
  addReal(app, {"--exposure", "EV", "multiply the sum by 2^EV, -100..100"}, exposure_, -100, 100);
  addReal(app, {"--rotate", "DEG", "then turn it about the up axis, counter-clockwise seen from above, -360..360"},
          rotate_, -360, 360);
  addRepeated(app, {"--turn", "X,Y,Z,DEG", "then turn it about any axis; may be repeated"}, turns_);
  addRepeated(app,
              {"--shadow", "X,Y,Z,DEG", "then block everything within DEG (0..180) of a direction; may be repeated"},
              shadows_);
  addWindow(app, "then damp", window_);
}

void MakeLight::checkInputs() const {
  const std::string usage = "usage: shbake light FILE... -o OUT.shlight";
  const bool none = inputs_.empty() && skyModel_ == "none" && discs_.empty() && parallels_.empty() &&
                    constants_.empty() && gradients_.empty() && samples_.empty();
  if (none) throw usageError("nothing to make light from", usage + "; or add --sky, --disc, --parallel or --constant");
  if (output_.empty()) throw usageError("no output is named", usage);
  requireLightFileName(output_);
  std::vector<std::string> paths;
  for (const std::string& input : inputs_) paths.push_back(parseWeightedFile(input).path);
  for (const std::string& sample : samples_) paths.push_back(parseSample(sample).file.path);
  checkOutput(output_, paths, "one of the inputs", force_);
}

std::string weightText(const Vec3d& weight) {
  return weight == Vec3d{1, 1, 1} ? "" : ", weight " + vectorText(weight);
}

void MakeLight::add(const Light& light, const Vec3d& weight, const std::string& source) {
  addLight(lights_[0], light, weight);
  note(source + weightText(weight));
}

NamedLight MakeLight::readMap(const std::string& path, Session& session) const {
  const EnvironmentMapLight map = projectEnvironmentMap(path, workOrder_, map_, session.parallel, session.progress);
  const std::string size = std::to_string(map.width) + "x" + std::to_string(map.height);
  const std::string layout = layoutName(map.layout);
  session.report.line("map", path + ": " + size + ", " + layout +
                                 (map.layoutGuessed ? " (guessed from its shape; --layout tells otherwise)" : ""));
  for (const std::string& sentence : map.notes) session.report.line("", sentence);
  const BadPixels& bad = map.badPixels;
  if (bad.total() > 0) {
    session.warn(path + ": " + formatCount(bad.nan) + " pixels are not a number, " + formatCount(bad.infinite) +
                 " infinite and " + formatCount(bad.negative) + " negative, the first at column " +
                 std::to_string(bad.x) + ", row " + std::to_string(bad.y) +
                 "; NaN counts as black, infinity as 65504 in half floats and 0 elsewhere, negative " +
                 (map_.keepNegative ? "as it is" : "as 0"));
  }
  return {map.light, fs::path(path).filename().string() + ": " + layout + " " + size};
}

NamedLight MakeLight::readFile(const std::string& path, Session& session) const {
  const LightFile file = readLightFile(path);
  if (file.light.order < order_) {
    session.warn(path + ": has order " + std::to_string(file.light.order) + ", its higher bands are zero");
  }
  // The file says which axes it has: another --up turns it.
  const bool same = file.up == map_.up;
  return {same ? file.light : rotated(file.light, axesFor(map_.up) * sh::transposed(axesFor(file.up))),
          fs::path(path).filename().string() + ": order " + std::to_string(file.light.order)};
}

NamedLight MakeLight::read(const std::string& path, Session& session) const {
  return isLightFile(path) ? readFile(path, session) : readMap(path, session);
}

void MakeLight::addFiles(Session& session) {
  for (const std::string& input : inputs_) {
    const WeightedFile file = parseWeightedFile(input);
    const NamedLight light = read(file.path, session);
    add(light.light, file.weight, light.source);
  }
}

/// Turns the sum into a rig: each sample is the sum and the sample's own light.
void MakeLight::addSamples(Session& session) {
  if (samples_.empty()) return;
  const Light sum = lights_[0];
  lights_.clear();
  for (const std::string& text : samples_) {
    const PlacedFile sample = parseSample(text);
    const NamedLight light = read(sample.file.path, session);
    places_.push_back(sample.place);
    lights_.push_back(sum);
    addLight(lights_.back(), light.light, sample.file.weight);
    note("sample at " + vectorText(sample.place) + ": " + light.source + weightText(sample.file.weight));
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

void MakeLight::turn(const sh::Matrix3d& rotation) {
  for (Light& light : lights_) light = rotated(light, rotation);
  for (Vec3d& place : places_) place = rotation * place;
}

void MakeLight::change(Session& session) {
  if (exposure_ != 0) {
    for (Light& light : lights_) light = scaled(light, Vec3d{1, 1, 1} * std::exp2(exposure_));
    note("exposure " + formatNumber(exposure_));
  }
  if (rotate_ != 0) {
    const Vec3d up = map_.up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    turn(sh::rotationAbout(up, rotate_ * std::acos(-1.0) / 180));
    note("rotate " + formatNumber(rotate_));
  }
  for (const std::string& text : turns_) {
    turn(parseTurn("--turn", text));
    note("turn " + text);
  }
  for (const std::string& text : shadows_) {
    const auto n = parseNumbers("--shadow", text, 4, 4, "X,Y,Z,DEG");
    for (Light& light : lights_) light = withProxyShadow(light, {n[0], n[1], n[2]}, n[3], light.order);
    note("shadow " + text);
  }
  for (Light& light : lights_) light = withOrder(light, order_);
  if (window_ == sh::Window::none) return;
  describeWindow(window_, applyWindow(window_, lights_), session.report);
  note("window " + std::string(sh::windowName(window_)));
}

void MakeLight::write(Session& session) const {
  if (places_.empty()) {
    writeLightFile(output_, {lights_[0], map_.up, sources_});
    describeLight(lights_[0], session.report);
    return;
  }
  RigFile file;
  for (std::size_t i = 0; i < places_.size(); ++i) file.samples.push_back({places_[i], lights_[i]});
  file.options = blend_;
  file.up = map_.up;
  file.sources = sources_;
  writeRigFile(output_, file);
  describeRig(file.samples, file.options, session.report);
}

void MakeLight::run(Session& session) {
  checkInputs();
  // A shadow's edge brings bands of the light above the output's down into it.
  workOrder_ = shadows_.empty() ? order_ : std::min(2 * order_ + 8, kMaxLightOrder);
  lights_ = {Light(workOrder_)};
  addFiles(session);
  addSky();
  addSimpleLights();
  addSamples(session);
  change(session);
  session.display.finish();
  write(session);
  session.report.data("sources", sources_);
  session.report.fact("output.file", output_, "output", output_);
}

}  // namespace

extern const VerbEntry lightVerb;
const VerbEntry lightVerb{
    "light", "[FILE...] -o FILE", "make a light file from probes, skies and simple lights",
    "Projects environment maps, CIE skies and simple lights onto spherical harmonics, sums them and writes a light "
    "file. Every pixel is integrated over the part of the sphere that it covers; nothing is clamped unless it is "
    "said.\n"
    "\n"
    "Examples:\n"
    "  shbake light room.hdr -o room.shlight --window auto\n"
    "  shbake light -o noon.shlight --sky clear --sun 60,180 --ground 0.2\n"
    "  shbake light a.exr@0.7 b.shlight@0.3 -o mixed.shlight --rotate 90\n"
    "  shbake light --sample 0,0,1,hall.hdr --sample 6,0,1,porch.hdr -o all.shlight",
    [] { return std::unique_ptr<Verb>(std::make_unique<MakeLight>()); }};

}  // namespace shbake::cli
