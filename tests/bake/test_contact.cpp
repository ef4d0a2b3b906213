// Faces that a position lies on without being their corner: how it lies on them, and what they block.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bake/contact.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr double kUlp = double(std::numeric_limits<float>::epsilon());
constexpr int kRays = 1024;
/// Seen along the normal, half of the sky ends in a diameter of a disc of kRays equal cells. It crosses
/// 2 sqrt(kRays / pi) of them, each of which may count on the wrong side by half.
const double kHalfSkyBound = 1 / std::sqrt(kPi * kRays);

/// One triangle with corners 0, 1, 2 and a position 3 beside it.
LightingPoints triangleAnd(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  LightingPoints points;
  for (const Vec3d& v : {a, b, c, p}) points.positions.push_back(Vec3f(v));
  points.faces = {{0, 1, 2}};
  return points;
}

std::optional<Contact> contactOf(const Vec3d& p) {
  return shbake::contactOf(triangleAnd({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, p), 0, 3, kUlp);
}

/// The share of the cosine-weighted sky that the lighting point at a place of the mesh with a normal sees.
double skyShare(const Mesh& mesh, const Vec3d& place, const Vec3d& normal) {
  const LightingPoints points = pointsOf(mesh);
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const Vec3d at(points.positions[points.pointPosition[p]]), n(points.pointNormal[p]);
    if (length(at - Vec3d(points.frame.toWork(place))) > 1e-6 || dot(n, normal) < 0.999) continue;
    return double(bakeSome(points, {p}, optionsOf(TransferKind::shadowed, 1, kRays)).transfer.visibility[p]);
  }
  FAIL("no such lighting point");
  return -1;
}

/// A floor and a wall along y = 0 that share no vertices but the ends of their common line.
Mesh floorAndWall(int floorSteps, int wallSteps) {
  return shapes::merged(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 1, 0}, floorSteps, floorSteps),
                        shapes::grid({-1, 0, 0}, {2, 0, 0}, {0, 0, 1}, wallSteps, wallSteps));
}

}  // namespace

TEST_CASE("a position lies inside a face, on an edge, at a corner, or not on it", "[contact]") {
  using Part = Contact::Part;
  const auto part = [](const Vec3d& p) { return contactOf(p).value().part; };
  CHECK(part({0.25, 0.25, 0}) == Part::inside);
  CHECK(part({0.25, 0.25, 0.9 * kUlp}) == Part::inside);
  CHECK(part({0.25, 0.25, -0.9 * kUlp}) == Part::inside);
  CHECK_FALSE(contactOf({0.25, 0.25, 1.1 * kUlp}));
  CHECK(part({0.5, 0, 0}) == Part::edge);
  CHECK(part({0.5, -0.9 * kUlp, 0}) == Part::edge);
  CHECK_FALSE(contactOf({0.5, -1.1 * kUlp, 0}));
  CHECK_FALSE(contactOf({-0.1, 0, 0}));
  CHECK(part({0.9 * kUlp, 0.9 * kUlp, 0}) == Part::corner);
  const Contact edge = contactOf({0.5, 0.5, 0}).value();
  CHECK(edge.low == 1);
  CHECK(edge.high == 2);
  CHECK(contactOf({1, 0, 0.5 * kUlp}).value().low == 1);
  // Without an extent a face is no place to lie on.
  CHECK_FALSE(shbake::contactOf(triangleAnd({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.5, 0, 0}), 0, 3, kUlp));
}

TEST_CASE("no position within a distance of a face is taken for a farther one", "[contact]") {
  constexpr double kDistance = 0.1;
  const auto isNear = [](const Vec3d& p) {
    return mayBeNear(triangleAnd({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, p), 0, 3, kDistance);
  };
  // Above and below, beyond an edge, beyond a corner: distances of 0.999 and 1.001 of it.
  for (const double part : {0.999, 1.001}) {
    const double d = part * kDistance;
    CHECK(isNear({0.25, 0.25, d}) == (part < 1));
    CHECK(isNear({0.25, 0.25, -d}) == (part < 1));
    CHECK(isNear({0.5, -d, 0}) == (part < 1));
    CHECK(isNear({0.5 + d / std::sqrt(2.0), 0.5 + d / std::sqrt(2.0), 0}) == (part < 1));
    CHECK(isNear({-d, 0.5, 0}) == (part < 1));
  }
  CHECK(isNear({-0.999 * kDistance, 0, 0}));
  CHECK(isNear({1 + 0.999 * kDistance, 0, 0}));
  CHECK_FALSE(isNear({2, -0.5, 0}));
  // A face without extent may lie anywhere to float arithmetic.
  CHECK(mayBeNear(triangleAnd({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}), 0, 3, kDistance));
}

TEST_CASE("a position is clear where other faces are farther than the clearance", "[contact]") {
  // Two sheets above each other whose faces share no position: each corner is as far from the other sheet as the gap.
  for (const double part : {0.9, 1.1}) {
    const auto sheets = [](double gap) {
      return pointsOf(shapes::merged(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2),
                                     shapes::grid({-1, -1, gap}, {2, 0, 0}, {0, 2, 0}, 2, 2)));
    };
    const LightingPoints far = sheets(1);
    const double clearance = contactsOf(far).clearance() / far.frame.scale;
    const LightingPoints points = sheets(part * clearance);
    const Contacts contacts = contactsOf(points);
    REQUIRE(contacts.size() == 0);
    INFO("gap " << part << " of the clearance");
    for (std::uint32_t p = 0; p < points.positions.size(); ++p) CHECK(contacts.isClear(p) == (part > 1));
  }
  // What is in contact is not clear.
  const LightingPoints boxes = pointsOf(shapes::boxesOnGround());
  const Contacts contacts = contactsOf(boxes);
  REQUIRE(contacts.size() > 0);
  for (std::uint32_t p = 0; p < boxes.positions.size(); ++p) {
    if (!contacts.of(p).empty()) CHECK_FALSE(contacts.isClear(p));
  }
}

TEST_CASE("the sectors of a face in contact turn about its front", "[contact]") {
  for (const Vec3d& place : {Vec3d(0.25, 0.25, 0), Vec3d(0.5, 0, 0), Vec3d(0, 0.5, 0), Vec3d(kUlp / 2, 0, 0)}) {
    const LightingPoints points = triangleAnd({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, place);
    const ContactSectors sectors = sectorsOf(points, shbake::contactOf(points, 0, 3, kUlp).value());
    CHECK(sectors.normal == Vec3d(0, 0, 1));
    const auto d = sectors.directions();
    for (std::size_t i = 0; i + 1 < d.size(); ++i) CHECK(dot(cross(d[i], d[i + 1]), sectors.normal) > 0.5);
    // The sectors hold the directions that lead into the face, and no others.
    for (int i = 0; i < 360; i += 7) {
      const double phi = (i + 0.5) * kPi / 180;
      const Vec3d direction(std::cos(phi), std::sin(phi), 0), near = place + direction * 1e-3;
      INFO(place.x << " " << place.y << ", " << i << " degrees");
      CHECK(sectors.hold(direction) == (near.x > 0 && near.y > 0 && near.x + near.y < 1));
    }
  }
}

TEST_CASE("weights at a place of contact give the place back", "[contact]") {
  const LightingPoints points = triangleAnd({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.5, 0});
  const Vec3d w = weightsAt(points, 0, 3);
  CHECK(w.x == Approx(0.25).epsilon(1e-12));
  CHECK(w.y == Approx(0.25).epsilon(1e-12));
  CHECK(w.z == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("what stands on a wide face does not see through it", "[contact]") {
  // A foot of a box that the ground's corners know nothing of: the ground hides all that is below the horizon, exactly
  // half of a wall's cosine-weighted sky.
  for (const double tilt : {0.0, 0.3, 1.1}) {
    const auto turn = shapes::rotationAbout({1, 2, 3}, tilt);
    const auto turned = [&](const Vec3d& v) {
      Mesh one;
      one.positions = {v};
      return shapes::rotated(one, turn).positions[0];
    };
    const Mesh mesh = shapes::rotated(
        shapes::merged(shapes::grid({-3, -2, 0}, {7, 0, 0}, {0, 5, 0}), shapes::box({-0.5, -0.5, 0}, {0.5, 0.5, 1})),
        turn);
    INFO("tilt " << tilt);
    for (const double side : {-1.0, 1.0}) {
      const double share = skyShare(mesh, turned({0.5, side * 0.5, 0}), turned({1, 0, 0}));
      CHECK(share == Approx(0.5).margin(kHalfSkyBound));
    }
  }
}

TEST_CASE("a floor's vertex on the edge of a wall that does not share it sees half of the sky", "[contact]") {
  // Steps of 2 against 3: the floor's middle lies within an edge of the wall, and the wall's thirds within the floor's.
  const Mesh mesh = floorAndWall(2, 3);
  CHECK(skyShare(mesh, {0, 0, 0}, {0, 0, 1}) == Approx(0.5).margin(kHalfSkyBound));
  // From the wall's foot the floor hides the lower half.
  CHECK(skyShare(mesh, {1.0 / 3, 0, 0}, {0, -1, 0}) == Approx(0.5).margin(kHalfSkyBound));
}

TEST_CASE("a closed room of walls that share no edges does not leak", "[contact]") {
  // Each wall with steps of its own: T-junctions along all edges. A front that looks outwards would see the sky.
  const auto wall = [](const Vec3d& at, const Vec3d& u, const Vec3d& v, int n) { return shapes::grid(at, u, v, n, n); };
  Mesh room = wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2);
  room = shapes::merged(room, wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 3));
  room = shapes::merged(room, wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 4));
  room = shapes::merged(room, wall({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 5));
  room = shapes::merged(room, wall({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 3));
  room = shapes::merged(room, wall({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 4));
  for (int i = 0; i < 3; ++i) {
    const LightingPoints points = pointsOf(shapes::rotated(room, shapes::rotationAbout({3, 1, 2}, 0.7 * i)));
    const PointBake bake = bakeAll(points, optionsOf(TransferKind::shadowed, 1, 256));
    const auto most = *std::max_element(bake.transfer.visibility.begin(), bake.transfer.visibility.end());
    INFO("turn " << i << ", " << contactsOf(points).size() << " contacts");
    CHECK(most == 0);
  }
}

TEST_CASE("a ground shows itself at the foot of what stands on it", "[contact]") {
  // Under a white sky, a wall on a wide white ground gets from below what the ground reflects: its foot sees the ground
  // at its own place. With albedo 1/2 everywhere the foot's reflected part is that of the ground's interpolated value.
  const Mesh mesh = shapes::merged(shapes::grid({-64, -64, 0}, {127, 0, 0}, {0, 128, 0}, 1, 1),
                                   shapes::grid({0, -0.01, 0}, {0, 0.02, 0}, {0, 0, 0.01}, 1, 1));
  const LightingPoints points = pointsOf(mesh, {0.5, 0.5, 0.5});
  BakeOptions options = optionsOf(TransferKind::interreflected, 1, kRays);
  options.bounces = 1;
  const PointBake bake = bakeAll(points, options);
  const double open = double(*std::max_element(bake.transfer.coefficients.begin(), bake.transfer.coefficients.end()));
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const Vec3d at = Vec3d(points.positions[points.pointPosition[p]]);
    if (std::abs(double(points.pointNormal[p].z)) > 0.5 || at.z > 0) continue;
    // Half of the sky, and the other half by the ground, whose corners see all of the sky: 1/2 + 1/2 * 1/2. What counts
    // on the wrong side of the horizon errs by the half that the ground swallows; hits round their weights to 1/65535.
    CHECK(double(bake.transfer.coefficients[p]) / open == Approx(0.75).margin(kHalfSkyBound / 2 + 1.0 / 65535));
  }
}
