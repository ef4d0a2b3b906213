#include "transfer/sh_columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::string_view kChannelLetters = "rgb";

/// What a name such as "sh_4" or "sh_g_4" says.
struct ShName {
  std::optional<std::size_t> channel;  // nothing for the only one
  std::size_t index = 0;
};

std::optional<ShName> parseShName(std::string_view name) {
  if (!name.starts_with("sh_")) return {};
  name.remove_prefix(3);
  ShName result;
  if (name.size() > 2 && name[1] == '_' && kChannelLetters.find(name[0]) != kChannelLetters.npos) {
    result.channel = kChannelLetters.find(name[0]);
    name.remove_prefix(2);
  }
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, result.index);
  const bool canonical = name.size() == 1 || (!name.empty() && name[0] != '0');
  if (error != std::errc{} || stop != end || !canonical) return {};
  return result;
}

/// The coefficients found of one channel: (index, place among the properties), in the order of the indices.
using Found = std::vector<std::pair<std::size_t, std::size_t>>;

class ColumnFinder {
 public:
  ColumnFinder(const std::vector<PlyProperty>& properties, const StatedFacts& stated, const std::string& file)
      : properties_(properties), stated_(stated), file_(file) {}

  std::optional<ShColumns> find() {
    collect();
    const bool single = !single_.empty();
    const bool colored = std::ranges::any_of(colored_, [](const Found& f) { return !f.empty(); });
    if (!single && !colored) return {};
    if (single && colored) {
      fail("header", "has coefficients of one channel (sh_0 …) and of three (sh_r_0 …)", "keep one kind");
    }
    ShColumns columns;
    columns.channels = single ? 1 : 3;
    if (stated_.channels && *stated_.channels != columns.channels) {
      fail("header field channels",
           "states " + std::to_string(*stated_.channels) + ", but the properties are those of " +
               std::to_string(columns.channels),
           "correct the comment, or bake the mesh anew");
    }
    columns.order = stated_.order ? *stated_.order : leastOrder();
    columns.place.resize(properties_.size());
    for (int c = 0; c < columns.channels; ++c) place(columns, c);
    return columns;
  }

 private:
  [[noreturn]] void fail(std::string where, std::string cause, std::string remedy) const {
    throw Error({.file = file_, .place = std::move(where), .cause = std::move(cause), .remedy = std::move(remedy)});
  }

  void collect() {
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      const auto name = parseShName(properties_[i].name);
      if (!name) continue;
      if (properties_[i].isList || !isFloatType(properties_[i].type)) {
        fail("property " + properties_[i].name, "is not a scalar of type float or double",
             "store coefficients as floats");
      }
      (name->channel ? colored_[*name->channel] : single_).emplace_back(name->index, i);
    }
    std::ranges::sort(single_);
    for (Found& f : colored_) std::ranges::sort(f);
  }

  /// The least order that has room for all coefficients found.
  int leastOrder() const {
    std::size_t last = single_.empty() ? 0 : single_.back().first;
    for (const Found& f : colored_) last = f.empty() ? last : std::max(last, f.back().first);
    int order = 1;
    while (order < StatedFacts::kMostBands && static_cast<std::size_t>(order) * order <= last) ++order;
    return order;
  }

  /// Enters the coefficients of a channel, which have to be complete.
  void place(ShColumns& columns, int channel) const {
    const Found& found = columns.channels == 1 ? single_ : colored_[static_cast<std::size_t>(channel)];
    const auto count = static_cast<std::size_t>(columns.order * columns.order);
    const std::string order = std::to_string(columns.order);
    const std::string rule = (stated_.order ? "order=" + order : "order " + order + ", the least that fits,") +
                             " asks for " + std::to_string(count) + " coefficients a channel";
    for (std::size_t i = 0; i < count; ++i) {
      if (i < found.size() && found[i].first == i) {
        columns.place[found[i].second] = static_cast<std::size_t>(channel) * count + i;
        continue;
      }
      fail("header",
           "property " + shColumnName(columns.channels, channel, static_cast<int>(i)) + " is missing: " + rule,
           "bake the mesh anew, or correct the header");
    }
    if (found.size() > count) {
      fail("header field order", rule + ", but there is property " + properties_[found[count].second].name,
           "correct the comment, or bake the mesh anew");
    }
  }

  const std::vector<PlyProperty>& properties_;
  const StatedFacts& stated_;
  const std::string& file_;
  Found single_;
  std::array<Found, 3> colored_;
};

}  // namespace

std::string shColumnName(int channels, int channel, int index) {
  std::string name = "sh_";
  if (channels == 3) name += {kChannelLetters[static_cast<std::size_t>(channel)], '_'};
  return name + std::to_string(index);
}

bool isTransferColumn(std::string_view name) {
  return name == "quality" || name == "sh_error" || name == "source_vertex" || parseShName(name).has_value();
}

std::optional<ShColumns> findShColumns(const std::vector<PlyProperty>& properties, const StatedFacts& stated,
                                       const std::string& file) {
  return ColumnFinder(properties, stated, file).find();
}

}  // namespace shbake
