// Attributes of vertices and faces that come in between.
#include "mesh/refine_attributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "mesh/flat_geometry.h"

namespace shbake {
namespace {

// Two floats that mean the same, each rounded to six digits or to float on its way.
constexpr double kFloatRounding = 2e-6;

/// MeshLab's texture coordinates: u, v of each corner of a face.
bool holdsCorners(const Property& p) {
  if (!p.isList || p.name != "texcoord" || !isFloatType(p.type)) return false;
  for (std::size_t i = 0; i < p.listStarts.size(); ++i) {
    if (p.listStarts[i] != 6 * i) return false;
  }
  return true;
}

double scalarAt(const Property& p, std::size_t index) {
  return withScalarType(p.type, [&]<class T>(std::type_identity<T>) {
    T value;
    std::memcpy(&value, p.values.data() + index * sizeof(T), sizeof(T));
    return static_cast<double>(value);
  });
}

void appendScalar(Property& p, double value) {
  withScalarType(p.type, [&]<class T>(std::type_identity<T>) {
    const T stored = static_cast<T>(std::is_integral_v<T> ? std::nearbyint(value) : value);
    const auto bytes = std::as_bytes(std::span(&stored, 1));
    p.values.insert(p.values.end(), bytes.begin(), bytes.end());
  });
}

/// Appends item `item` of `from`, a column like `p`.
void appendItem(Property& p, const Property& from, std::size_t item) {
  const std::size_t size = scalarSize(p.type);
  const std::size_t begin = p.isList ? from.listStarts[item] : item,
                    end = p.isList ? from.listStarts[item + 1] : item + 1;
  // Indices, since the column may be appended to itself.
  const std::size_t at = p.values.size();
  p.values.resize(at + (end - begin) * size);
  std::copy_n(from.values.data() + begin * size, (end - begin) * size, p.values.data() + at);
  if (p.isList) p.listStarts.push_back(p.listStarts.back() + (end - begin));
}

bool sameItem(const Property& p, std::size_t i, std::size_t j) {
  const std::size_t size = scalarSize(p.type);
  const auto range = [&](std::size_t k) {
    const std::size_t begin = p.isList ? p.listStarts[k] : k, end = p.isList ? p.listStarts[k + 1] : k + 1;
    return std::span(p.values.data() + begin * size, (end - begin) * size);
  };
  return std::ranges::equal(range(i), range(j));
}

Vec3f blendVector(const Blend& blend, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return {static_cast<float>(blend.apply(a.x, b.x, c.x)), static_cast<float>(blend.apply(a.y, b.y, c.y)),
          static_cast<float>(blend.apply(a.z, b.z, c.z))};
}

/// Normals of the same length at all corners have it in between too.
Vec3f blendNormal(const Blend& blend, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f mean = blendVector(blend, a, b, c);
  if (mean == a || mean == b || mean == c) return mean;
  const double size = blend.apply(length(Vec3d(a)), length(Vec3d(b)), length(Vec3d(c)));
  return Vec3f(normalized(Vec3d(mean)) * size);
}

/// Holds what one face tells of another on its plane against what that has.
class Continuation {
 public:
  Continuation(const Mesh& mesh, const std::vector<const Property*>& ofFaces,
               const std::vector<const Property*>& ofCorners, FaceSide s, FaceSide t)
      : mesh_(mesh), ofFaces_(ofFaces), ofCorners_(ofCorners), s_(s), t_(t) {
    const FaceShape shape(mesh, s.face());
    const std::uint32_t apex = t.side % 3 == 0 ? t.side + 2 : t.side - 1;
    beyond_ = blendAt(shape.corners, mesh.positions[vertexAt(apex)]);
    reach_ = std::abs(1 - beyond_.weightB - beyond_.weightC) + std::abs(beyond_.weightB) + std::abs(beyond_.weightC);
    shift_ = kPlaneUlps * shape.ulp / shape.height;
    for (std::uint32_t k = 0; k < 3; ++k) cornersS_[k] = 3 * s.face() + k;
    cornersT_ = {t.second(), t.first(), apex};
  }

  bool holds() const { return facesAgree() && verticesAgree() && cornersAgree(); }

 private:
  std::uint32_t vertexAt(std::uint32_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

  /// `at(corner)` is one affine function over both faces; its values are rounded by `rounding`, or by their floats.
  template <class At>
  bool agrees(double rounding, const At& at) const {
    if (at(s_.first()) != at(cornersT_[0]) || at(s_.second()) != at(cornersT_[1])) return false;
    const double a = at(cornersS_[0]), b = at(cornersS_[1]), c = at(cornersS_[2]);
    const auto [low, high] = std::minmax({a, b, c});
    const double size = std::max(std::abs(low), std::abs(high));
    const double slack = reach_ * (std::max(rounding, kFloatRounding * size) + shift_ * (high - low));
    return std::abs(beyond_.apply(a, b, c) - at(cornersT_[2])) <= slack;
  }

  /// The three components of the vectors that `at(corner)` gives.
  template <class At>
  bool vectorsAgree(double rounding, const At& at) const {
    return agrees(rounding, [&](std::uint32_t corner) { return double(at(corner).x); }) &&
           agrees(rounding, [&](std::uint32_t corner) { return double(at(corner).y); }) &&
           agrees(rounding, [&](std::uint32_t corner) { return double(at(corner).z); });
  }

  bool facesAgree() const {
    const std::uint32_t f = s_.face(), g = t_.face();
    if (!mesh_.faceColors.empty() && !(mesh_.faceColors[f] == mesh_.faceColors[g])) return false;
    return std::all_of(ofFaces_.begin(), ofFaces_.end(), [&](const Property* p) { return sameItem(*p, f, g); });
  }

  bool verticesAgree() const {
    const auto vectorOf = [this](const std::vector<Vec3f>& vectors) {
      return [&vectors, this](std::uint32_t corner) { return vectors[vertexAt(corner)]; };
    };
    if (!mesh_.vertexNormals.empty() && !vectorsAgree(kFloatRounding, vectorOf(mesh_.vertexNormals))) return false;
    const double rounding = mesh_.vertexColorEncoding == ColorEncoding::srgb ? 0.5 / 255 : 0;
    if (!mesh_.vertexColors.empty() && !vectorsAgree(rounding, vectorOf(mesh_.vertexColors))) return false;
    return std::all_of(mesh_.vertexProperties.begin(), mesh_.vertexProperties.end(), [&](const Property& p) {
      if (!p.isList) {
        const double half = isFloatType(p.type) ? 0 : 0.5;
        return agrees(half, [&](std::uint32_t corner) { return scalarAt(p, vertexAt(corner)); });
      }
      const std::uint32_t first = vertexAt(cornersS_[0]);
      const auto same = [&](std::uint32_t corner) { return sameItem(p, first, vertexAt(corner)); };
      return std::all_of(cornersS_.begin(), cornersS_.end(), same) && same(cornersT_[2]);
    });
  }

  bool cornersAgree() const {
    const auto normalAt = [this](std::uint32_t corner) { return mesh_.cornerNormals[corner]; };
    if (!mesh_.cornerNormals.empty() && !vectorsAgree(kFloatRounding, normalAt)) return false;
    return std::all_of(ofCorners_.begin(), ofCorners_.end(), [&](const Property* p) {
      return agrees(kFloatRounding, [&](std::uint32_t corner) { return scalarAt(*p, 2 * std::size_t(corner)); }) &&
             agrees(kFloatRounding, [&](std::uint32_t corner) { return scalarAt(*p, 2 * std::size_t(corner) + 1); });
    });
  }

  const Mesh& mesh_;
  const std::vector<const Property*>&ofFaces_, &ofCorners_;
  FaceSide s_, t_;
  std::array<std::uint32_t, 3> cornersS_, cornersT_;  // of t: those that lie on the first and second of s, the apex
  Blend beyond_;                                      // of the apex, in the face of s
  double reach_ = 0;  // sum of the weights' absolute values: how far errors at the corners of s are carried
  double shift_ = 0;  // error of the weights that rounding the corners makes
};

/// The corners of a new face in the face that it lies in.
struct CornerBlends {
  std::array<Blend, 3> at;

  CornerBlends(const Mesh& out, const Mesh& in, const Triangle& triangle, std::uint32_t source) {
    const Triangle& corners = in.triangles[source];
    const FaceShape shape(in, source);
    for (std::size_t k = 0; k < 3; ++k) {
      // A face that repeats a vertex is never divided: its corners stay in their places.
      const auto same =
          corners[k] == triangle[k] ? corners.begin() + k : std::find(corners.begin(), corners.end(), triangle[k]);
      at[k] = same == corners.end() ? blendAt(shape.corners, out.positions[triangle[k]])
                                    : Blend{.weightB = same == corners.begin() + 1 ? 1.0 : 0.0,
                                            .weightC = same == corners.begin() + 2 ? 1.0 : 0.0};
    }
  }
};

Property emptyLike(const Property& p) {
  Property empty{p.name, p.type, p.isList, p.countType, {}, {}};
  if (p.isList) empty.listStarts.push_back(0);
  return empty;
}

}  // namespace

std::uint32_t Blend::heaviest() const {
  const double weightA = 1 - weightB - weightC;
  if (weightA >= weightB && weightA >= weightC) return a;
  return weightB >= weightC ? b : c;
}

Blend blendAt(const std::array<Vec3d, 3>& corners, const Vec3d& place) {
  const Vec3d ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = place - corners[0];
  const Vec3d n = cross(ab, ac);
  const double squared = dot(n, n);
  Blend blend{.a = 0, .b = 1, .c = 2};
  if (squared > 0) {
    blend.weightB = dot(cross(ap, ac), n) / squared;
    blend.weightC = dot(cross(ab, ap), n) / squared;
  }
  return blend;
}

AttributeContinuity::AttributeContinuity(const Mesh& mesh) : mesh_(mesh) {
  for (const Property& p : mesh.faceProperties) (holdsCorners(p) ? ofCorners_ : ofFaces_).push_back(&p);
}

bool AttributeContinuity::goesOn(FaceSide s, FaceSide t) const {
  const auto vertexAt = [&](std::uint32_t corner) { return mesh_.triangles[corner / 3][corner % 3]; };
  if (vertexAt(s.first()) != vertexAt(t.second()) || vertexAt(s.second()) != vertexAt(t.first())) return false;
  return Continuation(mesh_, ofFaces_, ofCorners_, s, t).holds();
}

void appendVertices(Mesh& mesh, std::span<const Blend> blends, std::span<const Vec3d> positions) {
  mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  if (!mesh.vertexNormals.empty()) {
    std::vector<Vec3f>& n = mesh.vertexNormals;
    for (const Blend& b : blends) n.push_back(blendNormal(b, n[b.a], n[b.b], n[b.c]));
  }
  if (!mesh.vertexColors.empty()) {
    std::vector<Rgb>& v = mesh.vertexColors;
    const auto stored = [&](float x) {
      return mesh.vertexColorEncoding == ColorEncoding::srgb ? std::nearbyint(x * 255) / 255 : x;
    };
    for (const Blend& b : blends) {
      const Rgb mean = blendVector(b, v[b.a], v[b.b], v[b.c]);
      v.emplace_back(stored(mean.x), stored(mean.y), stored(mean.z));
    }
  }
  for (Property& p : mesh.vertexProperties) {
    for (const Blend& b : blends) {
      if (p.isList) {
        appendItem(p, p, b.heaviest());
      } else {
        appendScalar(p, b.apply(scalarAt(p, b.a), scalarAt(p, b.b), scalarAt(p, b.c)));
      }
    }
  }
}

void setFaces(Mesh& out, const Mesh& in, std::vector<Triangle> triangles, std::span<const std::uint32_t> sourceFace) {
  out.triangles = std::move(triangles);
  const std::size_t count = out.triangles.size();
  const auto gather = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    to.clear();
    to.reserve(count);
    for (const std::uint32_t f : sourceFace) to.push_back(from[f]);
  };
  gather(in.faceColors, out.faceColors);
  gather(in.sourcePolygons, out.sourcePolygons);
  if (!in.cornerNormals.empty()) {
    out.cornerNormals.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f* n = in.cornerNormals.data() + 3 * std::size_t(sourceFace[i]);
      for (const Blend& b : CornerBlends(out, in, out.triangles[i], sourceFace[i]).at) {
        out.cornerNormals.push_back(blendNormal(b, n[0], n[1], n[2]));
      }
    }
  }
  out.faceProperties.clear();
  for (const Property& p : in.faceProperties) {
    Property column = emptyLike(p);
    const bool corners = holdsCorners(p);
    for (std::size_t i = 0; i < count; ++i) {
      if (!corners) {
        appendItem(column, p, sourceFace[i]);
        continue;
      }
      const std::size_t first = 6 * std::size_t(sourceFace[i]);
      for (const Blend& b : CornerBlends(out, in, out.triangles[i], sourceFace[i]).at) {
        for (const std::size_t k : {first, first + 1}) {
          appendScalar(column, b.apply(scalarAt(p, k), scalarAt(p, k + 2), scalarAt(p, k + 4)));
        }
      }
      column.listStarts.push_back(6 * (i + 1));
    }
    out.faceProperties.push_back(std::move(column));
  }
}

}  // namespace shbake
