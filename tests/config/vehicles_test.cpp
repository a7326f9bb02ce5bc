// Vehicles in sweep files: presets, and the two keys from which other fields follow.
#include <set>

#include "config/explain.hpp"
#include "config/sweep_fixture.hpp"
#include "sweep/key_maker.hpp"
#include "vehicle/capability.hpp"

namespace avoidbench {
namespace {

const std::string kVehicleHead = "sweep: a\nplanners: [tunable]\ntrials: 1\n";

std::vector<TrialSpec> specs_of(const SweepSpec& sweep) {
  std::vector<TrialSpec> specs;
  for (const PlannedTrial& trial : expand(sweep)) specs.push_back(trial.spec());
  return specs;
}

TEST_F(SweepFiles, BuiltInVehiclesAreThereByName) {
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    const std::vector<TrialSpec> specs =
        specs_of(read(kVehicleHead + "vehicle: " + vehicle.name + "\n"));
    EXPECT_EQ(spec_to_json(specs.front().vehicle), spec_to_json(vehicle)) << vehicle.name;
  }
}

TEST_F(SweepFiles, DerivedKeysOfVehiclesAreSettledForEachTrial) {
  const std::string text =
      kVehicleHead + "vehicle: {thrust_to_weight: 4, angular_acceleration_radps2: 60}\n";
  const VehicleSpec vehicle = specs_of(read(text)).front().vehicle;
  EXPECT_NEAR(thrust_to_weight(vehicle), 4.0, 1e-12);
  EXPECT_NEAR(roll_pitch_acceleration_radps2(vehicle), 60.0, 1e-9);
  EXPECT_EQ(vehicle.thrust_to_weight, 4.0);  // kept, so that reports know the setting
  EXPECT_NEAR(vehicle.max_acceleration_mps2, 0.7 * 3.0 * 9.81, 1e-9);
  EXPECT_EQ(vehicle.max_speed_mps, 8.0);
  // A vehicle's own file may have them, and a sweep others.
  write("vehicles/strong.yaml", "preset: firefly\nname: strong\nthrust_to_weight: 4\n");
  EXPECT_NEAR(thrust_to_weight(specs_of(read(kVehicleHead + "vehicle: strong\n")).front().vehicle),
              4.0, 1e-12);
  const SweepSpec other = read(kVehicleHead + "vehicle: {preset: strong, thrust_to_weight: 3}\n");
  EXPECT_NEAR(thrust_to_weight(specs_of(other).front().vehicle), 3.0, 1e-12);
}

TEST_F(SweepFiles, DerivedKeysOfVehiclesAreAxes) {
  for (const std::string text :
       {"axes: {vehicle.thrust_to_weight: {from: 2, to: 5, count: 4}, vehicle.mass_kg: [0.7, "
        "0.9]}\n",
        "vehicle: {thrust_to_weight: {from: 2, to: 5, count: 4}, mass_kg: [0.7, 0.9]}\n"}) {
    std::set<std::string> keys;
    std::set<double> ratios;
    for (const TrialSpec& spec : specs_of(read(kVehicleHead + text))) {
      keys.insert(trial_key(spec));
      ratios.insert(spec.vehicle.thrust_to_weight);
      // By each trial's own mass.
      EXPECT_NEAR(thrust_to_weight(spec.vehicle), spec.vehicle.thrust_to_weight, 1e-12);
      EXPECT_NEAR(4.0 * 8.54858e-6 * spec.vehicle.max_rotor_speed_radps *
                      spec.vehicle.max_rotor_speed_radps,
                  spec.vehicle.thrust_to_weight * spec.vehicle.mass_kg * 9.81, 1e-9);
    }
    EXPECT_EQ(keys.size(), 8U);
    EXPECT_EQ(ratios, (std::set<double>{2, 3, 4, 5}));
  }
}

TEST_F(SweepFiles, WhatFollowsFromADerivedKeyCantStandBesideIt) {
  const std::string follows =
      " follows from thrust_to_weight, which is 4; leave one of the two out";
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {thrust_to_weight: 4, max_rotor_speed_radps: 900}\n"),
            "s.yaml:4:55: vehicle.max_rotor_speed_radps:" + follows);
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {max_acceleration_mps2: 5}\n"
                                    "axes: {vehicle.thrust_to_weight: [0, 4]}\n"),
            "s.yaml:4:34: vehicle.max_acceleration_mps2:" + follows);
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {thrust_to_weight: 4}\n"
                                    "axes: {vehicle.max_tilt_rad: [0.5, 1]}\n"),
            "s.yaml:5:30: vehicle.max_tilt_rad:" + follows);
  write("vehicles/v.yaml", "thrust_to_weight: 4\nmax_jerk_mps3: 50\n");
  EXPECT_EQ(problems(kVehicleHead + "vehicle: v\n"),
            "vehicles/v.yaml:2:16: vehicle.max_jerk_mps3:" + follows);
  EXPECT_EQ(
      problems(kVehicleHead +
               "vehicle: {angular_acceleration_radps2: 80, inertia_kgm2: [1, 1, 1]}\n"),
      "s.yaml:4:58: vehicle.inertia_kgm2: follows from angular_acceleration_radps2, which is 80; "
      "leave one of the two out");
  // 0 says nothing, and what a preset says is laid over.
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {thrust_to_weight: 0, max_jerk_mps3: 50}\n"), "");
  write("vehicles/w.yaml", "max_jerk_mps3: 50\n");
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {preset: w, thrust_to_weight: 4}\n"), "");
}

TEST_F(SweepFiles, ImpossibleDerivedKeysAreToldWhereTheyStand) {
  EXPECT_EQ(
      problems(kVehicleHead + "vehicle: {thrust_to_weight: 0.9}\n"),
      "s.yaml:4:29: vehicle.thrust_to_weight: 0.9 is too weak to hover and to hold its height in "
      "flight; at least 1.05");
  EXPECT_EQ(problems(kVehicleHead + "axes: {vehicle.angular_acceleration_radps2: [1, 80]}\n"),
            "s.yaml:4:8: vehicle.angular_acceleration_radps2: 1 is too slow to be held upright; at "
            "least 5");
  EXPECT_EQ(problems(kVehicleHead + "vehicle: {thrust_to_weight: 16}\n"),
            "s.yaml:4:29: vehicle.thrust_to_weight: 16 is outside [0, 15]");
}

TEST_F(SweepFiles, ExplainingVehiclesShowsWhatEachCanDo) {
  const std::vector<Explanation> about = explain("vehicle", {});
  ASSERT_EQ(about.size(), 2U);
  ASSERT_EQ(about[1].keys.size(), vehicle_presets().size());
  EXPECT_EQ(about[1].keys[3][0], "racing_5in");
  EXPECT_EQ(about[1].keys[3][1], "4.10");
}

}  // namespace
}  // namespace avoidbench
