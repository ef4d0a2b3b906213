// Light files by nlohmann's JSON library.
#include "light/light_file.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"

namespace shbake {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t(64) << 20;  // a light of order 128 takes about 1.2 MB

const char* axesName(UpAxis up) {
  return up == UpAxis::z ? "z-up" : "y-up";
}

/// A file being read: its JSON and how faults in it are told.
class Reader {
 public:
  Reader(const std::string& path, const Json& root) : path_(path), root_(root) {}

  [[noreturn]] void fail(const std::string& field, std::string cause, std::string remedy) const {
    throw Error({.file = path_,
                 .place = field.empty() ? "" : "field \"" + field + "\"",
                 .cause = std::move(cause),
                 .remedy = std::move(remedy)});
  }

  bool holdsRig() const {
    if (!root_.is_object() || !root_.contains("shbake_light")) {
      fail("", "is not a light file (no field \"shbake_light\")", "make one with 'shbake light'");
    }
    return root_.contains("samples");
  }

  LightFile readLight() const {
    if (holdsRig()) fail("samples", "makes it a rig of lights where one light is needed", "give a light without it");
    requireFrame({"radiance"});
    LightFile file;
    file.up = readAxes();
    const int order = readOrder();
    file.light = Light(order, readRadiance(field("radiance"), "radiance", order));
    file.sources = readSources();
    return file;
  }

  RigFile readRig() const {
    if (!holdsRig()) fail("samples", "is missing where a rig is needed", "make one with 'shbake light --sample'");
    requireFrame({"blend", "power", "samples"});
    RigFile file;
    file.up = readAxes();
    file.options = readBlend();
    const int order = readOrder();
    const Json& samples = field("samples");
    if (!samples.is_array() || samples.empty()) fail("samples", "is not a list of samples", "give at least one");
    for (std::size_t i = 0; i < samples.size(); ++i) file.samples.push_back(readSample(samples[i], i, order));
    file.sources = readSources();
    return file;
  }

 private:
  const Json& field(const char* name) const {
    if (!root_.contains(name)) fail(name, "is missing", "add it");
    return root_[name];
  }

  /// Requires the fields that say how numbers are meant, and none that is unknown.
  void requireFrame(const std::set<std::string>& own) const {
    std::set<std::string> known{"shbake_light", "order", "basis", "condon_shortley", "axes", "sources"};
    known.insert(own.begin(), own.end());
    for (const auto& item : root_.items()) {
      if (!known.contains(item.key())) fail(item.key(), "is not a field of such a light file", "remove it");
    }
    requireValue("shbake_light", 1);
    requireValue("basis", "real-orthonormal");
    requireValue("condon_shortley", false);
  }

  void requireValue(const char* name, const Json& value) const {
    const Json& found = field(name);
    if (found != value) {
      fail(name,
           "is " + found.dump(-1, ' ', false, Json::error_handler_t::replace) + " where only " + value.dump() +
               " is understood",
           "convert the file");
    }
  }

  UpAxis readAxes() const {
    const Json& axes = field("axes");
    for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
      if (axes == axesName(up)) return up;
    }
    fail("axes", "is neither \"z-up\" nor \"y-up\"", "give one of these");
  }

  int readOrder() const {
    const Json& order = field("order");
    if (!order.is_number_integer() || order < 1 || order > kMaxLightOrder) {
      fail("order", "is not a whole number from 1 to " + std::to_string(kMaxLightOrder), "correct it");
    }
    return order.get<int>();
  }

  /// Three finite numbers, told as `what` of `name` where they are not.
  Vec3d readTriple(const Json& row, const std::string& name, const std::string& what) const {
    const bool isTriple =
        row.is_array() && row.size() == 3 && row[0].is_number() && row[1].is_number() && row[2].is_number();
    if (!isTriple) fail(name, what + " is not three numbers", "give a list such as [0, 0, 1]");
    const Vec3d triple{row[0].get<double>(), row[1].get<double>(), row[2].get<double>()};
    if (!isFinite(triple)) fail(name, what + " is not finite", "correct it");
    return triple;
  }

  std::vector<Vec3d> readRadiance(const Json& rows, const std::string& name, int order) const {
    const std::size_t expected = static_cast<std::size_t>(sh::coefficientCount(order));
    if (!rows.is_array()) fail(name, "is not a list", "give one [r, g, b] a coefficient");
    if (rows.size() != expected) {
      fail(name,
           "has " + std::to_string(rows.size()) + " rows where order " + std::to_string(order) + " has " +
               std::to_string(expected),
           "correct the order or the rows");
    }
    std::vector<Vec3d> radiance;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      radiance.push_back(readTriple(rows[i], name, "row " + std::to_string(i)));
    }
    return radiance;
  }

  RigOptions readBlend() const {
    RigOptions options;
    const Json& blend = field("blend");
    if (blend == blendName(RigMethod::barycentric)) {
      options.method = RigMethod::barycentric;
      if (root_.contains("power")) fail("power", "has no meaning for barycentric blending", "remove it");
      return options;
    }
    if (blend != blendName(RigMethod::inverseDistance)) {
      fail("blend", "is neither \"inverse-distance\" nor \"barycentric\"", "give one of these");
    }
    const Json& power = field("power");
    if (!power.is_number() || !(power.get<double>() > 0)) fail("power", "is not a number above 0", "correct it");
    options.power = power.get<double>();
    return options;
  }

  LightSample readSample(const Json& sample, std::size_t index, int order) const {
    const std::string name = "samples[" + std::to_string(index) + "]";
    if (!sample.is_object()) fail(name, "is not an object", "give its position and radiance");
    for (const auto& item : sample.items()) {
      if (item.key() != "position" && item.key() != "radiance") {
        fail(name + "." + item.key(), "is not a field of samples", "remove it");
      }
    }
    for (const char* needed : {"position", "radiance"}) {
      if (!sample.contains(needed)) fail(name + "." + needed, "is missing", "add it");
    }
    return {readTriple(sample["position"], name + ".position", "it"),
            Light(order, readRadiance(sample["radiance"], name + ".radiance", order))};
  }

  std::vector<std::string> readSources() const {
    std::vector<std::string> sources;
    if (!root_.contains("sources")) return sources;
    const Json& list = root_["sources"];
    if (!list.is_array()) fail("sources", "is not a list of texts", "correct or remove it");
    for (const Json& item : list) {
      if (!item.is_string()) fail("sources", "is not a list of texts", "correct or remove it");
      sources.push_back(item.get<std::string>());
    }
    return sources;
  }

  const std::string& path_;
  const Json& root_;
};

std::string readText(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error({.file = path, .cause = "cannot be opened", .remedy = "correct the path"});
  std::string text;
  std::vector<char> part(1 << 16);
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())) || stream.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMostBytes) {
      throw Error({.file = path, .cause = "is too large for a light file", .remedy = "name a light file"});
    }
  }
  if (text.empty()) throw Error({.file = path, .cause = "is empty or cannot be read", .remedy = "name a light file"});
  return text;
}

/// Parses JSON in which no object names a field twice.
Json parse(const std::string& path, const std::string& text) {
  std::vector<std::set<std::string>> open;
  const auto refuseTwice = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second) {
      throw Error({.file = path,
                   .place = "field \"" + value.get<std::string>() + "\"",
                   .cause = "is given twice",
                   .remedy = "remove one"});
    }
    return true;
  };
  try {
    return Json::parse(text, refuseTwice);
  } catch (const Json::parse_error& error) {
    throw Error({.file = path,
                 .place = "byte " + std::to_string(error.byte),
                 .cause = "is not JSON",
                 .remedy = "make light files with 'shbake light'"});
  } catch (const Json::out_of_range&) {
    throw Error({.file = path, .cause = "holds a number that is too large", .remedy = "correct it"});
  }
}

std::string tripleText(const Vec3d& v) {
  return Json::array({v.x, v.y, v.z}).dump();
}

/// The fields of every light file, up to its coefficients.
std::string frameText(int order, UpAxis up) {
  return "{\n  \"shbake_light\": 1,\n  \"order\": " + std::to_string(order) +
         ",\n  \"basis\": \"real-orthonormal\",\n  \"condon_shortley\": false,\n  \"axes\": \"" + axesName(up) +
         "\",\n";
}

/// The coefficients, a line for each.
std::string rowsText(const Light& light, const std::string& indent) {
  std::string text;
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
    text += indent + tripleText(light.coefficients[i]) + (i + 1 < light.coefficients.size() ? ",\n" : "\n");
  }
  return text;
}

/// Adds the sources and writes the file.
void writeText(const std::string& path, const std::string& text, const std::vector<std::string>& sources) {
  AtomicFile out(path);
  out.write(text + ",\n  \"sources\": " + Json(sources).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n}\n");
  out.commit();
}

}  // namespace

const char* blendName(RigMethod method) {
  return method == RigMethod::barycentric ? "barycentric" : "inverse-distance";
}

bool isRigFile(const std::string& path) {
  const Json root = parse(path, readText(path));
  return Reader(path, root).holdsRig();
}

LightFile readLightFile(const std::string& path) {
  const Json root = parse(path, readText(path));
  return Reader(path, root).readLight();
}

RigFile readRigFile(const std::string& path) {
  const Json root = parse(path, readText(path));
  return Reader(path, root).readRig();
}

void writeLightFile(const std::string& path, const LightFile& file) {
  const auto& light = Light(file.light.order, file.light.coefficients);
  writeText(path, frameText(light.order, file.up) + "  \"radiance\": [\n" + rowsText(light, "    ") + "  ]",
            file.sources);
}

void writeRigFile(const std::string& path, const RigFile& file) {
  const LightRig checked(file.samples, file.options);
  const int order = file.samples[0].light.order;
  std::string text = frameText(order, file.up) + "  \"blend\": \"" + blendName(file.options.method) + "\",\n";
  if (file.options.method == RigMethod::inverseDistance)
    text += "  \"power\": " + Json(file.options.power).dump() + ",\n";
  text += "  \"samples\": [";
  for (std::size_t i = 0; i < file.samples.size(); ++i) {
    const LightSample& s = file.samples[i];
    if (s.light.order != order) throw usageError("the lights of a rig differ in order", "give them one order");
    const Light light(s.light.order, s.light.coefficients);
    text += (i == 0 ? "\n" : ",\n") + std::string("    {\"position\": ") + tripleText(s.position) +
            ",\n     \"radiance\": [\n" + rowsText(light, "      ") + "    ]}";
  }
  writeText(path, text + "\n  ]", file.sources);
}

}  // namespace shbake
