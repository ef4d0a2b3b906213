#include "mesh/patch_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/hash.h"

namespace shbake {
namespace {

// Turns that stand out by less than this share of the length wanted are passed over: what they enclose is small beside
// the triangles at the row.
constexpr double kPassedOver = 1.0 / 16;
// In offsets: what rows keep away from obstacles, and from each other (across a line they are 2 apart).
constexpr double kFromObstacles = 4, kFromRows = 1.5;
// Sharp turns take the row no farther out than this many offsets.
constexpr double kMitre = 3;
// Places on each segment of a line at which the length wanted there is asked for first.
constexpr std::size_t kSamples = 4;
constexpr double kFar = std::numeric_limits<double>::infinity();

Point2 operator+(Point2 a, Point2 b) {
  return {a.x + b.x, a.y + b.y};
}
Point2 operator-(Point2 a, Point2 b) {
  return {a.x - b.x, a.y - b.y};
}
Point2 operator*(Point2 a, double s) {
  return {a.x * s, a.y * s};
}
double dot(Point2 a, Point2 b) {
  return a.x * b.x + a.y * b.y;
}
double distance(Point2 a, Point2 b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}
Point2 leftOf(Point2 from, Point2 to) {
  const double size = distance(from, to);
  return size > 0 ? Point2{-(to.y - from.y) / size, (to.x - from.x) / size} : Point2{};
}

/// Finds places that are near.
class NearSearch {
 public:
  explicit NearSearch(double radius) : radius_(radius) {}

  bool hasNear(Point2 p) const {
    const auto [x, y] = cellOf(p);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto [begin, end] = cells_.equal_range(keyOf(i, j));
        if (std::any_of(begin, end, [&](const auto& c) { return distance(c.second, p) < radius_; })) return true;
      }
    }
    return false;
  }
  void add(Point2 p) {
    const auto [x, y] = cellOf(p);
    cells_.emplace(keyOf(x, y), p);
  }

 private:
  std::pair<std::int64_t, std::int64_t> cellOf(Point2 p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / radius_)), static_cast<std::int64_t>(std::floor(p.y / radius_))};
  }
  static std::uint64_t keyOf(std::int64_t i, std::int64_t j) {
    return hashBits(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j));
  }

  double radius_;
  std::unordered_multimap<std::uint64_t, Point2> cells_;
};

class RowMaker {
 public:
  RowMaker(PatchLocator& patch, double offset, std::span<const PatchObstacle> obstacles, const PatchLength& length)
      : patch_(patch), offset_(offset), length_(length), points_(kFromObstacles * offset), taken_(kFromRows * offset) {
    // Most are vertices inside the patch, as many as it has.
    for (const PatchObstacle& o : obstacles) {
      if (o.a.x == o.b.x && o.a.y == o.b.y) {
        points_.add(o.a);
      } else {
        pieces_.push_back(o);
      }
    }
  }

  void addBeside(const PatchLine& line) {
    if (!sample(line)) return;
    stops_.clear();
    stops_.push_back(samples_[0]);
    const std::size_t last = samples_.size() - 1;
    if (line.closed) {
      const auto farthest = std::max_element(samples_.begin(), samples_.end(), [&](const Sample& a, const Sample& b) {
        return distance(samples_[0].place, a.place) < distance(samples_[0].place, b.place);
      });
      const auto middle = static_cast<std::size_t>(farthest - samples_.begin());
      divide(0, middle);
      divide(middle, last);
      stops_.pop_back();
    } else {
      divide(0, last);
    }
    if (stops_.size() < (line.closed ? 3u : 2u)) return;
    for (const double side : {offset_, -offset_}) addRow(line.closed, side);
  }

  PatchRows take() { return std::move(rows_); }

 private:
  /// A place on a line and the length wanted there.
  struct Sample {
    Point2 place;
    double wanted;
    bool isTurn = false;
  };

  double wantedAt(Point2 p) {
    const std::uint32_t face = patch_.find(p);
    return face == PatchLocator::kNone ? kFar : length_(face, p);
  }

  /// Samples a line, its first place again behind a closed one. Where nothing is wanted, what is wanted elsewhere on
  /// the line is, with edges that grow with the distance: a line is followed as a whole, or light leaks around the ends
  /// of its rows. False: nothing is wanted anywhere.
  bool sample(const PatchLine& line) {
    samples_.clear();
    const std::size_t count = line.places.size(), segments = line.closed ? count : count - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      const Point2 a = line.places[i], b = line.places[(i + 1) % count];
      for (std::size_t k = 0; k < kSamples; ++k) {
        const Point2 p = a + (b - a) * (static_cast<double>(k) / kSamples);
        samples_.push_back({p, wantedAt(p), k == 0});
      }
    }
    const Point2 last = line.closed ? line.places[0] : line.places[count - 1];
    samples_.push_back({last, wantedAt(last)});
    const auto grade = [](const Sample& from, Sample& to) {
      to.wanted = std::min(to.wanted, from.wanted + kSteepest * distance(from.place, to.place));
    };
    for (int round = 0; round < (line.closed ? 2 : 1); ++round) {
      for (std::size_t i = 1; i < samples_.size(); ++i) grade(samples_[i - 1], samples_[i]);
      for (std::size_t i = samples_.size() - 1; i-- > 0;) grade(samples_[i + 1], samples_[i]);
      if (line.closed)
        samples_.front().wanted = samples_.back().wanted = std::min(samples_.front().wanted, samples_.back().wanted);
    }
    return std::isfinite(samples_[0].wanted);
  }

  /// Adds the stops that are needed from one sample to another, and the latter (Douglas, Peucker 1973).
  void divide(std::size_t begin, std::size_t end) {
    std::size_t worst = begin;
    double most = 0;
    const Point2 from = samples_[begin].place, left = leftOf(from, samples_[end].place);
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double out = std::abs(dot(samples_[i].place - from, left));
      if (samples_[i].isTurn && out > most) {
        most = out;
        worst = i;
      }
    }
    if (most > kPassedOver * samples_[worst].wanted) {
      divide(begin, worst);
      divide(worst, end);
    } else {
      halve(samples_[begin], samples_[end]);
    }
  }

  void halve(const Sample& from, const Sample& to) {
    Sample middle{(from.place + to.place) * 0.5, 0};
    const double size = distance(from.place, to.place);
    middle.wanted = std::min(wantedAt(middle.place), std::min(from.wanted, to.wanted) + kSteepest * size / 2);
    if (size > kLongestEdge * middle.wanted) {
      halve(from, middle);
      halve(middle, to);
    } else {
      stops_.push_back(to);
    }
  }

  void addRow(bool closed, double side) {
    const std::size_t first = rows_.points.size();
    bool isFirst = false, isLast = false;  // whether the first and the last stop have points
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const bool isHere = addPoint(placeBeside(i, closed, side), stops_[i].wanted);
      if (i == 0) isFirst = isHere;
      if (isHere && isLast) addPiece(rows_.points.size() - 2, rows_.points.size() - 1, stops_[i].wanted);
      isLast = isHere;
    }
    if (closed && isLast && isFirst) addPiece(rows_.points.size() - 1, first, stops_[0].wanted);
  }

  /// Beside a stop: at its end, a row begins a little inwards, so that it stays clear of what ends the line.
  Point2 placeBeside(std::size_t i, bool closed, double side) const {
    const std::size_t count = stops_.size();
    const bool first = i == 0 && !closed, last = i + 1 == count && !closed;
    const Point2 here = stops_[i].place, before = stops_[(i + count - 1) % count].place,
                 after = stops_[(i + 1) % count].place;
    if (first || last) {
      const Point2 left = first ? leftOf(here, after) : leftOf(before, here);
      const Point2 inwards = Point2{left.y, -left.x} * (first ? offset_ : -offset_);
      return here + left * side + inwards;
    }
    const Point2 a = leftOf(before, here), b = leftOf(here, after), both = a + b;
    const double reach = 2 / std::max(dot(both, both), 4 / (kMitre * kMitre));
    return here + both * (reach * side);
  }

  bool addPoint(Point2 p, double wanted) {
    const std::uint32_t face = patch_.find(p);
    if (face == PatchLocator::kNone || taken_.hasNear(p) || points_.hasNear(p)) return false;
    const auto isNear = [&](const PatchObstacle& o) { return distanceTo(o, p) < kFromObstacles * offset_; };
    if (std::any_of(pieces_.begin(), pieces_.end(), isNear)) return false;
    taken_.add(p);
    rows_.points.push_back({p, face});
    rows_.pieces.push_back({p, p, wanted, offset_});
    return true;
  }

  void addPiece(std::size_t from, std::size_t to, double wanted) {
    const Point2 a = rows_.points[from].place, b = rows_.points[to].place;
    rows_.joints.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
    // A point within the circle over the piece would take the edge along it away (Delaunay).
    rows_.pieces.push_back({a, b, wanted, distance(a, b) / 2});
  }

  PatchLocator& patch_;
  double offset_;
  const PatchLength& length_;
  std::vector<PatchObstacle> pieces_;    // what to keep from: pieces of the border,
  NearSearch points_;                    // points,
  NearSearch taken_;                     // and rows
  std::vector<Sample> samples_, stops_;  // of the line at hand
  PatchRows rows_;
};

}  // namespace

PatchRows rowsBeside(PatchLocator& patch, std::span<const PatchLine> lines, double offset,
                     std::span<const PatchObstacle> obstacles, const PatchLength& length) {
  RowMaker rows(patch, offset, obstacles, length);
  for (const PatchLine& line : lines) rows.addBeside(line);
  return rows.take();
}

}  // namespace shbake
