// What a verb found or did: lines and JSON, side by side.
#include "cli/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace shbake::cli {

struct Report::Json {
  nlohmann::ordered_json root = nlohmann::ordered_json::object();
};

Report::Report() : json_(std::make_unique<Json>()) {}

Report::~Report() = default;

void Report::data(const std::string& key, Value value) {
  std::string pointer = "/" + key;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  auto& target = json_->root[nlohmann::ordered_json::json_pointer(pointer)];
  std::visit([&](auto& v) { target = std::move(v); }, value);
}

void Report::line(std::string label, std::string text) {
  lines_.push_back({std::move(label), std::move(text)});
}

void Report::raw(std::string text) {
  raw_ = std::move(text);
}

void Report::fact(const std::string& key, Value value, std::string label, std::string text) {
  data(key, std::move(value));
  line(std::move(label), std::move(text));
}

std::string Report::text() const {
  if (!raw_.empty()) return raw_;
  std::size_t width = 0;
  for (const Line& l : lines_) width = std::max(width, l.label.size());
  std::string all;
  for (const Line& l : lines_) all += l.label + std::string(width - l.label.size() + 2, ' ') + l.text + "\n";
  return all;
}

std::string Report::json() const {
  return json_->root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace shbake::cli
