// Meshes made from meshes: moved, scaled, turned, shuffled, joined.
#include "support/transforms.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/hash.h"

namespace shbake::shapes {
namespace {

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Appends only where both sides hold one item for each of their elements.
template <class T>
void appendOptional(std::vector<T>& all, const std::vector<T>& more) {
  if (all.empty() || more.empty()) {
    all.clear();
  } else {
    append(all, more);
  }
}

// Fisher and Yates' shuffle of 0..count-1.
std::vector<std::uint32_t> permutation(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[hashBits(seed, i) % i]);
  return order;
}

template <class T>
std::vector<T> picked(const std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (std::uint32_t i : order) result.push_back(values[i]);
  return result;
}

}  // namespace

Mesh scaled(Mesh mesh, double factor) {
  for (Vec3d& p : mesh.positions) p *= factor;
  return mesh;
}

Mesh translated(Mesh mesh, Vec3d offset) {
  for (Vec3d& p : mesh.positions) p += offset;
  return mesh;
}

Vec3d apply(const Matrix3& matrix, Vec3d v) {
  return {dot(matrix[0], v), dot(matrix[1], v), dot(matrix[2], v)};
}

Mesh rotated(Mesh mesh, const Matrix3& rotation) {
  for (Vec3d& p : mesh.positions) p = apply(rotation, p);
  for (Vec3f& n : mesh.vertexNormals) n = Vec3f(apply(rotation, Vec3d(n)));
  for (Vec3f& n : mesh.cornerNormals) n = Vec3f(apply(rotation, Vec3d(n)));
  return mesh;
}

Mesh flipped(Mesh mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    if (!mesh.cornerNormals.empty()) std::swap(mesh.cornerNormals[3 * f + 1], mesh.cornerNormals[3 * f + 2]);
  }
  for (Vec3f& n : mesh.vertexNormals) n = -n;
  for (Vec3f& n : mesh.cornerNormals) n = -n;
  return mesh;
}

Mesh merged(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  mesh.source = a.source + " and " + b.source;
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  append(mesh.positions, b.positions);
  for (const Triangle& t : b.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  appendOptional(mesh.vertexNormals, b.vertexNormals);
  appendOptional(mesh.cornerNormals, b.cornerNormals);
  appendOptional(mesh.vertexColors, b.vertexColors);
  appendOptional(mesh.faceColors, b.faceColors);
  return mesh;
}

Mesh compacted(const Mesh& mesh) {
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::uint32_t v : t) used[v] = true;
  }
  std::vector<std::uint32_t> kept, newIndex(mesh.positions.size());
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    newIndex[v] = static_cast<std::uint32_t>(kept.size());
    if (used[v]) kept.push_back(v);
  }
  Mesh result = mesh;
  result.positions = picked(mesh.positions, kept);
  result.vertexNormals = picked(mesh.vertexNormals, kept);
  result.vertexColors = picked(mesh.vertexColors, kept);
  for (Triangle& t : result.triangles) t = {newIndex[t[0]], newIndex[t[1]], newIndex[t[2]]};
  return result;
}

Mesh colored(Mesh mesh, Rgb color) {
  mesh.faceColors.assign(mesh.triangles.size(), color);
  mesh.faceColorEncoding = ColorEncoding::linear;
  return mesh;
}

Matrix3 rotationAbout(Vec3d axis, double radians) {
  const Vec3d a = normalized(axis);
  const double c = std::cos(radians), s = std::sin(radians), t = 1 - c;
  return {Vec3d(t * a.x * a.x + c, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y),
          Vec3d(t * a.x * a.y + s * a.z, t * a.y * a.y + c, t * a.y * a.z - s * a.x),
          Vec3d(t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c)};
}

Shuffled shuffled(const Mesh& mesh, std::uint64_t seed) {
  Shuffled result{mesh, permutation(mesh.positions.size(), seed), permutation(mesh.triangles.size(), seed + 1)};
  const std::vector<std::uint32_t>& vertices = result.vertexSource;
  std::vector<std::uint32_t> newIndex(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) newIndex[vertices[i]] = i;
  result.mesh.positions = picked(mesh.positions, vertices);
  result.mesh.vertexNormals = picked(mesh.vertexNormals, vertices);
  result.mesh.vertexColors = picked(mesh.vertexColors, vertices);
  result.mesh.faceColors = picked(mesh.faceColors, result.faceSource);
  for (std::size_t i = 0; i < result.faceSource.size(); ++i) {
    const std::uint32_t f = result.faceSource[i];
    const std::size_t turn = hashBits(seed + 2, f) % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = (k + turn) % 3;
      result.mesh.triangles[i][k] = newIndex[mesh.triangles[f][from]];
      if (!mesh.cornerNormals.empty()) result.mesh.cornerNormals[3 * i + k] = mesh.cornerNormals[3 * f + from];
    }
  }
  return result;
}

}  // namespace shbake::shapes
