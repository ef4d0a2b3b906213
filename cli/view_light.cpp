// The light that relights a mesh or is drawn: skies by name, light files, images of environment maps.
#include "cli/view_light.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "cli/format.h"
#include "cli/light_text.h"
#include "cli/options.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

/// Half the angle under which the sun is seen from the earth, in degrees.
constexpr double kSunHalfAngle = 0.2665;
constexpr double kRadians = std::numbers::pi / 180;

/// A colour of values of 0 or more, from one number or three.
Vec3d parseColor(const std::string& name, const std::string& text) {
  const Vec3d color = colorFrom(parseNumbers(name, text, 1, 3, "GREY or R,G,B"), 0, name);
  if (std::min({color.x, color.y, color.z}) < 0) {
    throw usageError(name + ": " + text + " is out of range", "give numbers of 0 or more");
  }
  return color;
}

/// The light turned by `turn`, and what it was made from with it.
void turnLight(ViewLight& view, const sh::Matrix3d& turn) {
  if (turn == sh::Matrix3d{}) return;
  view.light = rotated(view.light, turn);
  view.radiance = [before = std::move(view.radiance), back = sh::transposed(turn)](const Vec3d& direction) {
    return before(back * direction);
  };
}

RadianceFunction radianceOf(const Light& light) {
  return [light](const Vec3d& direction) { return radianceFrom(light, direction); };
}

}  // namespace

bool isLightFile(const std::string& path) {
  return std::filesystem::path(path).extension() == ".shlight";
}

void ViewLightOptions::declare(CLI::App& app) {
  addOption(app,
            {"--light", "LIGHT",
             "a sky (overcast, clear or partly-cloudy), white (radiance 1 from everywhere), a .shlight file, or an "
             "image of an environment map"},
            name, [this](const std::string&, const std::string& text) { name = text; });
  addOption(app,
            {"--sun", "ALT,AZ",
             "where the sun of a sky stands, in degrees: 0..90 above the horizon, clockwise from north (+y)"},
            "45,0", [this](const std::string& option, const std::string& text) {
              const auto n = parseNumbers(option, text, 2, 2, "ALTITUDE,AZIMUTH in degrees");
              sky_.sunAltitude = n[0];
              sky_.sunAzimuth = n[1];
            });
  addOption(app,
            {"--sun-irradiance", "E",
             "what the sun's disc adds to a sky on a surface that faces it: one number of 0 or more, or R,G,B"},
            "0",
            [this](const std::string& option, const std::string& text) { sunIrradiance_ = parseColor(option, text); });
  addOption(app, {"--zenith", "L", "radiance of a sky at the zenith: one number of 0 or more, or R,G,B"}, "1",
            [this](const std::string& option, const std::string& text) { sky_.zenith = parseColor(option, text); });
  addOption(
      app, {"--ground", "A", "albedo of the ground below a sky's horizon: one number in 0..1, or R,G,B"}, "0",
      [this](const std::string& option, const std::string& text) { sky_.groundAlbedo = parseColor(option, text); });
  addReal(app, {"--rotate", "DEG", "turns the light about the axis that points up, -360..360, counter-clockwise"},
          turn_, -360, 360);
  addChoice<UpAxis>(app, {"--up", "AXIS", "the axis of the mesh that points up: z or y"}, up,
                    {{"z", UpAxis::z}, {"y", UpAxis::y}});
  addChoice<sh::Window>(app,
                        {"--window", "KIND",
                         "damps the light's ringing: none, hann, lanczos, gauss, or auto (as little as leaves no "
                         "negative light)"},
                        window_,
                        {{"none", sh::Window::none},
                         {"hann", sh::Window::hann},
                         {"lanczos", sh::Window::lanczos},
                         {"gauss", sh::Window::gauss},
                         {"auto", sh::Window::automatic}});
}

ViewLight ViewLightOptions::makeSky(int order) const {
  ViewLight view;
  view.exact = true;
  if (name == "white") {
    view.light = constantLight(order, {1, 1, 1});
    view.radiance = [](const Vec3d&) { return Vec3d{1, 1, 1}; };
    view.description = "white light from everywhere";
    return view;
  }
  SkyOptions sky = sky_;
  sky.model = *skyNamed(name);
  const Vec3d sun = sunDirection(sky);
  view.light = skyLight(order, sky);
  addLight(view.light, discLightOfIrradiance(order, sun, kSunHalfAngle, sunIrradiance_));
  const double sine = std::sin(kSunHalfAngle * kRadians), cosine = std::cos(kSunHalfAngle * kRadians);
  const Vec3d disc = sunIrradiance_ * (1 / (std::numbers::pi * sine * sine));
  const Vec3d fromGround = skyIrradiance(sky) * std::numbers::inv_pi;
  const Vec3d ground{sky.groundAlbedo.x * fromGround.x, sky.groundAlbedo.y * fromGround.y,
                     sky.groundAlbedo.z * fromGround.z};
  view.radiance = [=](const Vec3d& d) {
    if (d.z < 0) return ground;
    return dot(d, sun) >= cosine ? skyRadiance(sky, d) + disc : skyRadiance(sky, d);
  };
  view.description = name + " sky";
  const bool sunCounts = sky.model != SkyModel::overcast || sunIrradiance_ != Vec3d{};
  if (sunCounts) {
    view.description += ", sun at " + formatNumber(sky.sunAltitude) + "," + formatNumber(sky.sunAzimuth) + " degrees";
  }
  return view;
}

ViewLight ViewLightOptions::readImage(int order, Session& session) const {
  const EnvironmentMapLight map = projectEnvironmentMap(name, order, {}, session.parallel, session.progress);
  for (const std::string& note : map.notes) session.warn(name + ": " + note);
  if (map.badPixels.total() > 0) {
    session.warn(name + ": " + formatCount(map.badPixels.total()) +
                 " pixels are negative or not finite; 'shbake light' tells which and how they count");
  }
  ViewLight view;
  view.light = map.light;
  view.description = name + " (" + layoutName(map.layout) + ")";
  const auto image = LatLongImage::read(name, PixelEncoding::automatic, session.parallel.threads());
  view.exact = image.has_value();
  if (image) {
    view.radiance = [image = std::make_shared<LatLongImage>(*image)](const Vec3d& d) { return Vec3d(image->from(d)); };
  } else {
    view.radiance = radianceOf(view.light);
  }
  return view;
}

ViewLight ViewLightOptions::make(int order, Session& session) const {
  ViewLight view;
  sh::Matrix3d turn = axesFor(up) * sh::rotationAboutZ(turn_ * kRadians);
  if (name == "white" || skyNamed(name)) {
    view = makeSky(order);
  } else if (isLightFile(name)) {
    const LightFile file = readLightFile(name);
    view.light = withOrder(file.light, std::min(order, file.light.order));
    view.radiance = radianceOf(file.light);
    view.description = name;
    turn = turn * sh::transposed(axesFor(file.up));
  } else {
    view = readImage(order, session);
  }
  turnLight(view, turn);
  view.light = usedLight(view.light, order, window_);
  if (!view.exact) view.radiance = radianceOf(view.light);
  return view;
}

}  // namespace shbake::cli
