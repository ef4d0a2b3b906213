// Progress on a terminal or in a log.
#include "cli/progress_display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/format.h"

namespace shbake::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kLineInterval{5};
/// A bar for a stage that is over sooner only flickers.
constexpr double kFirstBar = 0.2;
/// A rate or a time left that is measured over less means nothing.
constexpr double kFirstRate = 0.5;

std::string rate(const ProgressState& s) {
  return formatShort(s.done / s.elapsed) + (s.unit.empty() ? "/s" : " " + s.unit + "/s");
}

std::string share(const ProgressState& s) {
  return std::to_string(static_cast<int>(100 * s.done / s.total)) + " %";
}

std::string amount(const ProgressState& s) {
  return formatCount(static_cast<std::uint64_t>(s.done)) + (s.unit.empty() ? "" : " " + s.unit);
}

bool hasRate(const ProgressState& s) {
  return s.elapsed >= kFirstRate && s.done > 0;
}

std::string timeLeft(const ProgressState& s) {
  return formatDuration(s.elapsed * (s.total - s.done) / s.done) + " left";
}

int terminalWidth() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string progressBar(const ProgressState& s, int width) {
  std::string right = s.total > 0 ? "  " + std::string(share(s).size() < 5 ? 5 - share(s).size() : 0, ' ') + share(s)
                                  : "  " + amount(s);
  if (hasRate(s)) right += "  " + rate(s) + (s.total > 0 ? "  " + timeLeft(s) : "");
  const int room = width - 1 - static_cast<int>(s.stage.size() + right.size()) - 4;  // 4: two spaces, two brackets
  constexpr int kLeast = 5, kMost = 40;
  std::string text = s.stage;
  if (s.total > 0 && room >= kLeast) {
    const int length = std::min(room, kMost), filled = static_cast<int>(length * s.done / s.total);
    text += "  [" + std::string(filled, '#') + std::string(length - filled, '-') + "]";
  }
  return (text + right).substr(0, std::max(0, width - 1));  // a character in the last column may wrap the line
}

std::string progressLine(const ProgressState& s) {
  std::string text = s.stage + ": " + (s.total > 0 ? share(s) : amount(s));
  if (hasRate(s)) text += ", " + rate(s) + (s.total > 0 ? ", " + timeLeft(s) : "");
  return text;
}

ProgressDisplay::ProgressDisplay(Style style, bool keepStages)
    : style_(style), keepStages_(keepStages), lastLine_(Clock::now()) {}

void ProgressDisplay::update(const ProgressState& state) {
  const std::lock_guard lock(mutex_);
  if (finished_) return;
  // Time runs backwards where a stage of the same name begins again.
  if (state.stage != current_.stage || state.elapsed < current_.elapsed) endStage();
  current_ = state;
  if (style_ == Style::bar && state.elapsed >= kFirstBar) {
    print("\r\033[K" + progressBar(state, terminalWidth()));
    drawn_ = true;
  } else if (style_ == Style::lines && Clock::now() - lastLine_ >= kLineInterval) {
    print("shbake: " + progressLine(state) + "\n");
    lastLine_ = Clock::now();
  }
}

void ProgressDisplay::finish() {
  const std::lock_guard lock(mutex_);
  endStage();
  erase();
  finished_ = true;
}

void ProgressDisplay::clearLine() {
  const std::lock_guard lock(mutex_);
  erase();
}

std::vector<ProgressDisplay::Stage> ProgressDisplay::stages() const {
  const std::lock_guard lock(mutex_);
  return stages_;
}

void ProgressDisplay::endStage() {
  if (current_.stage.empty()) return;
  stages_.push_back({current_.stage, current_.unit, current_.done, current_.elapsed});
  erase();
  if (keepStages_) {
    const bool counted = current_.done > 0, timed = counted && current_.elapsed > 0;
    print("shbake: " + current_.stage + ": " + (counted ? amount(current_) + " in " : "") +
          formatDuration(current_.elapsed) + (timed ? " (" + rate(current_) + ")" : "") + "\n");
  }
  current_ = {};
}

void ProgressDisplay::erase() {
  if (drawn_) print("\r\033[K");
  drawn_ = false;
}

}  // namespace shbake::cli
