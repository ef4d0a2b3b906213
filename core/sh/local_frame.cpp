// The axes of a lighting point, and rotations to and from them as Z X Z X Z: Green, "Spherical Harmonic Lighting: The
// Gritty Details", GDC 2003, appendix; the signs of the quarter turns are those of the basis without Condon-Shortley
// phase.
#include "sh/local_frame.h"

#include <cmath>

#include "sh/check.h"

namespace shbake::sh {
namespace {

/// The polar angles of a direction as cosines and sines.
struct Polar {
  Turn theta, phi;
};

Polar polarOf(const Vec3d& d) {
  const double rr = d.x * d.x + d.y * d.y;
  // Closer to a pole than this the squares lose their digits, while the azimuth has long ceased to move the direction.
  const double r = rr > 1e-280 ? std::sqrt(rr) : 0;
  const double length = std::sqrt(rr + d.z * d.z);
  Polar polar{.theta = {d.z / length, r / length}, .phi = {}};
  if (r > 0) polar.phi = {d.x / r, d.y / r};
  return polar;
}

Turn inverse(Turn a) {
  return {a.cosine, -a.sine};
}

Turn turnOf(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

LocalFrame localFrame(const Vec3d& normal, double spin) {
  const auto [theta, phi] = polarOf(normal);
  const Turn s = turnOf(spin);
  const Vec3d south{phi.cosine * theta.cosine, phi.sine * theta.cosine, -theta.sine};
  const Vec3d east{-phi.sine, phi.cosine, 0};
  return {.x = south * s.cosine + east * s.sine,
          .y = east * s.cosine - south * s.sine,
          .z = {phi.cosine * theta.sine, phi.sine * theta.sine, theta.cosine}};
}

FrameRotation::FrameRotation(int order) : turn_(order) {}

void FrameRotation::toWorld(const Vec3d& normal, double spin, std::span<const double> local,
                            std::span<double> world) const {
  requireCoefficients(order(), local.size(), "the input of toWorld()");
  requireCoefficients(order(), world.size(), "the output of toWorld()");
  const auto [theta, phi] = polarOf(normal);
  turn_.rotateZyz(phi, theta, turnOf(spin), local.data(), world.data());
}

void FrameRotation::toWorld(const std::array<Vec3d, 4>& normals, const std::array<double, 4>& spins,
                            std::span<const Four> local, std::span<Four> world) const {
  requireCoefficients(order(), local.size(), "the input of toWorld()");
  requireCoefficients(order(), world.size(), "the output of toWorld()");
  TurnOf<Four> phi, theta, spin;
  const auto setLane = [](TurnOf<Four>& four, int i, const Turn& one) {
    four.cosine.set(i, one.cosine);
    four.sine.set(i, one.sine);
  };
  for (int i = 0; i < 4; ++i) {
    const auto lane = static_cast<std::size_t>(i);
    const Polar polar = polarOf(normals[lane]);
    setLane(phi, i, polar.phi);
    setLane(theta, i, polar.theta);
    setLane(spin, i, turnOf(spins[lane]));
  }
  turn_.rotateZyz(phi, theta, spin, local.data(), world.data());
}

void FrameRotation::toLocal(const Vec3d& normal, double spin, std::span<const double> world,
                            std::span<double> local) const {
  requireCoefficients(order(), world.size(), "the input of toLocal()");
  requireCoefficients(order(), local.size(), "the output of toLocal()");
  const auto [theta, phi] = polarOf(normal);
  turn_.rotateZyz(inverse(turnOf(spin)), inverse(theta), inverse(phi), world.data(), local.data());
}

}  // namespace shbake::sh
