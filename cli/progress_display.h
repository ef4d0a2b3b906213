// Progress on a terminal or in a log.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "shbake.h"

namespace shbake::cli {

/// The bar of a stage in at most `width` columns: "tracing  [#######-----]  58 %  12.3 M rays/s  0:08 left".
/// A stage of unknown length shows its count in place of the bar.
std::string progressBar(const ProgressState& state, int width);

/// The same facts as a line of a log: "tracing: 58 %, 12.3 M rays/s, 0:08 left".
std::string progressLine(const ProgressState& state);

/// Shows progress on stderr and keeps the times of the stages. Thread-safe.
class ProgressDisplay {
 public:
  enum class Style {
    none,   ///< nothing is shown
    lines,  ///< a line every 5 seconds, for logs
    bar,    ///< one line drawn over and over, for terminals; erased when the work ends
  };
  /// A stage that has come to its end (or was stopped).
  struct Stage {
    std::string name, unit;
    double done = 0, seconds = 0;
  };

  /// `keepStages`: a line stays for each stage that ends.
  ProgressDisplay(Style style, bool keepStages);

  /// Takes what a ProgressCallback is told.
  void update(const ProgressState& state);
  /// Ends the last stage, erases the bar and shows nothing from now on.
  void finish();
  /// Erases the bar so that a message can be printed; the next update draws it again.
  void clearLine();
  /// The stages that have ended, in order.
  std::vector<Stage> stages() const;

 private:
  void endStage();
  void erase();

  const Style style_;
  const bool keepStages_;
  mutable std::mutex mutex_;
  bool finished_ = false, drawn_ = false;
  ProgressState current_;
  std::vector<Stage> stages_;
  std::chrono::steady_clock::time_point lastLine_;
};

}  // namespace shbake::cli
