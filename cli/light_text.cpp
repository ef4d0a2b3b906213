// Lights on the command line.
#include "cli/light_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "cli/format.h"
#include "cli/parse.h"

namespace shbake::cli {
namespace {

constexpr double kMost = 1e30;  // far from where squares of coefficients overflow

std::vector<double> asList(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

Vec3d meanRadiance(const Light& light) {
  return light.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
}

void describeRange(const Light& light, Report& report) {
  const sh::Range range = sh::valueRange(light.order, luminance(light));
  const auto add = [&](const std::string& key, const sh::Extreme& extreme) {
    report.data("radiance." + key + "_direction", asList(extreme.direction));
    report.fact("radiance." + key, extreme.value, key == "min" ? "darkest" : "brightest",
                formatNumber(extreme.value, 5) + " from " + vectorText(extreme.direction) +
                    (extreme.value < 0 ? ": negative by ringing; a window lessens it" : ""));
  };
  add("min", range.min);
  add("max", range.max);
}

/// Each band's share, of many bands the first ones' and what is left.
std::string energyText(const std::vector<double>& energies, double total) {
  constexpr std::size_t kShown = 8;
  const auto share = [&](double e) { return formatPercent(total > 0 ? e / total : 0); };
  std::string text;
  double rest = 0;
  for (std::size_t l = 0; l < energies.size(); ++l) {
    if (l < kShown) text += (l == 0 ? "" : ", ") + share(energies[l]);
    if (l >= kShown) rest += energies[l];
  }
  return energies.size() <= kShown
             ? text
             : text + ", " + share(rest) + " in the other " + std::to_string(energies.size() - kShown);
}

}  // namespace

std::vector<double> parseNumbers(const std::string& name, const std::string& text, std::size_t least, std::size_t most,
                                 const std::string& form) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) numbers.push_back(parseReal(name, part, -kMost, kMost));
  if (numbers.size() < least || numbers.size() > most || text.ends_with(',')) {
    throw usageError(name + ": '" + text + "' has " + std::to_string(numbers.size()) + " numbers", "give " + form);
  }
  return numbers;
}

Vec3d colorFrom(const std::vector<double>& numbers, std::size_t first, const std::string& name) {
  const std::size_t count = numbers.size() - first;
  if (count == 1) return Vec3d{1, 1, 1} * numbers[first];
  if (count == 3) return {numbers[first], numbers[first + 1], numbers[first + 2]};
  throw usageError(name + ": a colour has one number or three, not " + std::to_string(count),
                   "give GREY or R,G,B at the end");
}

sh::Matrix3d parseTurn(const std::string& name, const std::string& text) {
  const std::vector<double> n = parseNumbers(name, text, 4, 4, "X,Y,Z,DEG: an axis and an angle in degrees");
  return sh::rotationAbout({n[0], n[1], n[2]}, n[3] * std::acos(-1.0) / 180);
}

WeightedFile parseWeightedFile(const std::string& text) {
  const std::size_t at = text.rfind('@');
  const bool hasWeight = at != std::string::npos && at > 0 && at + 1 < text.size() &&
                         text.find_first_not_of("0123456789.,eE+-", at + 1) == std::string::npos;
  if (!hasWeight) return {text};
  const std::vector<double> numbers = parseNumbers(text, text.substr(at + 1), 1, 3, "FILE@WEIGHT or FILE@R,G,B");
  return {text.substr(0, at), colorFrom(numbers, 0, text)};
}

bool isLightFile(const std::string& path) {
  return std::filesystem::path(path).extension() == ".shlight";
}

void requireLightFileName(const std::string& path) {
  if (isLightFile(path)) return;
  throw Error(
      {.kind = ErrorKind::usage, .file = path, .cause = "is not named as a light file", .remedy = "name it .shlight"});
}

std::string vectorText(const Vec3d& v) {
  std::string text;
  for (const double x : {v.x, v.y, v.z}) {
    text += text.empty() ? '(' : ' ';
    text += formatNumber(std::abs(x) < 1e-12 ? 0.0 : x, 4);
    text += ',';
  }
  text.back() = ')';
  return text;
}

void describeWindow(sh::Window window, double lambda, Report& report) {
  const bool automatic = window == sh::Window::automatic;
  report.fact("window.lambda", lambda, "window",
              std::string(sh::windowName(window)) + (automatic ? ", lambda " + formatNumber(lambda, 4) : ""));
}

void describeRig(std::span<const LightSample> samples, const RigOptions& options, Report& report) {
  const bool hasPower = options.method == RigMethod::inverseDistance;
  report.fact("order", std::int64_t(samples[0].light.order), "order", std::to_string(samples[0].light.order));
  report.fact("rig.blend", std::string(blendName(options.method)), "rig",
              std::to_string(samples.size()) + " local lights, " + blendName(options.method) +
                  (hasPower ? ", power " + formatNumber(options.power) : ""));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string key = "rig.samples." + std::to_string(i);
    const Vec3d mean = meanRadiance(samples[i].light);
    report.data(key + ".position", asList(samples[i].position));
    report.fact(key + ".mean", asList(mean), "at " + vectorText(samples[i].position),
                "mean " + vectorText(mean) + " red, green, blue");
  }
}

void describeLight(const Light& light, Report& report) {
  const int n = light.order;
  report.fact("order", std::int64_t(n), "order",
              std::to_string(n) + (n == 1 ? " band, " : " bands, ") + std::to_string(n * n) +
                  " coefficients a channel, degree up to " + std::to_string(n - 1));
  const Vec3d mean = meanRadiance(light);
  report.fact("radiance.mean", asList(mean), "mean", vectorText(mean) + " red, green, blue");

  std::vector<double> energies;
  double total = 0;
  for (const Vec3d& e : bandEnergies(light)) {
    energies.push_back(e.x + e.y + e.z);
    total += energies.back();
  }
  report.fact("band_energy", energies, "energy",
              energyText(energies, total) + " by band, of " + formatNumber(total, 5));

  describeRange(light, report);
  const Dominant dominant = dominantDirection(light);
  report.data("direction", asList(dominant.direction));
  report.fact("r1_over_r0", dominant.ratio, "direction",
              n < 2 ? "none at order 1"
                    : vectorText(dominant.direction) + ", |R1|/R0 = " + formatNumber(dominant.ratio, 4) +
                          " (0 even, 1 from one direction)");
}

}  // namespace shbake::cli
