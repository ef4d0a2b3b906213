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

constexpr std::size_t kMostBytes = std::size_t(64) << 20;  // order 128 takes about 1.2 MB
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

  LightFile read() const {
    if (!root_.is_object() || !root_.contains("shbake_light")) {
      fail("", "is not a light file (no field \"shbake_light\")", "make one with 'shbake light'");
    }
    requireKnownFields();
    requireValue("shbake_light", 1);
    requireValue("basis", "real-orthonormal");
    requireValue("condon_shortley", false);
    LightFile file;
    file.up = readAxes();
    const int order = readOrder();
    file.light = Light(order, readRadiance(order));
    file.sources = readSources();
    return file;
  }

 private:
  const Json& field(const char* name) const {
    if (!root_.contains(name)) fail(name, "is missing", "add it");
    return root_[name];
  }

  void requireKnownFields() const {
    static const std::set<std::string> known{"shbake_light", "order",    "basis",  "condon_shortley",
                                             "axes",         "radiance", "sources"};
    for (const auto& item : root_.items()) {
      if (!known.contains(item.key())) fail(item.key(), "is not a field of light files", "remove it");
    }
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

  std::vector<Vec3d> readRadiance(int order) const {
    const Json& rows = field("radiance");
    const std::size_t expected = static_cast<std::size_t>(sh::coefficientCount(order));
    if (!rows.is_array()) fail("radiance", "is not a list", "give one [r, g, b] a coefficient");
    if (rows.size() != expected) {
      fail("radiance",
           "has " + std::to_string(rows.size()) + " rows where order " + std::to_string(order) + " has " +
               std::to_string(expected),
           "correct the order or the rows");
    }
    std::vector<Vec3d> radiance;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Json& row = rows[i];
      const bool isTriple =
          row.is_array() && row.size() == 3 && row[0].is_number() && row[1].is_number() && row[2].is_number();
      if (!isTriple) fail("radiance", "row " + std::to_string(i) + " is not three numbers", "give [r, g, b]");
      radiance.emplace_back(row[0].get<double>(), row[1].get<double>(), row[2].get<double>());
      if (!isFinite(radiance.back())) fail("radiance", "row " + std::to_string(i) + " is not finite", "correct it");
    }
    return radiance;
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

}  // namespace

LightFile readLightFile(const std::string& path) {
  const Json root = parse(path, readText(path));
  return Reader(path, root).read();
}

void writeLightFile(const std::string& path, const LightFile& file) {
  const auto& light = Light(file.light.order, file.light.coefficients);
  std::string text = "{\n  \"shbake_light\": 1,\n  \"order\": " + std::to_string(light.order) +
                     ",\n  \"basis\": \"real-orthonormal\",\n  \"condon_shortley\": false,\n  \"axes\": \"" +
                     axesName(file.up) + "\",\n  \"radiance\": [\n";
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
    const Vec3d& c = light.coefficients[i];
    text += "    " + Json::array({c.x, c.y, c.z}).dump() + (i + 1 < light.coefficients.size() ? ",\n" : "\n");
  }
  text += "  ],\n  \"sources\": " + Json(file.sources).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n}\n";
  AtomicFile out(path);
  out.write(text);
  out.commit();
}

}  // namespace shbake
