// Lighting points: welding (position, normal, albedo) triples by record. The word and the idea are Green's ("Spherical
// harmonic lighting: the gritty details", GDC 2003): light is computed once for each distinct vertex-normal pair.
#include "mesh/lighting_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/passes.h"
#include "mesh/face_fans.h"
#include "mesh/smooth_normals.h"
#include "mesh/weld.h"

namespace shbake {
namespace {

// Normals as files store them (six digits, or a float normalised twice) differ by less than this when they mean the
// same.
constexpr float kSameNormal = 1e-6f;

// What can be told without looking at every face.
void checkSizes(const Mesh& mesh, const LightingPointOptions& options, const Albedo& albedo) {
  if (!(options.creaseDegrees >= 0 && options.creaseDegrees <= 180)) {
    throw usageError("the crease angle is " + std::to_string(options.creaseDegrees) + " degrees",
                     "give an angle from 0 to 180");
  }
  if (mesh.triangles.empty()) {
    throw Error({.file = mesh.source, .cause = "the mesh has no faces", .remedy = "light is baked for surfaces only"});
  }
  if (mesh.triangles.size() > LightingPoints::kMaxFaces) {
    throw Error({.file = mesh.source,
                 .cause = "the mesh has " + std::to_string(mesh.triangles.size()) + " triangles",
                 .remedy = "split it into parts of at most " + std::to_string(LightingPoints::kMaxFaces)});
  }
  const std::size_t vertices = mesh.positions.size(), faces = mesh.triangles.size();
  const std::size_t needed = albedo.per == Albedo::Per::mesh ? 1 : albedo.per == Albedo::Per::vertex ? vertices : faces;
  if (albedo.values.size() != needed) {
    throw usageError("there are " + std::to_string(albedo.values.size()) + " albedo values where " +
                     std::to_string(needed) + " are needed");
  }
}

// Two passes.
void checkValues(const Mesh& mesh, const Albedo& albedo, Passes& passes) {
  const std::size_t vertices = mesh.positions.size();
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (v < vertices && isFinite(mesh.positions[v])) continue;
      const std::string name = "vertex " + std::to_string(v);
      throw Error({.file = mesh.source,
                   .place = "triangle " + std::to_string(f),
                   .cause = v < vertices ? name + " is not at a finite position" : name + " does not exist",
                   .remedy = "repair the mesh"});
    }
  });
  passes.forEach(albedo.values.size(), [&](std::size_t i) {
    if (!isFinite(albedo.values[i])) throw usageError("an albedo value is not a finite number");
  });
}

// A vector of the file at unit length; nothing when it points nowhere.
std::optional<Vec3f> usableNormal(const Vec3f& stored) {
  if (!isFinite(stored) || stored == Vec3f()) return std::nullopt;
  return Vec3f(normalized(Vec3d(stored))) + Vec3f();
}

// The normal of each corner, from where the options say.
class CornerNormals {
 public:
  CornerNormals(const Mesh& mesh, const LightingPointOptions& options, const LightingPoints& points, Progress& progress)
      : mesh_(mesh), points_(points), source_(options.normals) {
    const bool fromFile = source_ == NormalSource::automatic && allOfFile(progress);
    if (source_ != NormalSource::flat && !fromFile) {
      smooth_ = smoothNormals(points.positions, points.faces, options.creaseDegrees * std::numbers::pi / 180, progress);
    }
  }

  /// Nothing where neither the file nor the geometry gives the corner a normal.
  std::optional<Vec3f> at(std::uint32_t corner) const {
    if (source_ == NormalSource::flat) {
      const Vec3d normal = faceNormal(points_.positions, points_.faces[corner / 3]);
      return normal == Vec3d() ? std::nullopt : std::optional(Vec3f(normal) + Vec3f());
    }
    if (source_ == NormalSource::automatic) {
      if (const std::optional<Vec3f> stored = ofFile(corner)) return stored;
    }
    const std::uint32_t sector = smooth_.ofCorner[corner];
    return sector == SmoothNormals::kNone ? std::nullopt : std::optional(smooth_.normals[sector]);
  }

 private:
  std::optional<Vec3f> ofFile(std::uint32_t corner) const {
    if (!mesh_.cornerNormals.empty()) return usableNormal(mesh_.cornerNormals[corner]);
    if (!mesh_.vertexNormals.empty()) return usableNormal(mesh_.vertexNormals[mesh_.triangles[corner / 3][corner % 3]]);
    return std::nullopt;
  }

  bool allOfFile(Progress& progress) const {
    if (mesh_.cornerNormals.empty() && mesh_.vertexNormals.empty()) return false;
    bool all = true;
    Passes passes(progress, "normals", mesh_.triangles.size(), "faces", 1);
    passes.forEach<std::uint32_t>(3 * mesh_.triangles.size(), [&](std::uint32_t c) { all = all && ofFile(c); });
    passes.end();
    return all;
  }

  const Mesh& mesh_;
  const LightingPoints& points_;
  NormalSource source_;
  SmoothNormals smooth_;
};

// Groups the corners at one position after the other into points.
class PointMaker {
 public:
  PointMaker(const Mesh& mesh, const Albedo& albedo, const CornerNormals& normals, LightingPoints& points)
      : mesh_(mesh), albedo_(albedo), normals_(normals), points_(points) {}

  void addPosition(std::uint32_t position, std::span<const std::uint32_t> corners) {
    position_ = position;
    first_ = points_.size();
    items_.clear();
    without_.clear();
    for (const std::uint32_t c : corners) {
      const Rgb rho = albedo_.ofCorner(c / 3, mesh_.triangles[c / 3][c % 3]) + Rgb();
      const std::optional<Vec3f> normal = normals_.at(c);
      (normal ? items_ : without_).push_back({rho, normal.value_or(Vec3f()), c});
    }
    assign(items_, true);
    if (without_.empty()) return;
    const Vec3f mean = meanNormal();
    for (Item& item : without_) item.normal = mean;
    assign(without_, false);
  }

 private:
  struct Item {
    Rgb albedo;
    Vec3f normal;
    std::uint32_t corner;
  };

  // Sorted first, so that points are numbered, and normals merged, in an order that only their values decide.
  void assign(std::vector<Item>& items, bool newestSuffice) {
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
      return std::tie(a.albedo.x, a.albedo.y, a.albedo.z, a.normal.x, a.normal.y, a.normal.z) <
             std::tie(b.albedo.x, b.albedo.y, b.albedo.z, b.normal.x, b.normal.y, b.normal.z);
    });
    for (const Item& item : items) points_.facePoints[item.corner / 3][item.corner % 3] = pointFor(item, newestSuffice);
  }

  // The position's point that `item` agrees with; a new one if there is none. Behind a point with another albedo or too
  // small an x, sorted items have nothing to find.
  std::uint32_t pointFor(const Item& item, bool newestSuffice) {
    for (std::size_t q = points_.size(); q-- > first_;) {
      const Vec3f d = points_.pointNormal[q] - item.normal;
      const bool sameAlbedo = points_.pointAlbedo[q] == item.albedo;
      if (newestSuffice && (!sameAlbedo || d.x < -kSameNormal)) break;
      if (sameAlbedo && std::abs(d.x) <= kSameNormal && std::abs(d.y) <= kSameNormal && std::abs(d.z) <= kSameNormal) {
        return static_cast<std::uint32_t>(q);
      }
    }
    points_.pointPosition.push_back(position_);
    points_.pointNormal.push_back(item.normal);
    points_.pointAlbedo.push_back(item.albedo);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  Vec3f meanNormal() const {
    Vec3d sum;
    for (std::size_t q = first_; q < points_.size(); ++q) sum += Vec3d(points_.pointNormal[q]);
    const double count = static_cast<double>(points_.size() - first_);
    // Unit normals that cancel leave a few roundings of floats.
    return length(sum) > count * 0x1p-20 ? Vec3f(normalized(sum)) + Vec3f() : Vec3f(0, 0, 1);
  }

  const Mesh& mesh_;
  const Albedo& albedo_;
  const CornerNormals& normals_;
  LightingPoints& points_;
  std::uint32_t position_ = 0;
  std::size_t first_ = 0;
  std::vector<Item> items_, without_;
};

void makePoints(const Mesh& mesh, const Albedo& albedo, const CornerNormals& normals, const PackedLists& corners,
                LightingPoints& points, Passes& passes) {
  points.facePoints.resize(points.faces.size());
  points.pointPosition.reserve(corners.size());
  points.pointNormal.reserve(corners.size());
  points.pointAlbedo.reserve(corners.size());
  PointMaker maker(mesh, albedo, normals, points);
  passes.forEach<std::uint32_t>(corners.size(), [&](std::uint32_t p) { maker.addPosition(p, corners[p]); });
}

// Turns lists of corners into lists of faces, in place and without the degenerate ones.
PackedLists facesAtPositions(const std::vector<Triangle>& faces, PackedLists corners, Passes& passes) {
  std::uint32_t kept = 0, begin = 0;
  passes.forEach(corners.size(), [&](std::size_t p) {
    const std::uint32_t end = corners.starts[p + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t face = corners.items[i] / 3;
      if (!isDegenerate(faces[face])) corners.items[kept++] = face;
    }
    corners.starts[p + 1] = kept;
    begin = end;
  });
  corners.items.resize(kept);
  return corners;
}

// Winds each face so that its front is the side of its corners' normals.
void turnFaces(LightingPoints& points, Passes& passes) {
  points.turned.assign(points.faces.size(), 0);
  passes.forEach(points.faces.size(), [&](std::size_t f) {
    Triangle &face = points.faces[f], &corners = points.facePoints[f];
    Vec3d sum;
    for (const std::uint32_t q : corners) sum += Vec3d(points.pointNormal[q]);
    if (dot(faceNormal(points.positions, face), sum) >= 0) return;
    std::swap(face[1], face[2]);
    std::swap(corners[1], corners[2]);
    points.turned[f] = 1;
  });
}

// Lists the vertices to write. A vertex that was split keeps the point of its first corner; each further point gets a
// vertex of its own, found again through the list of those that were appended for that point. Two passes.
void numberOutput(const Mesh& mesh, LightingPoints& points, Passes& passes) {
  constexpr std::uint32_t kNone = LightingPoints::kNone;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  points.outputPoint.assign(vertices, kNone);
  points.outputSource.resize(vertices);
  passes.forEach<std::uint32_t>(vertices, [&](std::uint32_t v) { points.outputSource[v] = v; });
  points.outputFaces.resize(mesh.triangles.size());
  std::vector<std::uint32_t> latest(points.size(), kNone), earlier;  // appended vertices by point, and chained by index

  const auto outputOf = [&](std::uint32_t v, std::uint32_t point) {
    if (points.outputPoint[v] == kNone) points.outputPoint[v] = point;
    if (points.outputPoint[v] == point) return v;
    for (std::uint32_t o = latest[point]; o != kNone; o = earlier[o - vertices]) {
      if (points.outputSource[o] == v) return o;
    }
    const auto added = static_cast<std::uint32_t>(points.outputPoint.size());
    points.outputPoint.push_back(point);
    points.outputSource.push_back(v);
    earlier.push_back(std::exchange(latest[point], added));
    return added;
  };
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t turned = points.turned[f] && k > 0 ? 3 - k : k;
      points.outputFaces[f][k] = outputOf(mesh.triangles[f][k], points.facePoints[f][turned]);
    }
  });
}

// The positions of a mesh, and its faces between them.
void weldFaces(const Mesh& mesh, const Albedo& albedo, LightingPoints& points, Progress& progress) {
  // Values 2, frame 1, weld 3, faces 1.
  Passes passes(progress, "welding", mesh.triangles.size(), "faces", 7);
  checkValues(mesh, albedo, passes);
  points.frame = workFrameOf(mesh, passes);
  Weld weld = weldPositions(mesh, points.frame, passes);
  points.positions = std::move(weld.positions);
  points.faces.reserve(mesh.triangles.size());
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    points.faces.push_back({weld.ofVertex[t[0]], weld.ofVertex[t[1]], weld.ofVertex[t[2]]});
  });
  passes.end();
}

}  // namespace

LightingPoints makeLightingPoints(const Mesh& mesh, const LightingPointOptions& options, const Albedo& albedo,
                                  Progress& progress) {
  checkSizes(mesh, options, albedo);
  LightingPoints points;
  weldFaces(mesh, albedo, points, progress);
  std::optional<CornerNormals> normals(std::in_place, mesh, options, points, progress);

  // Corners 4, points 1, faces at positions 1, turned faces 1, output 2.
  Passes passes(progress, "lighting points", mesh.triangles.size(), "faces", 9);
  PackedLists corners = cornersAtPositions(points.faces, points.positions.size(), passes);
  makePoints(mesh, albedo, *normals, corners, points, passes);
  normals.reset();
  points.positionFaces = facesAtPositions(points.faces, std::move(corners), passes);
  turnFaces(points, passes);
  numberOutput(mesh, points, passes);
  passes.end();
  return points;
}

}  // namespace shbake
