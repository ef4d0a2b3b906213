#include "transfer/transfer_facts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::string_view kPrefix = "shbake ";

/// Facts that files always state and that have one value in files that shbake understands.
struct FixedFact {
  const char* key;
  const char* value;
};
constexpr FixedFact kBasisFacts[] = {{"index", "l*(l+1)+m"}, {"basis", "real-orthonormal"}};
constexpr FixedFact kFrameFacts[] = {
    {"axes", "as-file"}, {"handed", "right"}, {"units", "radiance_out_per_radiance_in"}};

// In the order of AlbedoOrigin.
constexpr const char* kAlbedoOrigins[] = {"unknown", "uniform", "vertex_colors", "face_colors"};

// What transfer stands for: the vertices, the vertices smoothed over their neighbours, or the surface between them.
constexpr const char* kFits[] = {"vertex", "smoothed", "surface"};

/// The place in kFits of what was done.
std::size_t fitOf(const FitFacts& fit) {
  return fit.fittedPoints > 0 ? 2 : fit.smoothedPoints > 0 ? 1 : 0;
}

std::string escaped(std::string_view text) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 32 && byte != 127 && c != '%') {
      result += c;
    } else {
      result += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return result;
}

/// Undoes escaped(); what is no escape stays as it is.
std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size()) {
      const char* const end = text.data() + i + 3;
      if (std::from_chars(text.data() + i + 1, end, value, 16).ptr == end) {
        result += static_cast<char>(value);
        i += 2;
        continue;
      }
    }
    result += text[i];
  }
  return result;
}

template <class T>
std::string shortest(T value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string triple(double x, double y, double z) {
  return shortest(x) + "," + shortest(y) + "," + shortest(z);
}

/// Collects "key=value" words into a comment.
class FactLine {
 public:
  FactLine& add(const char* key, std::string_view value) {
    text_ += std::string(text_.empty() ? "shbake " : " ") + key + "=" + escaped(value);
    return *this;
  }
  template <class T>
  requires std::is_arithmetic_v<T> FactLine& add(const char* key, T value) { return add(key, shortest(value)); }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

/// The key=value pairs of all comments, each taken once.
class FactReader {
 public:
  FactReader(const std::vector<std::string>& comments, const std::string& file) : file_(file) {
    for (const std::string& comment : comments) {
      if (isFactComment(comment)) addLine(std::string_view(comment).substr(kPrefix.size()));
    }
  }

  bool empty() const { return values_.empty(); }

  [[noreturn]] void fail(const std::string& key, std::string cause, std::string remedy) const {
    throw Error(
        {.file = file_, .place = "header field " + key, .cause = std::move(cause), .remedy = std::move(remedy)});
  }

  /// The value of a key, which is then done with.
  std::optional<std::string> take(const std::string& key) {
    const auto found = values_.find(key);
    if (found == values_.end()) return {};
    std::string value = std::move(found->second);
    values_.erase(found);
    return value;
  }

  /// A number in least..most, or nothing when the key is absent.
  template <class T>
  std::optional<T> number(const std::string& key, T least, T most) {
    const auto text = take(key);
    if (!text) return {};
    T value{};
    const char* const end = text->data() + text->size();
    const auto result = std::from_chars(text->data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end || !(value >= least && value <= most)) {
      const bool bounded = most != std::numeric_limits<T>::max();
      fail(key, "'" + *text + "' is not a number from " + shortest(least) + (bounded ? " to " + shortest(most) : " on"),
           "correct the comment, or bake the mesh anew");
    }
    return value;
  }

  /// The place of the value among `words`, or nothing when the key is absent.
  std::optional<std::size_t> choice(const std::string& key, std::initializer_list<const char*> words) {
    const auto text = take(key);
    if (!text) return {};
    std::string expected;
    std::size_t place = 0;
    for (const char* word : words) {
      if (*text == word) return place;
      expected += (place++ == 0 ? "" : " or ") + std::string(word);
    }
    fail(key, "'" + *text + "' is not understood, expected " + expected,
         "convert the file with the program that made it");
  }

  /// Keys that nothing has taken.
  std::vector<std::string> rest() const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : values_) keys.push_back(key);
    return keys;
  }

 private:
  void addLine(std::string_view line) {
    while (!line.empty()) {
      const std::size_t end = std::min(line.find(' '), line.size());
      const std::string_view word = line.substr(0, end);
      line.remove_prefix(std::min(end + 1, line.size()));
      if (word.empty()) continue;
      const std::size_t equals = word.find('=');
      const std::string key(word.substr(0, equals));
      if (equals == word.npos || equals == 0) {
        fail(key, "is not of the form key=value", "correct the comment, or bake the mesh anew");
      }
      const std::string value = unescaped(word.substr(equals + 1));
      const auto [at, isNew] = values_.emplace(key, value);
      if (!isNew && at->second != value) {
        fail(key, "is stated as '" + at->second + "' and as '" + value + "'", "keep the comments of one bake only");
      }
    }
  }

  const std::string& file_;
  std::map<std::string, std::string> values_;
};

/// Three numbers in least..most with commas between.
template <class T>
std::optional<Vec3<T>> parseTriple(const std::string& text, T least, T most) {
  Vec3<T> triple;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (T* c : {&triple.x, &triple.y, &triple.z}) {
    const auto result = std::from_chars(at, end, *c);
    if (result.ec != std::errc{} || !(*c >= least && *c <= most)) return {};
    at = result.ptr;
    if (c != &triple.z && (at == end || *at++ != ',')) return {};
  }
  return at == end ? std::optional(triple) : std::nullopt;
}

AlbedoFacts parseAlbedo(FactReader& reader) {
  AlbedoFacts albedo;
  albedo.included = reader.choice("albedo", {"included", "separate"}).value_or(0) == 0;
  albedo.origin = static_cast<AlbedoOrigin>(
      reader.choice("albedo_from", {kAlbedoOrigins[0], kAlbedoOrigins[1], kAlbedoOrigins[2], kAlbedoOrigins[3]})
          .value_or(0));
  albedo.bytesAreLinear = reader.choice("albedo_bytes", {"srgb", "linear"}).value_or(0) == 1;
  const auto text = reader.take("albedo_rgb");
  if (text) {
    const auto color = parseTriple(*text, 0.0f, 1.0f);
    if (!color)
      reader.fail("albedo_rgb", "'" + *text + "' is not three numbers 0 to 1 with commas between", "correct it");
    albedo.uniform = *color;
  } else if (albedo.origin == AlbedoOrigin::uniform) {
    reader.fail("albedo_rgb", "is missing, though albedo_from=uniform", "state it as three numbers 0 to 1");
  }
  return albedo;
}

SurfaceError parseSurface(FactReader& reader) {
  constexpr double kMost = std::numeric_limits<double>::max();
  SurfaceError surface;
  surface.samples =
      reader.number<std::size_t>("surface_samples", 0, std::numeric_limits<std::size_t>::max()).value_or(0);
  surface.rays = reader.number("surface_rays", 0, std::numeric_limits<int>::max()).value_or(0);
  surface.rms = reader.number("surface_rms", 0.0, kMost).value_or(0);
  surface.low = reader.number("surface_low", 0.0, kMost).value_or(0);
  surface.high = reader.number("surface_high", 0.0, kMost).value_or(0);
  surface.worst = reader.number("surface_worst", 0.0, kMost).value_or(0);
  if (const auto text = reader.take("surface_worst_at")) {
    const auto position = parseTriple(*text, -kMost, kMost);
    if (!position)
      reader.fail("surface_worst_at", "'" + *text + "' is not three numbers with commas between", "correct it");
    surface.worstPosition = *position;
  }
  return surface;
}

FitFacts parseFit(FactReader& reader) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr std::size_t kMostSize = std::numeric_limits<std::size_t>::max();
  FitFacts fit;
  const auto kind = reader.choice("fit", {kFits[0], kFits[1], kFits[2]});
  fit.fittedPoints = reader.number<std::size_t>("fit_points", 0, kMostSize).value_or(0);
  fit.smoothedPoints = reader.number<std::size_t>("fit_smoothed", 0, kMostSize).value_or(0);
  fit.before = reader.number("fit_error_before", 0.0, kMost).value_or(0);
  fit.after = reader.number("fit_error_after", 0.0, kMost).value_or(0);
  if (kind && *kind != fitOf(fit)) {
    reader.fail("fit", std::string("'") + kFits[*kind] + "' contradicts fit_points and fit_smoothed",
                "correct the comment, or bake the mesh anew");
  }
  return fit;
}

TransferFacts parseHistory(FactReader& reader) {
  TransferFacts facts;
  constexpr int kMostInt = std::numeric_limits<int>::max();
  constexpr double kMostDouble = std::numeric_limits<double>::max();
  constexpr std::size_t kMostSize = std::numeric_limits<std::size_t>::max();
  facts.version = reader.take("version").value_or("");
  if (const auto kind =
          reader.choice("transfer", {transferName(TransferKind::unshadowed), transferName(TransferKind::shadowed),
                                     transferName(TransferKind::interreflected)})) {
    facts.kind = static_cast<TransferKind>(*kind);
  }
  facts.bounces = reader.number("bounces", 0, kMostInt).value_or(0);
  facts.bouncesConverged = reader.number("bounces_converged", 0, 1).value_or(0) == 1;
  facts.sampler = reader.take("sampler").value_or("");
  facts.rays = reader.number("rays", 0, kMostInt).value_or(0);
  facts.seed = reader.number<std::uint64_t>("seed", 0, std::numeric_limits<std::uint64_t>::max()).value_or(0);
  facts.rmsError = reader.number("rms_error", 0.0, kMostDouble).value_or(0);
  facts.maxError = reader.number("max_error", 0.0, kMostDouble).value_or(0);
  facts.tolerance = reader.number("tolerance", 0.0, kMostDouble).value_or(0);
  facts.twoSided = reader.number("two_sided", 0, 1).value_or(0) == 1;
  facts.maxDistance = reader.number("max_distance", std::numeric_limits<double>::denorm_min(), kMostDouble)
                          .value_or(std::numeric_limits<double>::infinity());
  facts.blockers = reader.number<std::size_t>("blockers", 0, kMostSize).value_or(0);
  facts.fit = parseFit(reader);
  facts.surface = parseSurface(reader);
  facts.lightingPoints = reader.number<std::size_t>("lighting_points", 0, kMostSize).value_or(0);
  facts.sourceVertices = reader.number<std::size_t>("source_vertices", 0, kMostSize).value_or(0);
  facts.source = reader.take("source").value_or("");
  return facts;
}

/// What limits the tracing beside its rays; nothing where nothing does.
std::optional<std::string> limitsComment(const TransferFacts& facts) {
  const bool limited = std::isfinite(facts.maxDistance);
  if (!facts.twoSided && !limited && facts.blockers == 0) return {};
  FactLine line;
  if (facts.twoSided) line.add("two_sided", 1);
  if (limited) line.add("max_distance", facts.maxDistance);
  if (facts.blockers > 0) line.add("blockers", facts.blockers);
  return line.text();
}

std::string fitComment(const FitFacts& fit) {
  return FactLine()
      .add("fit", kFits[fitOf(fit)])
      .add("fit_points", fit.fittedPoints)
      .add("fit_smoothed", fit.smoothedPoints)
      .add("fit_error_before", fit.before)
      .add("fit_error_after", fit.after)
      .text();
}

std::string surfaceComment(const SurfaceError& surface) {
  const Vec3d& at = surface.worstPosition;
  return FactLine()
      .add("surface_samples", surface.samples)
      .add("surface_rays", surface.rays)
      .add("surface_rms", surface.rms)
      .add("surface_low", surface.low)
      .add("surface_high", surface.high)
      .add("surface_worst", surface.worst)
      .add("surface_worst_at", triple(at.x, at.y, at.z))
      .text();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

bool isFactComment(std::string_view comment) {
  if (!comment.starts_with(kPrefix)) return false;
  comment.remove_prefix(std::min(comment.find_first_not_of(' ', kPrefix.size()), comment.size()));
  return comment.substr(0, comment.find(' ')).find('=') != comment.npos;
}

std::vector<std::string> factComments(const TransferFacts& facts, int order, int channels) {
  std::vector<std::string> comments;
  comments.push_back(FactLine()
                         .add("version", facts.version)
                         .add("transfer", transferName(facts.kind))
                         .add("bounces", facts.bounces)
                         .add("bounces_converged", facts.bouncesConverged ? 1 : 0)
                         .text());
  FactLine basis;
  basis.add("order", order).add("channels", channels);
  for (const FixedFact& f : kBasisFacts) basis.add(f.key, f.value);
  comments.push_back(basis.add("condon_shortley", 0).text());
  FactLine frame;
  for (const FixedFact& f : kFrameFacts) frame.add(f.key, f.value);
  comments.push_back(frame.add("albedo", facts.albedo.included ? "included" : "separate").text());
  comments.push_back(FactLine()
                         .add("sampler", facts.sampler)
                         .add("rays", facts.rays)
                         .add("seed", facts.seed)
                         .add("rms_error", facts.rmsError)
                         .add("max_error", facts.maxError)
                         .add("tolerance", facts.tolerance)
                         .text());
  comments.push_back(FactLine()
                         .add("lighting_points", facts.lightingPoints)
                         .add("source_vertices", facts.sourceVertices)
                         .add("source", facts.source)
                         .text());
  const AlbedoFacts& albedo = facts.albedo;
  if (albedo.origin != AlbedoOrigin::unknown) {
    FactLine line;
    line.add("albedo_from", kAlbedoOrigins[static_cast<std::size_t>(albedo.origin)]);
    if (albedo.origin == AlbedoOrigin::uniform) {
      const Rgb& c = albedo.uniform;
      line.add("albedo_rgb", shortest(c.x) + "," + shortest(c.y) + "," + shortest(c.z));
    } else {
      line.add("albedo_bytes", albedo.bytesAreLinear ? "linear" : "srgb");
    }
    comments.push_back(line.text());
  }
  if (const auto limits = limitsComment(facts)) comments.push_back(*limits);
  if (facts.fit.any()) comments.push_back(fitComment(facts.fit));
  if (facts.surface.samples > 0) comments.push_back(surfaceComment(facts.surface));
  return comments;
}

StatedFacts parseFacts(const std::vector<std::string>& comments, const std::string& file) {
  FactReader reader(comments, file);
  StatedFacts stated;
  stated.any = !reader.empty();
  if (!stated.any) {
    stated.notes.push_back(
        "the header has no shbake comments: the basis is taken as real and orthonormal without Condon-Shortley phase, "
        "index l(l+1)+m, the axes as the mesh's, the units as outgoing radiance per incident radiance with albedo "
        "included; how the transfer was baked is not known");
    return stated;
  }
  std::vector<std::string> assumed;
  const auto requireFixed = [&](const FixedFact& f) {
    if (!reader.choice(f.key, {f.value})) assumed.push_back(std::string(f.key) + "=" + f.value);
  };
  for (const FixedFact& f : kBasisFacts) requireFixed(f);
  for (const FixedFact& f : kFrameFacts) requireFixed(f);
  stated.order = reader.number("order", 1, StatedFacts::kMostBands);
  if (const auto channels = reader.choice("channels", {"1", "3"})) stated.channels = *channels == 0 ? 1 : 3;
  const auto phase = reader.choice("condon_shortley", {"0", "1"});
  if (!phase) assumed.push_back("condon_shortley=0");
  stated.condonShortley = phase == 1;
  stated.facts = parseHistory(reader);
  stated.facts.albedo = parseAlbedo(reader);
  if (!assumed.empty()) stated.notes.push_back("the header does not state, so it is assumed: " + joined(assumed));
  if (const auto rest = reader.rest(); !rest.empty()) {
    stated.notes.push_back("header fields that are not known were ignored: " + joined(rest));
  }
  return stated;
}

}  // namespace shbake
