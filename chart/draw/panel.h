// A picture with axes, as data: what drawing programs are told.
#pragma once

#include <string>
#include <vector>

namespace shbake::chart {

struct Place {
  double x = 0, y = 0;
};

/// A row of places in one style.
struct Series {
  enum class Style {
    line,    ///< joined, with small marks: a method
    strong,  ///< the same, heavier: ours
    dashed,  ///< joined by dashes, with small marks
    rings,   ///< open circles around places of other series: the front
    star,    ///< a large star: the default
  };
  std::string title;  ///< in the legend
  Style style = Style::line;
  int color = 0;  ///< number in a palette that colour-blind people can tell apart, 0..7
  std::vector<Place> places;
};

struct Axis {
  std::string label;
  bool logarithmic = false;
};

/// One picture. To show more, make another: drawing asks for no more than this.
struct Panel {
  std::string name;  ///< a word for ids and file names
  std::string title;
  std::string caption;  ///< sentences below it, in pages
  Axis x, y;
  std::vector<Series> series;
};

}  // namespace shbake::chart
