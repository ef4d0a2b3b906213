// A stroke font: every letter a few polylines on a grid of 5 by 9 points.
#include "view/caption.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

namespace shbake {
namespace {

/// Each point is two digits: x 0..4, then y upwards 0..8 (baseline 2, small letters end at 6, capitals at 8). A blank
/// begins another polyline; two equal points make a dot.
struct Glyph {
  char letter;
  const char* strokes;
};

constexpr Glyph kGlyphs[] = {
    {'a', "4536160503123243 4642"},
    {'b', "0802 0516364543321203"},
    {'c', "4536160503123243"},
    {'d', "4842 4536160503123243"},
    {'e', "04444536160503123243"},
    {'f', "38281712 0636"},
    {'g', "4536160503123243 46413010"},
    {'h', "0802 0516364542"},
    {'i', "2622 2828"},
    {'j', "36312010 3838"},
    {'k', "0802 4604 2542"},
    {'l', "2822"},
    {'m', "0602 05162522 25364542"},
    {'n', "0602 0516364542"},
    {'o', "160503123243453616"},
    {'p', "0600 0516364543321203"},
    {'q', "4640 4536160503123243"},
    {'r', "0602 05163645"},
    {'s', "45361605143443321203"},
    {'t', "18132232 0636"},
    {'u', "0603123243 4642"},
    {'v', "062246"},
    {'w', "0612253246"},
    {'x', "0642 4602"},
    {'y', "0622 4610"},
    {'z', "06460242"},
    {'0', "180703123243473818"},
    {'1', "172822 1232"},
    {'2', "07183847460242"},
    {'3', "0718384746354443321203 1535"},
    {'4', "32380444"},
    {'5', "480805354443321203"},
    {'6', "473818070312324344351504"},
    {'7', "084812"},
    {'8', "150607183847463515 1504031232434435"},
    {'9', "031232434738180706153546"},
    {'.', "2222"},
    {',', "2211"},
    {'-', "1434"},
    {'+', "1434 2523"},
    {'/', "0248"},
    {':', "2323 2525"},
    {'(', "38262432"},
    {')', "18262412"},
    {'=', "1535 1333"},
    {'%', "0248 0707 4343"},
    {'_', "0242"},
};

constexpr double kBaseline = 2, kCapital = 6;  // the height of a capital above its baseline
constexpr double kGap = 1.9;                   // between letters
constexpr double kBlank = 2.4;                 // the width of a character without strokes
constexpr double kPen = 0.4;                   // half the width of a stroke

struct Segment {
  double ax, ay, bx, by;
};

const char* strokesOf(char letter) {
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const Glyph& g : kGlyphs) {
    if (g.letter == lower) return g.strokes;
  }
  return "";
}

/// The columns of the grid that a glyph takes.
struct Extent {
  double low = 0, high = kBlank;

  double width() const { return high - low; }
};

Extent extentOf(const char* strokes) {
  if (*strokes == 0) return {};
  Extent extent{4, 0};
  for (const char* s = strokes; *s != 0; s += s[2] == ' ' ? 3 : 2) {
    extent.low = std::min<double>(extent.low, s[0] - '0');
    extent.high = std::max<double>(extent.high, s[0] - '0');
  }
  return extent;
}

/// The strokes of a glyph in pixels; `left` and `baseline` are its corner, `unit` a step of the grid.
void addStrokes(const char* strokes, double left, double baseline, double unit, std::vector<Segment>& segments) {
  const auto x = [&](const char* s) { return left + (s[0] - '0') * unit; };
  const auto y = [&](const char* s) { return baseline - (s[1] - '0' - kBaseline) * unit; };
  for (const char* s = strokes; *s != 0;) {
    if (s[2] == ' ') {
      s += 3;
    } else if (s[2] == 0) {
      break;
    } else {
      segments.push_back({x(s), y(s), x(s + 2), y(s + 2)});
      s += 2;
    }
  }
}

double distanceTo(const Segment& s, double x, double y) {
  const double dx = s.bx - s.ax, dy = s.by - s.ay, squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((x - s.ax) * dx + (y - s.ay) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(x - s.ax - t * dx, y - s.ay - t * dy);
}

}  // namespace

void drawCaption(Picture& picture, std::string_view text, const PicturePlace& centre, double size, const Rgb& ink) {
  const double unit = size / kCapital;
  double width = -kGap * unit;
  for (const char letter : text) width += (extentOf(strokesOf(letter)).width() + kGap) * unit;
  std::vector<Segment> segments;
  double left = centre.x - width / 2;
  for (const char letter : text) {
    const Extent extent = extentOf(strokesOf(letter));
    addStrokes(strokesOf(letter), left - extent.low * unit, centre.y + size / 2, unit, segments);
    left += (extent.width() + kGap) * unit;
  }
  const double pen = kPen * unit;
  const auto low = [](double v) { return std::max(0, static_cast<int>(std::floor(v))); };
  const int first = low(centre.x - width / 2 - size),
            last = std::min<int>(picture.width, low(centre.x + width / 2 + size));
  const int top = low(centre.y - size), bottom = std::min<int>(picture.height, low(centre.y + 1.5 * size));
  for (int y = top; y < bottom; ++y) {
    for (int x = first; x < last; ++x) {
      double nearest = pen + 1;
      for (const Segment& s : segments) nearest = std::min(nearest, distanceTo(s, x + 0.5, y + 0.5));
      const auto cover = static_cast<float>(std::clamp(pen + 0.5 - nearest, 0.0, 1.0));
      Rgb& pixel = picture.at(x, y);
      pixel = pixel * (1 - cover) + ink * cover;
    }
  }
}

}  // namespace shbake
