// Parameters of the filters that relight and save, and of the format.
#include "meshlab_plugin/api.h"
#include "meshlab_plugin/parameter_values.h"
#include "meshlab_plugin/parameters.h"

namespace shbake::meshlab {
namespace {

QStringList listOf(const std::vector<std::string>& names) {
  QStringList list;
  for (const std::string& name : names) list << QString::fromStdString(name);
  return list;
}

const std::vector<sh::Window>& windows() {
  static const std::vector<sh::Window> all{sh::Window::none, sh::Window::hann, sh::Window::lanczos, sh::Window::gauss,
                                           sh::Window::automatic};
  return all;
}

}  // namespace

const int kFormatMask = vcg::tri::io::Mask::IOM_VERTCOLOR | vcg::tri::io::Mask::IOM_VERTNORMAL |
                        vcg::tri::io::Mask::IOM_VERTQUALITY | vcg::tri::io::Mask::IOM_FACECOLOR;

void declareFormat(RichParameterList& p) {
  p.addParam(RichBool("ascii", false, "Text", "Write the file as text instead of binary."));
}

bool formatIsAscii(const RichParameterList& p) {
  return p.getBool("ascii");
}

void declareRelight(RichParameterList& p) {
  p.addParam(RichEnum("light", 0, listOf(lightKindNames()), "Light",
                      "Skies of the CIE, the same radiance from everywhere, a disc, or a file."));
  p.addParam(
      OpenFileParameter("light_file", "",
                        QStringList() << "*.hdr"
                                      << "*.exr"
                                      << "*.shlight"
                                      << "*.png"
                                      << "*.jpg"
                                      << "*.tif",
                        "Light file",
                        "An image of an environment map, or a light file of 'shbake light'; used where the light "
                        "is File. Give the whole path."));
  p.addParam(RichDynamicFloat("rotation", 0.0f, -180.0f, 180.0f, "Rotation",
                              "Turns the light about the axis that points up, in degrees, counter-clockwise seen from "
                              "above."));
  p.addParam(RichDynamicFloat("exposure", 0.0f, -8.0f, 8.0f, "Exposure",
                              "Brightens the colours by 2 to this power; added to the automatic exposure where that is "
                              "on."));
  p.addParam(RichBool("auto_exposure", true, "Automatic exposure", "Make the brightest 1 % of the surface white."));
  p.addParam(RichDynamicFloat("sun_altitude", 45.0f, 0.0f, 90.0f, "Sun altitude",
                              "Degrees above the horizon: of the sun of a sky, or of the disc."));
  p.addParam(
      RichDynamicFloat("sun_azimuth", 0.0f, -180.0f, 180.0f, "Sun azimuth",
                       "Degrees clockwise from north (+y), seen from above: of the sun of a sky, or of the disc."));
  p.addParam(
      RichFloat("sun_irradiance", 0.0f, "Sun irradiance",
                "What the disc of the sun adds to a sky, on a surface that faces it. The sky's zenith has radiance "
                "1."));
  p.addParam(
      RichFloat("disc_angle", 10.0f, "Disc half angle", "Half the angle under which the disc is seen, 0 to 90."));
  p.addParam(RichFloat("ground", 0.0f, "Ground albedo", "Of the ground below the horizon of a sky, 0 to 1."));
  p.addParam(RichEnum("up", 0,
                      QStringList() << "z"
                                    << "y",
                      "Up axis", "The axis of the mesh that points up."));
  p.addParam(RichEnum("tone", 0,
                      QStringList() << "Clip"
                                    << "Reinhard"
                                    << "Filmic",
                      "Tone curve", "How bright colours end at white."));
  p.addParam(RichEnum("window", 0,
                      QStringList() << "None"
                                    << "Hann"
                                    << "Lanczos"
                                    << "Gauss"
                                    << "Automatic",
                      "Window",
                      "Damps the ringing of small bright lights; automatic takes the least that leaves no light "
                      "negative."));
}

RelightChoice relightChoice(const RichParameterList& p) {
  RelightChoice choice;
  LightChoice& light = choice.light;
  light.kind = choiceOf<LightKind>(p, "light", "Light",
                                   {LightKind::overcast, LightKind::clear, LightKind::partlyCloudy, LightKind::white,
                                    LightKind::disc, LightKind::file});
  light.file = p.getOpenFileName("light_file").toStdString();
  light.turn = sliderOf(p, "rotation", "Rotation", -360, 360);
  light.sunAltitude = sliderOf(p, "sun_altitude", "Sun altitude", 0, 90);
  light.sunAzimuth = sliderOf(p, "sun_azimuth", "Sun azimuth", -360, 360);
  light.sunIrradiance = realOf(p, "sun_irradiance", "Sun irradiance", 0, 1e6);
  light.discHalfAngle = realOf(p, "disc_angle", "Disc half angle", 0, 90);
  light.ground = realOf(p, "ground", "Ground albedo", 0, 1);
  light.up = choiceOf<UpAxis>(p, "up", "Up axis", {UpAxis::z, UpAxis::y});
  light.window = choiceOf<sh::Window>(p, "window", "Window", windows());
  choice.automaticExposure = p.getBool("auto_exposure");
  choice.tone.exposure = sliderOf(p, "exposure", "Exposure", -100, 100);
  choice.tone.curve =
      choiceOf<ToneCurve>(p, "tone", "Tone curve", {ToneCurve::clip, ToneCurve::reinhard, ToneCurve::filmic});
  validate(light);
  return choice;
}

void declareSave(RichParameterList& p) {
  p.addParam(SaveFileParameter("file", "", "*.ply", "File", "The PLY file to write; give the whole path."));
  p.addParam(RichEnum("colors", 0,
                      QStringList() << "Those from before the bake"
                                    << "Those that are shown"
                                    << "None",
                      "Vertex colours", "Which colours the file gets beside the transfer."));
  p.addParam(RichBool("ascii", false, "Text", "Write the file as text instead of binary."));
}

SaveChoice saveChoice(const RichParameterList& p) {
  SaveChoice choice;
  choice.path = p.getSaveFileName("file").toStdString();
  if (choice.path.empty()) throw usageError("File: no file is named", "name the PLY file to write");
  choice.colors =
      choiceOf<SavedColors>(p, "colors", "Vertex colours", {SavedColors::own, SavedColors::shown, SavedColors::none});
  choice.ascii = p.getBool("ascii");
  return choice;
}

}  // namespace shbake::meshlab
