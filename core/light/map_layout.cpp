// Layouts of environment maps. Angular map: Debevec, "Light Probe Image Gallery", 1998. OpenEXR's cube: the convention
// of ImfEnvmap in OpenEXR. Crosses and strips: the order of faces that Direct3D and OpenGL share.
#include "light/map_layout.h"

#include <array>
#include <utility>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::array<std::pair<MapLayout, const char*>, 8> kNames{{
    {MapLayout::automatic, "auto"},
    {MapLayout::latLong, "lat-long"},
    {MapLayout::angular, "angular"},
    {MapLayout::crossHorizontal, "cross-horizontal"},
    {MapLayout::crossVertical, "cross-vertical"},
    {MapLayout::stripHorizontal, "strip-horizontal"},
    {MapLayout::stripVertical, "strip-vertical"},
    {MapLayout::openexrCube, "openexr-cube"},
}};

/// Layouts that a shape tells, by faces or units across and down.
struct Shape {
  MapLayout layout;
  int across, down;
};
constexpr std::array<Shape, 6> kShapes{{
    {MapLayout::latLong, 2, 1},
    {MapLayout::angular, 1, 1},
    {MapLayout::crossHorizontal, 4, 3},
    {MapLayout::crossVertical, 3, 4},
    {MapLayout::stripHorizontal, 6, 1},
    {MapLayout::stripVertical, 1, 6},
}};

constexpr int kLeastAngular = 4;

constexpr Vec3d kForward{1, 0, 0}, kRight{0, -1, 0}, kUp{0, 0, 1};

/// What a face looks along; column and row place it in a layout.
struct Slot {
  Vec3d forward, right, up;
};
constexpr Slot kFrontFace{kForward, kRight, kUp};
constexpr Slot kBackFace{-kForward, -kRight, kUp};
constexpr Slot kRightFace{kRight, -kForward, kUp};
constexpr Slot kLeftFace{-kRight, kForward, kUp};
constexpr Slot kUpFace{kUp, kRight, -kForward};
constexpr Slot kDownFace{-kUp, kRight, kForward};

/// The same face with its image turned by 180 degrees.
constexpr Slot turned(const Slot& slot) {
  return {slot.forward, -slot.right, -slot.up};
}

struct PlacedSlot {
  int column, row;
  Slot slot;
};

std::array<PlacedSlot, 6> placedSlots(MapLayout layout) {
  switch (layout) {
    case MapLayout::crossHorizontal:
      return {{{1, 0, kUpFace},
               {0, 1, kLeftFace},
               {1, 1, kFrontFace},
               {2, 1, kRightFace},
               {3, 1, kBackFace},
               {1, 2, kDownFace}}};
    case MapLayout::crossVertical:
      return {{{1, 0, kUpFace},
               {0, 1, kLeftFace},
               {1, 1, kFrontFace},
               {2, 1, kRightFace},
               {1, 2, kDownFace},
               {1, 3, turned(kBackFace)}}};
    case MapLayout::stripHorizontal:
      return {{{0, 0, kRightFace},
               {1, 0, kLeftFace},
               {2, 0, kUpFace},
               {3, 0, kDownFace},
               {4, 0, kFrontFace},
               {5, 0, kBackFace}}};
    case MapLayout::stripVertical:
      return {{{0, 0, kRightFace},
               {0, 1, kLeftFace},
               {0, 2, kUpFace},
               {0, 3, kDownFace},
               {0, 4, kFrontFace},
               {0, 5, kBackFace}}};
    case MapLayout::openexrCube:
      // OpenEXR's axes are x = left, y = up, z = forward, and its +Y and -Y images are upright for one who looks along
      // -Z: the other way round than those of the crosses.
      return {{{0, 0, kLeftFace},
               {0, 1, kRightFace},
               {0, 2, turned(kUpFace)},
               {0, 3, turned(kDownFace)},
               {0, 4, kFrontFace},
               {0, 5, kBackFace}}};
    default:
      throw usageError(std::string("the layout ") + layoutName(layout) + " has no cube faces",
                       "give one of the cube layouts");
  }
}

/// The number of faces across and down.
std::pair<int, int> facesOf(MapLayout layout) {
  for (const Shape& shape : kShapes) {
    if (shape.layout == layout) return {shape.across, shape.down};
  }
  return {1, 6};
}

CubeFace angularChart(int width, int height) {
  const std::string place = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (width != height) {
    throw Error({.place = place, .cause = "an angular map is square", .remedy = "name another layout"});
  }
  if (width < kLeastAngular) {
    throw Error(
        {.place = place, .cause = "an angular map has at least 4 pixels across", .remedy = "give a larger map"});
  }
  return {0, 0, width, kForward, kRight, kUp};
}

}  // namespace

const char* layoutName(MapLayout layout) {
  for (const auto& [known, name] : kNames) {
    if (known == layout) return name;
  }
  return "unknown";
}

std::optional<MapLayout> layoutNamed(const std::string& name) {
  for (const auto& [layout, known] : kNames) {
    if (name == known) return layout;
  }
  return std::nullopt;
}

std::vector<std::string> layoutNames() {
  std::vector<std::string> names;
  for (const auto& entry : kNames) names.emplace_back(entry.second);
  return names;
}

std::optional<MapLayout> guessLayout(int width, int height) {
  for (const Shape& shape : kShapes) {
    if (static_cast<long long>(width) * shape.down == static_cast<long long>(height) * shape.across) {
      return shape.layout;
    }
  }
  return std::nullopt;
}

std::vector<CubeFace> mapCharts(MapLayout layout, int width, int height) {
  if (layout == MapLayout::angular) return {angularChart(width, height)};
  const auto slots = placedSlots(layout);
  const auto [across, down] = facesOf(layout);
  const int size = width / across;
  if (size < 1 || size * across != width || size * down != height) {
    const std::string shape = std::to_string(across) + ":" + std::to_string(down);
    throw Error({.place = std::to_string(width) + "x" + std::to_string(height) + " pixels",
                 .cause = std::string("the layout ") + layoutName(layout) + " needs width : height = " + shape,
                 .remedy = "name another layout"});
  }
  std::vector<CubeFace> faces;
  for (const PlacedSlot& p : slots) {
    faces.push_back({p.column * size, p.row * size, size, p.slot.forward, p.slot.right, p.slot.up});
  }
  return faces;
}

}  // namespace shbake
