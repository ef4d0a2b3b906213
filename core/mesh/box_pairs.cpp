// Pairs of boxes by CGAL (A. Zomorodian, H. Edelsbrunner, "Fast software for box intersections", IJCGA 2002).
#include "mesh/box_pairs.h"

#include <CGAL/box_intersection_d.h>

#include <vector>

namespace shbake {

void forEachMeeting(std::span<const Box> first, std::span<const Box> second,
                    const std::function<void(std::size_t, std::size_t)>& visit) {
  using Numbered = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  const auto numbered = [](std::span<const Box> boxes) {
    std::vector<Numbered> all;
    all.reserve(boxes.size());
    for (const Box& b : boxes) {
      double low[] = {b.low.x, b.low.y, b.low.z}, high[] = {b.high.x, b.high.y, b.high.z};
      all.emplace_back(low, high, all.size());
    }
    return all;
  };
  std::vector<Numbered> a = numbered(first), b = numbered(second);
  CGAL::box_intersection_d(a.begin(), a.end(), b.begin(), b.end(),
                           [&](const Numbered& i, const Numbered& j) { visit(i.info(), j.info()); });
}

}  // namespace shbake
