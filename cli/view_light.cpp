// The light that relights a mesh or is drawn: skies by name, light files, images of environment maps.
#include "cli/view_light.h"

#include <algorithm>
#include <numbers>

#include "cli/format.h"
#include "cli/light_options.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

RadianceFunction radianceOf(const Light& light) {
  return [light](const Vec3d& direction) { return radianceFrom(light, direction); };
}

/// The light with its bands damped. Samples of a rig are damped alike.
ViewLight windowed(ViewLight view, sh::Window window) {
  if (!view.rig) {
    applyWindow(window, {&view.light, 1});
    return view;
  }
  std::vector<Light> lights;
  std::vector<LightSample> samples = view.rig->samples();
  for (const LightSample& s : samples) lights.push_back(s.light);
  applyWindow(window, lights);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].light = lights[i];
  view.rig = std::make_shared<LightRig>(std::move(samples), view.rig->options());
  return view;
}

}  // namespace

RadianceFunction ViewLight::seenFrom(const Vec3d& place) const {
  return source ? source : radianceOf(at(place));
}

std::vector<Rgb> ViewLight::colors(const TransferSet& transfer, std::span<const Vec3d> places,
                                   const RelightOptions& options, const Parallel& parallel) const {
  return rig ? relight(transfer, places, *rig, options, parallel) : relight(transfer, light, options, parallel);
}

ViewLight ViewLight::turned(const sh::Matrix3d& rotation, const Vec3d& about) const {
  if (rotation == sh::Matrix3d{}) return *this;
  ViewLight result = *this;
  result.light = rotated(light, rotation);
  if (rig) result.rig = std::make_shared<LightRig>(rotated(*rig, rotation, about));
  if (source) {
    result.source = [before = source, back = sh::transposed(rotation)](const Vec3d& direction) {
      return before(back * direction);
    };
  }
  return result;
}

void ViewLightOptions::declare(CLI::App& app) {
  addOption(app,
            {"--light", "LIGHT",
             "a sky (overcast, clear or partly-cloudy), white (radiance 1 from everywhere), a .shlight file (one light "
             "or a rig of local ones), or an image of an environment map"},
            name, [this](const std::string&, const std::string& text) { name = text; });
  addSkyOptions(app, sky_);
  addOption(app,
            {"--sun-irradiance", "E",
             "what the sun's disc adds to a sky on a surface that faces it: one number of 0 or more, or R,G,B"},
            "0",
            [this](const std::string& option, const std::string& text) { sunIrradiance_ = parseColor(option, text); });
  addMapOptions(app, map_);
  addReal(app,
          {"--rotate", "DEG",
           "turns the light about the axis that points up, -360..360, counter-clockwise; a rig about the origin"},
          turn_, -360, 360);
  addChoice<UpAxis>(app, {"--up", "AXIS", "the axis of the mesh that points up: z or y"}, up,
                    {{"z", UpAxis::z}, {"y", UpAxis::y}});
  addWindow(app, "damp the light's", window_);
}

ViewLight ViewLightOptions::makeSky(int order) const {
  ViewLight view;
  if (name == "white") {
    view.light = constantLight(order, {1, 1, 1});
    view.source = [](const Vec3d&) { return Vec3d{1, 1, 1}; };
    view.description = "white light from everywhere";
    return view;
  }
  SkyWithSun choice{sky_, sunIrradiance_};
  choice.sky.model = *skyNamed(name);
  view.light = skyWithSunLight(order, choice);
  view.source = skyWithSunRadiance(choice);
  view.description = describeSkyWithSun(choice);
  return view;
}

ViewLight ViewLightOptions::readFile(int order) const {
  ViewLight view;
  view.description = name;
  UpAxis fileUp = UpAxis::z;
  if (isRigFile(name)) {
    RigFile file = readRigFile(name);
    fileUp = file.up;
    for (LightSample& s : file.samples) s.light = withOrder(s.light, std::min(order, s.light.order));
    view.description +=
        " (" + std::to_string(file.samples.size()) + " local lights, " + blendName(file.options.method) + ")";
    view.rig = std::make_shared<LightRig>(std::move(file.samples), file.options);
  } else {
    const LightFile file = readLightFile(name);
    fileUp = file.up;
    view.light = withOrder(file.light, std::min(order, file.light.order));
  }
  return view.turned(sh::transposed(axesFor(fileUp)), {});
}

ViewLight ViewLightOptions::readImage(int order, bool withSource, Session& session) const {
  const EnvironmentMapLight map = projectEnvironmentMap(name, order, map_, session.parallel, session.progress);
  for (const std::string& note : map.notes) session.warn(name + ": " + note);
  if (map.badPixels.total() > 0) {
    session.warn(name + ": " + formatCount(map.badPixels.total()) +
                 " pixels are negative or not finite; 'shbake light' tells which and how they count");
  }
  ViewLight view;
  view.light = map.light;
  view.description = name + " (" + layoutName(map.layout) + ")";
  if (withSource) {
    const auto image = std::make_shared<MapImage>(MapImage::read(name, map_, session.parallel.threads()));
    view.source = [image](const Vec3d& d) { return Vec3d(image->from(d)); };
  }
  return view;
}

ViewLight ViewLightOptions::make(int order, bool withSource, Session& session) const {
  const bool sky = name == "white" || skyNamed(name);
  const ViewLight view = sky                 ? makeSky(order)
                         : isLightFile(name) ? readFile(order)
                                             : readImage(order, withSource, session);
  const sh::Matrix3d turn = axesFor(up) * sh::rotationAboutZ(turn_ * kRadians);
  return windowed(view.turned(turn, {}), window_);
}

}  // namespace shbake::cli
