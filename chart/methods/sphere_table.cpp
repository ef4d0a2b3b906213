// Directions over the whole sphere: tabulating and summing.
#include "chart/methods/sphere_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/wide.h"
#include "sh/basis.h"

namespace shbake::chart {
namespace {

constexpr std::size_t kVector = 4;
constexpr int kFlush = 1024;

SHBAKE_WIDE void addRow(const float* row, float weight, std::size_t stride, float* sum) {
  for (std::size_t k = 0; k < stride; ++k) sum[k] += weight * row[k];
}

}  // namespace

Vec3d sphereDirection(double x, double y) {
  const double z = 1 - 2 * x, r = std::sqrt(std::max(0.0, (1 - z) * (1 + z))), phi = 2 * std::numbers::pi * y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

SphereTable::SphereTable(const std::vector<Vec3d>& directions, int order) {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  stride_ = (count + kVector - 1) / kVector * kVector;
  rows_.assign(directions.size() * stride_, 0);
  std::vector<double> y(count);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    directions_.emplace_back(directions[i]);
    sh::evaluate(order, directions[i], std::span(y));
    std::copy(y.begin(), y.end(), &rows_[i * stride_]);
  }
}

void SphereTable::add(std::size_t i, float weight, float* sum) const {
  addRow(&rows_[i * stride_], weight, stride_, sum);
}

void SphereSum::clear() {
  std::fill(part_.begin(), part_.end(), 0.0f);
  std::fill(total_.begin(), total_.end(), 0.0);
  added_ = 0;
}

void SphereSum::add(std::size_t i, float weight) {
  table_.add(i, weight, part_.data());
  if (++added_ == kFlush) flush();
}

void SphereSum::flush() {
  for (std::size_t k = 0; k < part_.size(); ++k) total_[k] += static_cast<double>(part_[k]);
  std::fill(part_.begin(), part_.end(), 0.0f);
  added_ = 0;
}

void SphereSum::finish(double factor, std::span<float> out) {
  flush();
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<float>(factor * total_[k]);
}

}  // namespace shbake::chart
