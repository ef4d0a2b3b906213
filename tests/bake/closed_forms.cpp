// Light that flat blockers take away.
#include "bake/closed_forms.h"

#include <cmath>
#include <numbers>

#include "sh/basis.h"
#include "sh/irradiance.h"
#include "sh/quadrature.h"

namespace shbake::testing {
namespace {

constexpr int kNodes = 24;

/// Calls visit(s, t, weight) for Gauss-Legendre nodes of the unit square cut into cells x cells parts.
template <class Visit>
void overSquare(int cells, const Visit& visit) {
  const sh::IntervalRule rule = sh::gaussLegendre(kNodes);
  for (int i = 0; i < cells * kNodes; ++i) {
    for (int j = 0; j < cells * kNodes; ++j) {
      const auto a = static_cast<std::size_t>(i % kNodes), b = static_cast<std::size_t>(j % kNodes);
      const double s = (i / kNodes + (rule.nodes[a] + 1) / 2) / cells,
                   t = (j / kNodes + (rule.nodes[b] + 1) / 2) / cells;
      visit(s, t, rule.weights[a] * rule.weights[b] / (4.0 * cells * cells));
    }
  }
}

/// Adds what arrives from an area element at `q` of vector area `area`.
void addElement(int order, const Vec3d& n, const Vec3d& q, const Vec3d& area, std::vector<double>& y,
                std::vector<double>& sum) {
  const double r2 = dot(q, q), r = std::sqrt(r2);
  sh::evaluate(order, q * (1 / r), y);
  add(sum, y, dot(n, q) * std::abs(dot(area, q)) / (std::numbers::pi * r2 * r2));
}

}  // namespace

void add(std::vector<double>& a, const std::vector<double>& b, double factor) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

double formFactor(const Vec3d& n, const std::vector<Vec3d>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += angleBetween(a, b) * dot(n, normalized(cross(a, b)));
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

std::vector<double> transferThrough(int order, const Vec3d& n, const Vec3d& o, const Vec3d& u, const Vec3d& v,
                                    int cells) {
  std::vector<double> sum(static_cast<std::size_t>(order * order), 0), y(sum.size());
  const Vec3d area = cross(u, v);
  overSquare(cells, [&](double s, double t, double weight) {
    addElement(order, n, o + u * s + v * t, area * weight, y, sum);
  });
  return sum;
}

std::vector<double> transferThroughTriangle(int order, const Vec3d& n, const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                            int cells) {
  std::vector<double> sum(static_cast<std::size_t>(order * order), 0), y(sum.size());
  const Vec3d area = cross(b - a, c - a);
  overSquare(cells, [&](double s, double t, double weight) {
    addElement(order, n, a + (b - a) * (s * (1 - t)) + (c - a) * (s * t), area * (s * weight), y, sum);
  });
  return sum;
}

std::vector<double> transferOfSector(int order, double from, double to) {
  std::vector<double> sum(static_cast<std::size_t>(order * order), 0), y(sum.size());
  // cos t sin t dt = u du with u = sin t; the square root in cos t asks for the angle itself as the variable.
  overSquare(1, [&](double s, double t, double weight) {
    const double theta = s * std::numbers::pi / 2, phi = from + t * (to - from);
    const Vec3d d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    sh::evaluate(order, d, y);
    add(sum, y, weight * (to - from) / 2 * std::sin(theta) * std::cos(theta));
  });
  return sum;
}

std::vector<double> openTransfer(int order, const Vec3d& n, double albedo) {
  std::vector<double> t(static_cast<std::size_t>(order * order));
  sh::unshadowedTransfer(order, n, albedo, t);
  return t;
}

}  // namespace shbake::testing
