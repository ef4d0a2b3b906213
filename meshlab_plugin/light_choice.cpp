// Light from choices: skies, a disc, environment maps and light files.
#include "meshlab_plugin/light_choice.h"

#include <algorithm>
#include <filesystem>
#include <numbers>

namespace shbake::meshlab {
namespace {

namespace fs = std::filesystem;

constexpr double kRadians = std::numbers::pi / 180;

void requireRange(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %g is out of range", name, value);
  char range[80];
  std::snprintf(range, sizeof range, "give %g to %g", least, most);
  throw usageError(text, range);
}

SkyOptions skyOf(const LightChoice& choice) {
  SkyOptions sky;
  sky.model = choice.kind == LightKind::clear          ? SkyModel::clear
              : choice.kind == LightKind::partlyCloudy ? SkyModel::partlyCloudy
                                                       : SkyModel::overcast;
  sky.sunAltitude = choice.sunAltitude;
  sky.sunAzimuth = choice.sunAzimuth;
  sky.groundAlbedo = Vec3d{1, 1, 1} * choice.ground;
  return sky;
}

}  // namespace

const std::vector<std::string>& lightKindNames() {
  static const std::vector<std::string> names{
      "Overcast sky (CIE)", "Clear sky (CIE)", "Partly cloudy sky (CIE)", "White from everywhere", "Disc", "File"};
  return names;
}

void validate(const LightChoice& choice) {
  requireRange("Sun altitude", choice.sunAltitude, 0, 90);
  requireRange("Sun azimuth", choice.sunAzimuth, -360, 360);
  requireRange("Sun irradiance", choice.sunIrradiance, 0, 1e6);
  requireRange("Disc half angle", choice.discHalfAngle, 0, 90);
  requireRange("Ground albedo", choice.ground, 0, 1);
  requireRange("Rotation", choice.turn, -360, 360);
  if (choice.kind == LightKind::file && choice.file.empty()) {
    throw usageError("Light file: no file is named", "choose an HDR or EXR image, or a .shlight file");
  }
}

const Light& LightMaker::readFile(const std::string& path, int order, const Parallel& parallel, Progress& progress,
                                  std::vector<std::string>& notes) {
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  const long long time = error ? 0 : static_cast<long long>(written.time_since_epoch().count());
  if (path != path_ || time != time_ || order != order_) {
    path_.clear();  // nothing is kept of a file that fails
    notes_.clear();
    if (fs::path(path).extension() == ".shlight") {
      const LightFile file = readLightFile(path);
      light_ = rotated(withOrder(file.light, std::min(order, file.light.order)), sh::transposed(axesFor(file.up)));
    } else {
      const EnvironmentMapLight map = projectEnvironmentMap(path, order, {}, parallel, progress);
      light_ = map.light;
      notes_ = map.notes;
      if (map.badPixels.total() > 0) {
        notes_.push_back(std::to_string(map.badPixels.total()) +
                         " pixels are negative or not finite; 'shbake light' tells which and how they count");
      }
    }
    path_ = path;
    time_ = time;
    order_ = order;
  }
  for (const std::string& note : notes_) notes.push_back(path + ": " + note);
  return light_;
}

Light LightMaker::make(const LightChoice& choice, int order, const Parallel& parallel, Progress& progress,
                       std::vector<std::string>& notes) {
  validate(choice);
  Light light(order);
  switch (choice.kind) {
    case LightKind::overcast:
    case LightKind::clear:
    case LightKind::partlyCloudy:
      light = skyWithSunLight(order, {skyOf(choice), Vec3d{1, 1, 1} * choice.sunIrradiance});
      break;
    case LightKind::white:
      light = constantLight(order, {1, 1, 1});
      break;
    case LightKind::disc:
      light = discLightOfIrradiance(order, sunDirection(skyOf(choice)), choice.discHalfAngle,
                                    Vec3d{1, 1, 1} * std::numbers::pi);
      break;
    case LightKind::file:
      light = readFile(choice.file, order, parallel, progress, notes);
      break;
  }
  const sh::Matrix3d turn = axesFor(choice.up) * sh::rotationAboutZ(choice.turn * kRadians);
  if (turn != sh::Matrix3d{}) light = rotated(light, turn);
  return usedLight(light, order, choice.window);
}

}  // namespace shbake::meshlab
