// `shbake sh`: a calculator for spherical-harmonic coefficients.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

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

/// How coefficients are written down outside of light files.
enum class Convention { shbake, condonShortley, geodesy, hazel };

const std::vector<std::pair<std::string, Convention>> kConventions{{"shbake", Convention::shbake},
                                                                   {"condon-shortley", Convention::condonShortley},
                                                                   {"geodesy", Convention::geodesy},
                                                                   {"hazel", Convention::hazel}};
const std::vector<std::pair<std::string, UpAxis>> kAxes{{"z", UpAxis::z}, {"y", UpAxis::y}};

/// Numbers a channel in Hazel's form: R0, R1 x y z, R2 xx yy zz xy xz yz.
constexpr std::size_t kHazelNumbers = 10;

std::vector<double> hazelNumbers(const sh::HazelLight& h) {
  return {h.r0, h.r1.x, h.r1.y, h.r1.z, h.xx, h.yy, h.zz, h.xy, h.xz, h.yz};
}

/// Order 3 from ten numbers (grey), or ten for red, ten for green and ten for blue. R2 has no trace: a file that gives
/// it one holds something else.
Light lightFromHazel(const std::string& path, const std::vector<double>& numbers) {
  if (numbers.size() != kHazelNumbers && numbers.size() != 3 * kHazelNumbers) {
    throw Error({.file = path,
                 .cause = "holds " + std::to_string(numbers.size()) + " numbers where Hazel's form has 10 a channel",
                 .remedy = "give R0, R1 x y z, R2 xx yy zz xy xz yz, once (grey) or for red, green and blue"});
  }
  Light light(3);
  for (int c = 0; c < 3; ++c) {
    const double* n = &numbers[numbers.size() == kHazelNumbers ? 0 : c * kHazelNumbers];
    const double size = std::abs(n[4]) + std::abs(n[5]) + std::abs(n[6]);
    // Numbers of six digits leave a trace of a few millionths.
    if (std::abs(n[4] + n[5] + n[6]) > 1e-5 * size) {
      throw Error({.file = path,
                   .cause = "R2 xx + yy + zz is not 0",
                   .remedy = "give the traceless matrix: a third of the trace is part of R0"});
    }
    light.setChannel(c, sh::toCoefficients({n[0], {n[1], n[2], n[3]}, n[4], n[5], n[6], n[7], n[8], n[9]}));
  }
  return light;
}

Light converted(const Light& light, Convention convention, bool to) {
  Light result(light.order);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values = light.channel(c);
    if (convention == Convention::condonShortley) sh::flipCondonShortley(light.order, values);
    if (convention == Convention::geodesy) {
      to ? sh::toGeodesy(light.order, values) : sh::fromGeodesy(light.order, values);
    }
    result.setChannel(c, values);
  }
  return result;
}

/// The numbers of a text; '#' begins a comment.
std::vector<double> readNumbers(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error({.file = path, .cause = "cannot be opened", .remedy = "correct the path"});
  constexpr std::size_t kMostNumbers = 3 * std::size_t(kMaxLightOrder) * kMaxLightOrder;
  std::vector<double> numbers;
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    for (char& c : text) c = c == ',' || c == ';' || c == '\r' ? ' ' : c;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      if (word[0] == '#') break;
      try {
        numbers.push_back(parseReal("", word, -1e30, 1e30));
      } catch (const Error&) {
        throw Error({.file = path,
                     .place = "line " + std::to_string(line),
                     .cause = "'" + word.substr(0, 40) + "' is not a number within 1e30",
                     .remedy = "give a light file, or a text of n^2 or 3 n^2 numbers"});
      }
      if (numbers.size() > kMostNumbers) {
        throw Error({.file = path, .cause = "holds more numbers than order 128 has", .remedy = "give fewer"});
      }
    }
  }
  return numbers;
}

/// Coefficients from n^2 numbers for grey light, or n^2 rows of three.
Light lightFromCoefficients(const std::string& path, const std::vector<double>& numbers) {
  for (const std::size_t channels : {std::size_t(1), std::size_t(3)}) {
    const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(numbers.size() / channels))));
    if (order < 1 || order > kMaxLightOrder || channels * order * order != numbers.size()) continue;
    Light light(order);
    for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
      const double* n = &numbers[i * channels];
      light.coefficients[i] = channels == 1 ? Vec3d{n[0], n[0], n[0]} : Vec3d{n[0], n[1], n[2]};
    }
    return light;
  }
  throw Error({.file = path,
               .cause = "holds " + std::to_string(numbers.size()) + " numbers, neither n^2 (grey) nor 3 n^2 (colour)",
               .remedy = "give all coefficients of an order"});
}

class Calculate : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  LightFile read(const std::string& path) const;
  void calculate(Session& session);
  void multiply();
  void describeDirections(Report& report) const;
  void print(Report& report) const;
  void printHazel(Report& report) const;

  std::string input_, output_, factor_;
  bool force_ = false;
  std::vector<std::string> turns_, directions_;
  std::string mirror_ = "none";
  int order_ = 0;
  bool print_ = false;
  std::optional<UpAxis> fromUp_, toUp_;
  sh::Window window_ = sh::Window::none;
  Convention from_ = Convention::shbake, to_ = Convention::shbake;
  LightFile file_;
};

/// Adds a choice of axes that is left open unless it is given.
void addAxes(CLI::App& app, const OptionText& text, const std::string& defaultText, std::optional<UpAxis>& up) {
  addOption(app, text, defaultText, [&up](const std::string& name, const std::string& value) {
    for (const auto& [known, axis] : kAxes) {
      if (value == known) up = axis;
    }
    if (value != "z" && value != "y") failChoice(name, value, {"z", "y"});
  });
}

void Calculate::declare(CLI::App& app) {
  addFile(app, "FILE", input_, "a light file (.shlight), or a text of n^2 numbers (grey) or n^2 rows of three");
  addText(app, {"-o,--output", "FILE", "write the result as a light file (.shlight)"}, output_);
  addSwitch(app, "--force", force_, "let the output replace the file that is read");
  addChoice<Convention>(app,
                        {"--from", "NAME",
                         "convention of a text: shbake (real, orthonormal, no Condon-Shortley sign, index l(l+1)+m), "
                         "condon-shortley, geodesy (4 pi normalised), or hazel (R0, R1 x y z, R2 xx yy zz xy xz yz; "
                         "three times for colour)"},
                        from_, kConventions);
  addAxes(app, {"--from-up", "AXIS", "the axis of a text that points up: z or y"}, "z", fromUp_);
  addRepeated(app, {"--turn", "X,Y,Z,DEG", "turn by an angle in degrees about an axis; may be repeated"}, turns_);
  addChoice<std::string>(app, {"--mirror", "AXIS", "then mirror: exchange the sign of x, y or z, or none"}, mirror_,
                         {{"none", "none"}, {"x", "x"}, {"y", "y"}, {"z", "z"}});
  addText(app,
          {"--multiply", "FILE", "then multiply by the function of another file (the product of both as functions)"},
          factor_);
  addOption(app, {"--order", "N", "then keep N bands, 1..64"}, "as many as the file has",
            [this](const std::string& name, const std::string& text) {
              order_ = static_cast<int>(parseWhole(name, text, 1, 64));
            });
  addWindow(app, "then damp", window_);
  addAxes(app,
          {"--to-up", "AXIS",
           "then give it for axes of which z or y points up: what lay along +z lies along +y, and the like"},
          "as it is", toUp_);
  addRepeated(app, {"--at", "X,Y,Z", "tell radiance from, and irradiance at, a direction; may be repeated"},
              directions_);
  addSwitch(app, "--print", print_, "print the coefficients, a row for each");
  addChoice<Convention>(app,
                        {"--to", "NAME",
                         "convention of --print: shbake, condon-shortley, geodesy, or hazel (a row of ten numbers a "
                         "channel for the first three bands, as --from reads them)"},
                        to_, kConventions);
}

LightFile Calculate::read(const std::string& path) const {
  if (isLightFile(path)) {
    if (from_ != Convention::shbake || fromUp_) {
      throw usageError("--from and --from-up are for texts of numbers; " + path + " is a light file", "leave them out");
    }
    return readLightFile(path);
  }
  const std::vector<double> numbers = readNumbers(path);
  LightFile file;
  file.light = from_ == Convention::hazel ? lightFromHazel(path, numbers)
                                          : converted(lightFromCoefficients(path, numbers), from_, false);
  file.up = fromUp_.value_or(UpAxis::z);
  file.sources.push_back(fs::path(path).filename().string() + ": coefficients");
  return file;
}

/// The file's light for axes of which `up` points up.
LightFile inAxes(LightFile file, UpAxis up) {
  if (file.up == up) return file;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values = file.light.channel(c);
    up == UpAxis::y ? sh::toYUp(file.light.order, values) : sh::fromYUp(file.light.order, values);
    file.light.setChannel(c, values);
  }
  file.up = up;
  return file;
}

void Calculate::multiply() {
  const LightFile factor = inAxes(read(factor_), file_.up);
  const Light &a = file_.light, &b = factor.light;
  const int order = order_ > 0 ? order_ : a.order;
  const sh::TripleProduct product(order, a.order, b.order);
  Light result(order);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values(result.coefficients.size());
    product.apply(a.channel(c), b.channel(c), values);
    result.setChannel(c, values);
  }
  file_.light = result;
  file_.sources.push_back("times " + fs::path(factor_).filename().string());
}

void Calculate::calculate(Session& session) {
  for (const std::string& text : turns_) {
    file_.light = rotated(file_.light, parseTurn("--turn", text));
    file_.sources.push_back("turn " + text);
  }
  if (mirror_ != "none") {
    const MirrorAxis axis = mirror_ == "x" ? MirrorAxis::x : mirror_ == "y" ? MirrorAxis::y : MirrorAxis::z;
    file_.light = mirrored(file_.light, axis);
    file_.sources.push_back("mirror " + mirror_);
  }
  if (!factor_.empty()) multiply();
  if (order_ > 0) file_.light = withOrder(file_.light, order_);
  if (window_ != sh::Window::none) {
    describeWindow(window_, applyWindow(window_, {&file_.light, 1}), session.report);
    file_.sources.push_back("window " + std::string(sh::windowName(window_)));
  }
  if (toUp_) file_ = inAxes(file_, *toUp_);
}

void Calculate::describeDirections(Report& report) const {
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const auto n = parseNumbers("--at", directions_[i], 3, 3, "X,Y,Z");
    const Vec3d d = normalized(Vec3d{n[0], n[1], n[2]});
    if (d == Vec3d{}) throw usageError("--at: a direction is zero", "give a vector such as 0,0,1");
    const Vec3d radiance = radianceFrom(file_.light, d), irradiance = irradianceAt(file_.light, d);
    const std::string key = "at." + std::to_string(i);
    report.data(key + ".direction", std::vector<double>{d.x, d.y, d.z});
    report.data(key + ".radiance", std::vector<double>{radiance.x, radiance.y, radiance.z});
    report.data(key + ".irradiance", std::vector<double>{irradiance.x, irradiance.y, irradiance.z});
    report.line("at " + vectorText(d), "radiance " + vectorText(radiance) + ", irradiance " + vectorText(irradiance));
  }
}

void Calculate::printHazel(Report& report) const {
  const Light nine = withOrder(file_.light, 3);
  const char* names[] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    const std::vector<double> numbers = hazelNumbers(sh::toHazel(nine.channel(c)));
    std::string text;
    for (const double n : numbers) text += (text.empty() ? "" : " ") + formatNumber(n);
    report.fact(std::string("hazel.") + names[c], numbers, std::string("hazel ") + names[c], text);
  }
}

void Calculate::print(Report& report) const {
  if (!print_) return;
  if (to_ == Convention::hazel) return printHazel(report);
  const Light light = converted(file_.light, to_, true);
  std::vector<double> all;
  for (int i = 0; i < sh::coefficientCount(light.order); ++i) {
    const Vec3d& c = light.coefficients[i];
    all.insert(all.end(), {c.x, c.y, c.z});
    report.line("l " + std::to_string(sh::degreeOf(i)) + "  m " + std::to_string(sh::orderOf(i)),
                formatNumber(c.x) + " " + formatNumber(c.y) + " " + formatNumber(c.z));
  }
  report.data("coefficients", all);
}

void Calculate::run(Session& session) {
  if (input_.empty()) throw usageError("no file is named", "usage: shbake sh FILE [OPTIONS]");
  if (!output_.empty()) {
    requireLightFileName(output_);
    checkOutput(output_, std::array{input_}, "the file that is read", force_);
  }
  file_ = read(input_);
  calculate(session);
  describeLight(file_.light, session.report);
  describeDirections(session.report);
  print(session.report);
  if (output_.empty()) return;
  writeLightFile(output_, file_);
  session.report.fact("output.file", output_, "output", output_);
}

}  // namespace

extern const VerbEntry shVerb;
const VerbEntry shVerb{
    "sh", "FILE", "calculate with spherical-harmonic coefficients",
    "Reads a light file or a list of coefficients in one of several conventions, turns, mirrors, multiplies, cuts and "
    "windows it in this order, and tells its energy by band, its least and greatest value, and its direction. 'shbake "
    "light' projects maps and "
    "skies.\n"
    "\n"
    "Examples:\n"
    "  shbake sh room.shlight --at 0,0,1 --print\n"
    "  shbake sh room.shlight --turn 0,0,1,90 --window auto -o turned.shlight\n"
    "  shbake sh list.txt --from condon-shortley --from-up y -o list.shlight\n"
    "  shbake sh room.shlight --print --to hazel",
    [] { return std::unique_ptr<Verb>(std::make_unique<Calculate>()); }};

}  // namespace shbake::cli
