// Options about light that several verbs have.
#include "cli/light_options.h"

#include <algorithm>

#include "cli/light_text.h"
#include "cli/parse.h"

namespace shbake::cli {

Vec3d parseColor(const std::string& name, const std::string& text) {
  const Vec3d color = colorFrom(parseNumbers(name, text, 1, 3, "GREY or R,G,B"), 0, name);
  if (std::min({color.x, color.y, color.z}) < 0) {
    throw usageError(name + ": " + text + " is out of range", "give numbers of 0 or more");
  }
  return color;
}

void addSkyOptions(CLI::App& app, SkyOptions& sky) {
  addOption(app,
            {"--sun", "ALT,AZ",
             "where the sun of a sky stands, in degrees: 0..90 above the horizon, clockwise from north (+y)"},
            "45,0", [&sky](const std::string& name, const std::string& text) {
              const auto n = parseNumbers(name, text, 2, 2, "ALTITUDE,AZIMUTH in degrees");
              sky.sunAltitude = n[0];
              sky.sunAzimuth = n[1];
            });
  addOption(app, {"--zenith", "L", "radiance of a sky at the zenith: one number of 0 or more, or R,G,B"}, "1",
            [&sky](const std::string& name, const std::string& text) { sky.zenith = parseColor(name, text); });
  addOption(app, {"--ground", "A", "albedo of the ground below a sky's horizon: one number in 0..1, or R,G,B"}, "0",
            [&sky](const std::string& name, const std::string& text) { sky.groundAlbedo = parseColor(name, text); });
}

void addMapOptions(CLI::App& app, EnvironmentMapOptions& map) {
  std::vector<std::pair<std::string, MapLayout>> layouts;
  std::string names;
  for (const std::string& name : layoutNames()) {
    layouts.emplace_back(name, *layoutNamed(name));
    names += (names.empty() ? "" : ", ") + name;
  }
  addChoice<MapLayout>(app, {"--layout", "NAME", "layout of an image: " + names}, map.layout, layouts);
  addSwitch(app, "--mirror", map.mirror, "images show the world mirrored: exchange left and right");
  addSwitch(app, "--keep-negative", map.keepNegative, "count negative pixels as they are instead of as 0");
  addChoice<PixelEncoding>(
      app,
      {"--encoding", "KIND", "what pixels are: linear, srgb (display values), or auto: integers srgb, floats linear"},
      map.encoding,
      {{"auto", PixelEncoding::automatic}, {"linear", PixelEncoding::linear}, {"srgb", PixelEncoding::srgb}});
}

void addWindow(CLI::App& app, const std::string& when, sh::Window& window) {
  addChoice<sh::Window>(app,
                        {"--window", "KIND",
                         when + " high bands against ringing: none, hann, lanczos, gauss, or auto: just enough to "
                                "leave nothing negative"},
                        window,
                        {{"none", sh::Window::none},
                         {"hann", sh::Window::hann},
                         {"lanczos", sh::Window::lanczos},
                         {"gauss", sh::Window::gauss},
                         {"auto", sh::Window::automatic}});
}

void DisplayOptions::declare(CLI::App& app, const std::string& what) {
  addOption(app,
            {"--exposure", "EV",
             "brightens " + what + " by 2^EV, -100..100, or auto: the brightest 1 % of the surface become white"},
            "auto", [this](const std::string& name, const std::string& text) {
              automatic = text == "auto";
              if (!automatic) tone.exposure = parseReal(name, text, -100, 100);
            });
  addChoice<ToneCurve>(app, {"--tone", "CURVE", "how " + what + " end at white: clip, reinhard or filmic"}, tone.curve,
                       {{"clip", ToneCurve::clip}, {"reinhard", ToneCurve::reinhard}, {"filmic", ToneCurve::filmic}});
}

}  // namespace shbake::cli
