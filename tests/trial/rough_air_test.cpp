// Flights in wind, and with the other controller.
#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "support/flight_worlds.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/preset_flight.hpp"
#include "trial/run_trial.hpp"

namespace avoidbench {
namespace {

TrialSpec rough_air(const std::string& planner) {
  TrialSpec spec = spec_of(planner);
  spec.wind.mean_world_mps = {1, 0, 0};
  spec.wind.gust.amplitude_world_mps = {5, 0, 0};
  spec.wind.gust.start_s = 1.0;
  spec.wind.turbulence.model = TurbulenceModel::mil_f_8785c;
  spec.wind.kicks = {30.0, 2.0, 0.02, 0.1};
  return spec;
}

TEST(RoughAir, MovesTheVehicleAndIsRepeatable) {
  const World world = test::flight_world();
  const TrialRecord calm = fly(spec_of("straight_line"), world, test::straight_mission());
  for (const Controller controller : {Controller::rpg, Controller::lee}) {
    TrialSpec spec = rough_air("straight_line");
    spec.vehicle.controller = controller;
    const TrialRecord rough = fly(spec, world, test::straight_mission());
    EXPECT_EQ(rough.outcome, Outcome::reached_goal) << rough.reason;
    double aside = 0.0, off = 0.0;
    for (const Sample& sample : rough.samples) {
      aside = std::max(aside, std::abs(sample.position_world.x()));
      off = std::max(off, (sample.position_world - sample.reference_world).norm());
    }
    EXPECT_GT(aside, 0.05);
    EXPECT_LT(off, 1.0);
    const TrialRecord again = fly(spec, world, test::straight_mission());
    ASSERT_EQ(rough.samples.size(), again.samples.size());
    for (std::size_t i = 0; i < rough.samples.size(); ++i) {
      ASSERT_EQ(rough.samples[i].position_world, again.samples[i].position_world);
    }
    spec.mission_index = 1;  // other turbulence
    EXPECT_NE(fly(spec, world, test::straight_mission()).samples[50].position_world,
              rough.samples[50].position_world);
  }
  EXPECT_LT(std::abs(calm.samples.back().position_world.x()), 0.02);
}

TEST(RoughAir, AWindFieldThatIsNoneIsAnError) {
  TrialSpec spec = spec_of("straight_line");
  spec.wind.field.file = "/nowhere/field.txt";
  EXPECT_THROW(fly(spec, test::flight_world(), test::straight_mission()), InputError);
}

}  // namespace
}  // namespace avoidbench
