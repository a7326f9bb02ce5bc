#include <gtest/gtest.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vehicle/vehicle_spec.hpp"

/// The vehicles' masses, inertias and rotor heights are those of RotorS' parts, lumped.
namespace avoidbench {
namespace {

using Eigen::Vector3d;

/// One rigid part: its mass, where its centre of gravity is, and its moments about that along the
/// common axes.
struct BodyPart {
  double mass_kg = 0.0;
  Vector3d position_m = Vector3d::Zero();
  Vector3d inertia_kgm2 = Vector3d::Zero();
};

/// The one rigid body that `parts` make: mass, common centre of gravity, moments about it (parallel
/// axes). Products of inertia are left out; they cancel where the parts are symmetric.
BodyPart composite_body(std::span<const BodyPart> parts) {
  BodyPart body;
  Vector3d first_moment = Vector3d::Zero();
  for (const BodyPart& part : parts) {
    body.mass_kg += part.mass_kg;
    first_moment += part.mass_kg * part.position_m;
  }
  body.position_m = first_moment / body.mass_kg;
  for (const BodyPart& part : parts) {
    const Vector3d r = part.position_m - body.position_m;
    const Vector3d squares = r.cwiseProduct(r);
    body.inertia_kgm2 += part.inertia_kgm2 + part.mass_kg * Vector3d(squares.y() + squares.z(),
                                                                     squares.x() + squares.z(),
                                                                     squares.x() + squares.y());
  }
  return body;
}

/// A freely spinning rotor with these moments as a part: about its axis it carries none of the
/// body's turning, across it the mean of its two moments.
BodyPart spinning_rotor(double mass_kg, const Vector3d& position_m,
                        const Vector3d& rotor_inertia_kgm2) {
  const double across = 0.5 * (rotor_inertia_kgm2.x() + rotor_inertia_kgm2.y());
  return {mass_kg, position_m, {across, across, 0.0}};
}

/// RotorS' parts: base, rotors, the IMU and three virtual sensors at the base's origin.
BodyPart lumped(double base_kg, const Vector3d& base_inertia, const VehicleSpec& layout,
                double height_m, double rotor_kg) {
  // A rotor's moments are a 0.1 × 0.015 × 0.003 m box's, of ten times the mass (RotorS' slowdown).
  const double box_kg = 10 * rotor_kg / 12;
  const Vector3d rotor_inertia(box_kg * (0.015 * 0.015 + 0.003 * 0.003),
                               box_kg * (0.1 * 0.1 + 0.003 * 0.003),
                               box_kg * (0.1 * 0.1 + 0.015 * 0.015));
  std::vector<BodyPart> parts{{base_kg, Vector3d::Zero(), base_inertia},
                              {0.015, Vector3d::Zero(), Vector3d::Constant(1e-5)}};
  for (int i = 0; i < 3; ++i) parts.push_back({1e-5, Vector3d::Zero(), Vector3d::Constant(1e-5)});
  for (const RotorSpec& rotor : layout.rotors) {
    parts.push_back(spinning_rotor(
        rotor_kg, {rotor.position_body_m[0], rotor.position_body_m[1], height_m}, rotor_inertia));
  }
  return composite_body(parts);
}

void expect_body(const BodyPart& body, double mass_kg, double height_m, const Vector3d& inertia) {
  EXPECT_NEAR(body.mass_kg, mass_kg, 1e-12);
  EXPECT_NEAR((body.position_m - Vector3d(0, 0, height_m)).norm(), 0.0, 1e-8);
  EXPECT_NEAR((body.inertia_kgm2 - inertia).lpNorm<Eigen::Infinity>(), 0.0, 1e-8);
}

void expect_spec(const VehicleSpec& spec, const BodyPart& body, double height_m) {
  EXPECT_NEAR(spec.mass_kg, body.mass_kg, 1e-12);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(spec.inertia_kgm2[static_cast<std::size_t>(i)], body.inertia_kgm2[i], 1e-8);
  }
  for (const RotorSpec& rotor : spec.rotors) {
    EXPECT_NEAR(rotor.position_body_m[2], height_m - body.position_m.z(), 1e-8);
  }
}

TEST(CompositeBody, Hummingbird) {
  const BodyPart body = lumped(0.68, {0.007, 0.007, 0.012}, hummingbird_spec(), 0.01, 0.009);
  expect_body(body, 0.73103, 0.492456e-3, {0.00771727, 0.00771727, 0.01308040});
  expect_spec(hummingbird_spec(), body, 0.01);
}

TEST(CompositeBody, Firefly) {
  const BodyPart body = lumped(1.5, {0.0347563, 0.0458929, 0.0977}, firefly_spec(), 0.037, 0.005);
  expect_body(body, 1.54503, 0.718433e-3, {0.03565798, 0.04679459, 0.09912675});
  expect_spec(firefly_spec(), body, 0.037);
}

TEST(CompositeBody, X500) {
  // x500_base/model.sdf of PX4-gazebo-models.
  std::vector<BodyPart> parts{
      {2.0, Vector3d::Zero(), {0.02166666666666667, 0.02166666666666667, 0.04000000000000001}}};
  for (const double x : {-0.174, 0.174}) {
    for (const double y : {-0.174, 0.174}) {
      parts.push_back(
          spinning_rotor(0.016076923076923075, {x, y, 0.06},
                         {3.8464910483993325e-07, 2.6115851691700804e-05, 2.649858234714004e-05}));
    }
  }
  expect_spec(x500_spec(), composite_body(parts), 0.06);
}

TEST(CompositeBody, TwoHalvesOfARodMakeTheRod) {
  const auto rod = [](double mass, double length, double centre) {
    const double across = mass * length * length / 12;
    return BodyPart{mass, {centre, 0, 0}, {0, across, across}};
  };
  const std::vector<BodyPart> halves{rod(1, 0.5, 2.25), rod(1, 0.5, 2.75)};
  const BodyPart whole = composite_body(halves);
  EXPECT_NEAR((whole.position_m - Vector3d(2.5, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((whole.inertia_kgm2 - rod(2, 1, 0).inertia_kgm2).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace avoidbench
