// Options about light that several verbs have, each declared in one place.
#pragma once

#include <string>
#include <vector>

#include "cli/options.h"
#include "shbake.h"

namespace shbake::cli {

/// Adds --sun, --zenith and --ground, which all CIE skies have.
void addSkyOptions(CLI::App& app, SkyOptions& sky);

/// Adds --layout, --mirror, --keep-negative and --encoding: how an image of an environment map is read.
void addMapOptions(CLI::App& app, EnvironmentMapOptions& map);

/// Adds --window; `when` opens the help's sentence: "damp", "then damp".
void addWindow(CLI::App& app, const std::string& when, sh::Window& window);

/// Radiance as a display shows it: --exposure and --tone.
struct DisplayOptions {
  ToneMap tone;
  bool automatic = true;  ///< the exposure is chosen to suit what is shown

  /// `what` is exposed: "bytes", "the picture".
  void declare(CLI::App& app, const std::string& what);
};

/// A colour of values of 0 or more, from one number or three; throws a usage error for others.
Vec3d parseColor(const std::string& name, const std::string& text);

}  // namespace shbake::cli
