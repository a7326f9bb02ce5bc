// What the expert knows of a map, and the flights that it gives samples of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "expert/clearance_field.hpp"
#include "expert/sample_flight.hpp"
#include "support/flight_worlds.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;

/// A closed cube of 2 m, its middle at (0, 0, 2), over a floor.
avoidbench::World cube_world() {
  avoidbench::World world = avoidbench::test::flight_world();
  avoidbench::test::add_obstacle(world, avoidbench::test::box_mesh({2, 2, 2}), {0, 0, 2}, "cube");
  return world;
}

/// Known 3 m around the cube, where flights come from `free_place`.
ClearanceField field_around_the_cube(const Vector3d& free_place) {
  const avoidbench::World world = cube_world();
  const avoidbench::Scene scene(world);
  const avoidbench::Aabb region(Vector3d(-3.0, -3.0, 0.0), Vector3d(3.0, 3.0, 4.0));
  avoidbench::ClearanceGrid grid(scene, region, 0.2);
  return make_clearance_field(grid, {free_place});
}

// Centres of cells, beside the cube's side at x = 1 and in its middle; steps are of 1 cm.
const Vector3d kBeside_m(1.3, 0.1, 1.9), kWithin_m(0.7, 0.1, 1.9), kMiddle_m(0.1, 0.1, 1.9);
constexpr double kStep_m = 0.011;

TEST(MakeClearanceField, IsNegativeWhereNoFlightCanBe) {
  const ClearanceField field = field_around_the_cube({-2.5, 0.1, 1.9});
  EXPECT_NEAR(field.at(kBeside_m), 0.3, kStep_m);
  EXPECT_NEAR(field.at(kWithin_m), -0.3, kStep_m);
  EXPECT_NEAR(field.at(kMiddle_m), -0.5, kStep_m);       // the least that a step can be
  EXPECT_NEAR(field.at({2.1, 2.1, 0.7}), 0.7, kStep_m);  // above the floor
}

/// Which side of a surface is free follows from where flights begin.
TEST(MakeClearanceField, OfFlightsWithinTheCubeIsTheOtherWayRound) {
  const ClearanceField field = field_around_the_cube(kMiddle_m);
  EXPECT_NEAR(field.at(kWithin_m), 0.3, kStep_m);
  EXPECT_NEAR(field.at(kMiddle_m), 0.9, kStep_m);
  EXPECT_NEAR(field.at(kBeside_m), -0.3, kStep_m);
}

/// A flight of 1.5 s along y over a bare floor: how far it rose above where it began.
struct Rise {
  double highest_m = 0.0, lowest_m = 0.0;
};

Rise rise_of(double disturbed_ratio, std::uint64_t seed) {
  const avoidbench::World world = avoidbench::test::flight_world();
  const avoidbench::Scene scene(world);
  avoidbench::TrialSpec spec;
  spec.mission.time_limit_s = 1.5;
  const avoidbench::Mission mission = avoidbench::test::straight_mission();
  ClearanceField field;  // free all over, 2 m from anything
  field.origin_world = {-20.0, -20.0, 0.0};
  field.cell_m = 1.0;
  field.size = {41, 41, 11};
  field.steps.assign(41 * 41 * 11, 250);
  SamplingSpec sampling;
  sampling.seed = seed;
  sampling.disturbed_ratio = disturbed_ratio;
  const SampledFlight flight = sample_flight(spec, scene, mission, field, sampling, nullptr);
  EXPECT_GT(flight.samples.size(), 20U);
  Rise rise;
  for (const Sample& sample : flight.samples) {
    const double above_m =
        sample.frame.origin_world.z() - flight.samples.front().frame.origin_world.z();
    rise.highest_m = std::max(rise.highest_m, above_m);
    rise.lowest_m = std::min(rise.lowest_m, above_m);
  }
  return rise;
}

TEST(SampleFlight, IsLevelWhereNothingLeadsItAstray) {
  const Rise rise = rise_of(0.0, 1);
  EXPECT_LT(rise.highest_m, 0.1);
  EXPECT_GT(rise.lowest_m, -0.1);
}

/// What leads astray is drawn evenly up and down.
TEST(SampleFlight, IsLedUpAndDown) {
  double highest_m = 0.0, lowest_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Rise rise = rise_of(1.0, seed);
    highest_m = std::max(highest_m, rise.highest_m);
    lowest_m = std::min(lowest_m, rise.lowest_m);
  }
  EXPECT_GT(highest_m, 0.2);
  EXPECT_LT(lowest_m, -0.2);
}

}  // namespace
}  // namespace agile
