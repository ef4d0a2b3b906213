// Lights on the command line: what people type to describe them, and how they are told.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/report.h"
#include "shbake.h"

namespace shbake::cli {

/// Finite numbers with commas between; throws a usage error "NAME: 'TEXT' is not FORM" when there are fewer than
/// `least` or more than `most`. `form` shows what is expected: "X,Y,Z".
std::vector<double> parseNumbers(const std::string& name, const std::string& text, std::size_t least, std::size_t most,
                                 const std::string& form);

/// One number for all channels, or three: from `numbers[first]` on.
Vec3d colorFrom(const std::vector<double>& numbers, std::size_t first, const std::string& name);

/// A rotation about an axis from "X,Y,Z,DEG".
sh::Matrix3d parseTurn(const std::string& name, const std::string& text);

/// A file name with an optional weight behind an @: "probe.hdr@0.5" or "probe.hdr@1,0.9,0.8".
struct WeightedFile {
  std::string path;
  Vec3d weight{1, 1, 1};
};
WeightedFile parseWeightedFile(const std::string& text);

/// True for the name of a light file.
bool isLightFile(const std::string& path);
/// Throws a usage error for an output that is not named as one.
void requireLightFileName(const std::string& path);

/// "(0.12, -0.5, 0.86)".
std::string vectorText(const Vec3d& v);

/// Adds to `report` the window that damped a light, and its lambda for Window::automatic.
void describeWindow(sh::Window window, double lambda, Report& report);

/// Adds to `report` how samples are blended, and place and mean radiance of each.
void describeRig(std::span<const LightSample> samples, const RigOptions& options, Report& report);

/// Adds to `report`: order, mean radiance, share of each band in the energy, least and greatest radiance (luminance)
/// and where, direction and |R1|/R0.
void describeLight(const Light& light, Report& report);

}  // namespace shbake::cli
