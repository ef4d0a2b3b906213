// What a verb found or did, said twice: as aligned lines for people and as JSON for programs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace shbake::cli {

class Report {
 public:
  /// A value in JSON. Doubles that are not finite become null.
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

  Report();
  ~Report();

  /// A fact for programs only: `key` is its path in the JSON object with dots between ("mesh.triangles").
  void data(const std::string& key, Value value);
  /// A line for people only. An empty label continues the line above.
  void line(std::string label, std::string text);
  /// Text for people only that stands as it is, instead of all lines.
  void raw(std::string text);
  /// A fact for both.
  void fact(const std::string& key, Value value, std::string label, std::string text);

  /// The lines, labels aligned; empty when there are none.
  std::string text() const;
  /// The JSON object, keys in the order of their first use, ending in a newline. Bytes that are not UTF-8 are replaced.
  std::string json() const;

 private:
  struct Line {
    std::string label, text;
  };
  struct Json;
  std::vector<Line> lines_;
  std::string raw_;
  std::unique_ptr<Json> json_;
};

}  // namespace shbake::cli
