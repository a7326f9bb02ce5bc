#include "config/sweep_file.hpp"

#include "base/random.hpp"
#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"
#include "support/mutated.hpp"
#include "support/sweeps_of_all_blocks.hpp"

#include <algorithm>

namespace avoidbench {
namespace {

const std::string kHead = "sweep: a\nplanners: [tunable]\n";

/// "forest, hall, …": as messages list them.
std::string generators() {
  std::string all;
  for (const std::string& name : sweep_tree().find("maps")->find("generator")->choices)
    all += (all.empty() ? "" : ", ") + name;
  return all;
}

TEST_F(SweepFiles, TheLeastSweepHasDefaults) {
  const SweepSpec sweep = read(kHead);
  EXPECT_EQ(sweep.name, "a");
  EXPECT_EQ(sweep.trials, 10);
  EXPECT_TRUE(sweep.axes.empty());
  ASSERT_EQ(sweep.planners.size(), 1U);
  EXPECT_EQ(spec_to_json(sweep.base), spec_to_json(TrialSpec{}));
}

TEST_F(SweepFiles, ReadsEveryBlock) {
  const SweepSpec sweep = read(
      "sweep: all\nseed: 24\ntrials: 3\nplanners: [tunable]\n"
      "maps:\n  generator: hall\n  area_m: [20, 25]\n  poisson_radius_m: {from: 2.3, to: 5.8, "
      "count: 8}\n"
      "  seeds: [3, 9]\n"
      "vehicle: {preset: firefly, mass_kg: 1.6}\nsensor: {fov_x_deg: 80}\nlatency: {mode: zero}\n"
      "wind: {mean_world_mps: [1, 0, 0]}\nmission: {time_limit_s: 30}\nrates: {plan_hz: 20}\n"
      "axes: {\"wind.mean_world_mps\": [[0, 0, 0], [4, 0, 0]], vehicle.max_speed_mps: [2, 4]}\n");
  EXPECT_EQ(sweep.base.seed, 24U);
  EXPECT_EQ(sweep.trials, 3);
  const HallSpec& hall = std::get<HallSpec>(sweep.base.map);
  EXPECT_EQ(hall.area_m, (std::array<double, 2>{20.0, 25.0}));
  EXPECT_EQ(hall.poisson_radius_m, 2.3);
  EXPECT_EQ(sweep.base.map_seed, 3U);
  EXPECT_EQ(sweep.base.vehicle.mass_kg, 1.6);
  EXPECT_EQ(sweep.base.vehicle.rotors.size(), 6U);
  EXPECT_EQ(sweep.base.sensor.fov_x_deg, 80.0);
  EXPECT_EQ(sweep.base.latency.mode, LatencyMode::zero);
  EXPECT_EQ(sweep.base.wind.mean_world_mps[0], 1.0);
  EXPECT_EQ(sweep.base.mission.time_limit_s, 30.0);
  EXPECT_EQ(sweep.base.rates.plan_hz, 20.0);
  ASSERT_EQ(sweep.axes.size(), 4U);
  EXPECT_EQ(sweep.axes[0].path, "map.poisson_radius_m");
  EXPECT_EQ(sweep.axes[0].values.front(), 2.3);
  EXPECT_EQ(sweep.axes[0].values[1], 2.8);
  EXPECT_EQ(sweep.axes[0].values.back(), 5.8);
  EXPECT_EQ(sweep.axes[0].values.size(), 8U);
  EXPECT_EQ(sweep.axes[1].path, "map_seed");
  EXPECT_EQ(nlohmann::json(sweep.axes[1].values).dump(), "[3,9]");
  EXPECT_EQ(sweep.axes[2].path, "wind.mean_world_mps");
  EXPECT_EQ(nlohmann::json(sweep.axes[2].values).dump(), "[[0.0,0.0,0.0],[4.0,0.0,0.0]]");
  EXPECT_EQ(sweep.axes[3].path, "vehicle.max_speed_mps");
}

TEST_F(SweepFiles, SeedsMayBeACount) {
  const SweepSpec sweep = read(kHead + "maps: {seeds: 3}\n");
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(nlohmann::json(sweep.axes[0].values).dump(), "[1,2,3]");
  EXPECT_EQ(read(kHead + "maps: {seeds: [7]}\n").base.map_seed, 7U);
  EXPECT_TRUE(read(kHead + "maps: {seeds: [7]}\n").axes.empty());
}

TEST_F(SweepFiles, PlannersAreLoadedAndTheirParametersFilledIn) {
  const SweepSpec sweep = read(
      "sweep: a\nplanners:\n  - tunable\n"
      "  - {plugin: tunable, label: mine, parameters: {horizon_m: [5, 7.5], mode: fast}}\n"
      "  - {plugin: tunable, label: quick, max_speed_mps: 6}\n");
  ASSERT_EQ(sweep.planners.size(), 4U);
  EXPECT_EQ(sweep.planners[0].label, "tunable");
  EXPECT_EQ(sweep.planners[1].label, "mine[horizon_m=5]");
  EXPECT_EQ(sweep.planners[2].label, "mine[horizon_m=7.5]");
  EXPECT_EQ(sweep.planners[3].label, "quick");
  const PlannerChoice& second = sweep.planners[2];
  ASSERT_EQ(second.parameters.size(), 5U);
  EXPECT_EQ(second.parameters[0].name, "horizon_m");
  EXPECT_EQ(second.parameters[0].number, 7.5);
  EXPECT_FALSE(second.parameters[0].is_text);
  EXPECT_EQ(second.parameters[1].number, 10.0);  // the preset
  EXPECT_EQ(second.parameters[2].text, "fast");
  EXPECT_TRUE(second.parameters[2].is_text);
  EXPECT_EQ(sweep.planners[3].parameters[4].number, 6.0);
  EXPECT_EQ(second.file_digest.size(), 64U);
  EXPECT_EQ(second.file, std::string(CONFIG_TEST_PLANNERS) + "/tunable.so");
}

/// What is given holds before a profile's numbers, also where it is the default.
TEST_F(SweepFiles, AProfileFillsInOnlyWhatIsNotGiven) {
  const auto planner = [&](const std::string& entry, const std::vector<std::string>& overrides) {
    const SweepSpec sweep = read("sweep: a\nplanners:\n  - " + entry + "\n", overrides);
    return expand(sweep).front().spec();
  };
  const auto numbers = [](const TrialSpec& spec) {  // horizon_m and max_speed_mps
    return std::pair(spec.planner.parameters[0].number, spec.planner.parameters[4].number);
  };
  const TrialSpec fast = planner("{plugin: tunable, parameters: {mode: fast}}", {});
  const TrialSpec given =
      planner("{plugin: tunable, parameters: {mode: fast, max_speed_mps: 3}}", {});
  const TrialSpec of_entry =
      planner("{plugin: tunable, max_speed_mps: 3, parameters: {mode: fast}}", {});
  const TrialSpec of_sweep =
      planner("{plugin: tunable, parameters: {mode: fast}}", {"max_speed_mps=3"});
  EXPECT_EQ(numbers(planner("tunable", {})), std::pair(5.0, 3.0));
  EXPECT_EQ(numbers(fast), std::pair(9.0, 6.0));
  EXPECT_EQ(numbers(given), std::pair(9.0, 3.0));
  EXPECT_EQ(numbers(of_entry), std::pair(9.0, 3.0));
  EXPECT_EQ(numbers(of_sweep), std::pair(9.0, 3.0));
  // Two flights, two keys; one flight, one key, however it was written.
  EXPECT_NE(trial_key(fast), trial_key(given));
  EXPECT_EQ(trial_key(given), trial_key(of_entry));
  EXPECT_EQ(trial_key(given), trial_key(of_sweep));
  EXPECT_EQ(trial_key(fast),
            trial_key(planner("{plugin: tunable, parameters: {mode: fast, horizon_m: 9, "
                              "max_speed_mps: 6}}",
                              {})));
}

TEST_F(SweepFiles, OneSpeedLimitHoldsForAllPlannersThatAreGivenNone) {
  const SweepSpec sweep = read(
      "sweep: a\nmax_speed_mps: [2, 4]\nplanners:\n  - tunable\n"
      "  - {plugin: tunable, label: own, max_speed_mps: 6}\n");
  ASSERT_EQ(sweep.planners.size(), 3U);
  EXPECT_EQ(sweep.planners[0].label, "tunable[max_speed_mps=2]");
  EXPECT_EQ(sweep.planners[0].parameters[4].number, 2.0);
  EXPECT_EQ(sweep.planners[1].parameters[4].number, 4.0);
  EXPECT_EQ(sweep.planners[2].label, "own");
  EXPECT_EQ(sweep.planners[2].parameters[4].number, 6.0);
  EXPECT_EQ(
      read("sweep: a\nplanners: [tunable]\n", {"max_speed_mps=3"}).planners[0].parameters[4].number,
      3.0);
}

TEST_F(SweepFiles, PlannerPathsAreRelativeToTheSweep) {
  std::filesystem::create_directories(folder_ / "built");
  std::filesystem::copy(std::string(CONFIG_TEST_PLANNERS) + "/tunable.so",
                        folder_ / "built/mine.so");
  const SweepSpec sweep = read("sweep: a\nplanners: [./built/mine.so]\n");
  EXPECT_EQ(sweep.planners[0].label, "tunable");
  EXPECT_EQ(sweep.planners[0].plugin, "./built/mine.so");
}

TEST_F(SweepFiles, VehiclesAndSensorsComeFromFilesBesideTheSweep) {
  write("vehicles/heavy.yaml", "preset: hummingbird\nname: heavy\nmass_kg: 0.9\n");
  write("sensors/narrow.yaml", "fov_x_deg: 60\n");
  const SweepSpec sweep = read(kHead + "vehicle: heavy\nsensor: narrow\n");
  EXPECT_EQ(sweep.base.vehicle.name, "heavy");
  EXPECT_EQ(sweep.base.vehicle.mass_kg, 0.9);
  EXPECT_EQ(sweep.base.sensor.fov_x_deg, 60.0);
  EXPECT_EQ(read(kHead + "vehicle: {preset: heavy, mass_kg: 0.8}\n").base.vehicle.mass_kg, 0.8);
  EXPECT_EQ(read(kHead + "vehicle: ./vehicles/heavy.yaml\n").base.vehicle.name, "heavy");
  EXPECT_EQ(
      problems(kHead + "vehicle: hevy\n"),
      "s.yaml:3:10: vehicle: \"hevy\" is not a vehicle (did you mean heavy?); known: agile_quad, "
      "crazyflie, firefly, heavy, hummingbird, hummingbird_rotors, racing_5in, x500");
  write("vehicles/heavy.yaml", "mas_kg: 0.9\n");
  EXPECT_EQ(problems(kHead + "vehicle: heavy\n"),
            "vehicles/heavy.yaml:1:1: vehicle.mas_kg: unknown key (did you mean mass_kg?)");
  write("vehicles/a.yaml", "preset: b\n");
  write("vehicles/b.yaml", "preset: a\n");
  EXPECT_NE(problems(kHead + "vehicle: a\n").find("presets refer to each other in a circle"),
            std::string::npos);
}

TEST_F(SweepFiles, ContradictionsStandWhereTheirValueDoesAlsoInAPreset) {
  write("sensors/near.yaml", "name: near\nmin_range_m: 5\nmax_range_m: 4\n");
  const std::string message = "sensor.min_range_m: 5 is not below max_range_m, 4";
  EXPECT_EQ(problems(kHead + "sensor: near\n"), "sensors/near.yaml:2:14: " + message);
  EXPECT_EQ(problems(kHead + "sensor: {preset: near, min_range_m: 5}\n"),
            "s.yaml:3:37: " + message);
  EXPECT_EQ(problems(kHead + "sensor: {max_range_m: 6}\naxes: {sensor.min_range_m: [1, 8]}\n"),
            "s.yaml:4:8: sensor.min_range_m: 8 is not below max_range_m, 6");
  EXPECT_EQ(problems(kHead + "sensor: {min_range_m: 2}\naxes: {sensor.max_range_m: [1, 9]}\n"),
            "s.yaml:3:23: sensor.min_range_m: 2 is not below max_range_m, 1");
}

TEST_F(SweepFiles, OverridesChangeAddAndAreChecked) {
  const std::string text = kHead + "vehicle: firefly\nmaps: {poisson_radius_m: [3, 4]}\n";
  EXPECT_TRUE(read(text, {"maps.poisson_radius_m=5"}).axes.empty());
  EXPECT_EQ(std::get<ForestSpec>(read(text, {"maps.poisson_radius_m=5"}).base.map).poisson_radius_m,
            5.0);
  EXPECT_EQ(read(text, {"rates.plan_hz=20"}).base.rates.plan_hz, 20.0);
  EXPECT_EQ(read(text, {"trials=2", "trials=4"}).trials, 4);
  const VehicleSpec vehicle = read(text, {"vehicle.mass_kg=1.4"}).base.vehicle;
  EXPECT_EQ(vehicle.mass_kg, 1.4);
  EXPECT_EQ(vehicle.name, "firefly");
  EXPECT_EQ(read(text, {"planners=[{plugin: tunable, label: x}]", "planners[0].label=y"})
                .planners[0]
                .label,
            "y");
  EXPECT_EQ(problems(text, {"rates.plan_hz=fast"}),
            "--set rates.plan_hz=fast: rates.plan_hz: expected a number, found \"fast\"");
  EXPECT_EQ(problems(text, {"trials", "=3", "a..b=1", "planners[7].label=x", "seed=[1"}),
            "--set trials: expected path=value\n--set =3: expected path=value\n"
            "--set a..b=1: 'a..b' is not a dotted path such as maps.poisson_radius_m\n"
            "--set planners[7].label=x: planners[7].label: planners has no element 7\n"
            "--set seed=[1: not valid YAML: '[' is never closed by ']'");
}

TEST_F(SweepFiles, EachProblemHasItsPlaceAndReason) {
  const std::pair<const char*, std::string> cases[] = {
      {"sweeps: 3", "s.yaml:3:1: sweeps: unknown key (did you mean sweep?)"},
      {"trials: 0", "s.yaml:3:9: trials: 0 is outside [1, 1000000]"},
      {"maps: {generator: forrest}", "s.yaml:3:19: maps.generator: \"forrest\" is not one of " +
                                         generators() + " (did you mean forest?)"},
      {"maps: {generator: hal, height_m: 4, corridor_m: 2, hight_m: 4}",
       "s.yaml:3:19: maps.generator: \"hal\" is not one of " + generators() +
           " (did you mean hall?)\n"
           "s.yaml:3:52: maps.hight_m: unknown key (did you mean height_m?)"},
      {"sensor: {kind: stereo_sgn, census_px: 4, paths: 8, disparities: 64}",
       "s.yaml:3:16: sensor.kind: \"stereo_sgn\" is not one of depth_ideal, depth_noisy, "
       "stereo_sgbm, stereo_sgm, none (did you mean stereo_sgm?)\n"
       "s.yaml:3:28: sensor.census_px: unknown key"},
      {"maps: {kind: hall, area_m: [10, 12], height_m: 4, foo: 3}",
       "s.yaml:3:8: maps.kind: unknown key (did you mean generator?)"},
      {"sensor: {p1_factor: 2, p2_factor: 3, block_px: 5}",
       "s.yaml:3:10: sensor.p1_factor: unknown key for kind depth_ideal (a key of kind "
       "stereo_sgbm; "
       "the same holds for p2_factor, block_px)"},
      {"vehicle: {preset: firefly, mass_kg: {kind: heavy, value: 3}}",
       "s.yaml:3:38: vehicle.mass_kg.kind: unknown key of a range; a range is {from, to, count} or "
       "{from, to, step}"},
      {"maps: forest", "s.yaml:3:7: maps: expected a mapping (name: value), found \"forest\""},
      {"maps: {seeds: [1, 1]}", "s.yaml:3:19: maps.seeds: 1 is given twice"},
      {"maps: {seeds: 0}", "s.yaml:3:15: maps.seeds: 0 is outside [1, 10000]"},
      {"maps: {poisson_radius_m: [3, 90]}",
       "s.yaml:3:30: maps.poisson_radius_m: 90 is outside [1, 20]"},
      {"maps: {generator: hall, bush_ratio: 1}",
       "s.yaml:3:25: maps.bush_ratio: unknown key for generator hall (a key of generator "
       "forest, avoidbench_forest)"},
      {"maps: {flight_height_m: 8}",
       "s.yaml:3:25: maps.flight_height_m: 8 is not below height_m, 6"},
      {"rates: {physics_hz: 250, plan_hz: 500}",
       "s.yaml:3:35: rates.plan_hz: 500 Hz is faster than rates.physics_hz, 250"},
      {"sensor: {min_range_m: 5, max_range_m: 5}",
       "s.yaml:3:23: sensor.min_range_m: 5 is not below max_range_m, 5"},
      {"movers: {count: -1}", "s.yaml:3:17: movers.count: -1 is outside [0, 2000]"},
      {"movers: {cuont: 3}", "s.yaml:3:10: movers.cuont: unknown key (did you mean count?)"},
      {"movers: {kind: dog}",
       "s.yaml:3:16: movers.kind: \"dog\" is not one of person, box, ball, pole, mixed (did you "
       "mean box?)"},
      {"movers: {count: 5, density_1pm2: 0.1}",
       "s.yaml:3:34: movers.density_1pm2: replaces count, but both are given"},
      {"movers: {count: 5, speed_mps: [2, 1]}",
       "s.yaml:3:31: movers.speed_mps: the least, 2, is above the greatest, 1"},
      {"tracks: {miss_ratio: 1.5}", "s.yaml:3:22: tracks.miss_ratio: 1.5 is outside [0, 1]"},
      {"sensor: {width_px: 0}", "s.yaml:3:20: sensor.width_px: 0 is outside [8, 4096]"},
      {"sensor: {height_px: -240}", "s.yaml:3:21: sensor.height_px: -240 is outside [8, 4096]"},
      {"sensor: {fov_x_deg: 180}", "s.yaml:3:21: sensor.fov_x_deg: 180 is outside [10, 170]"},
      {"sensor: {baseline_m: 0}", "s.yaml:3:22: sensor.baseline_m: 0 is outside [0.001, 10]"},
      {"sensor: {rate_hz: 0}", "s.yaml:3:19: sensor.rate_hz: 0 is outside [1, 1000]"},
      {"sensor: {jitter_ms: 40}",
       "s.yaml:3:21: sensor.jitter_ms: 40 ms is not below the time between two images, "
       "33.333333333333336 ms"},
      {"sensor: {preset: stereo_sgm, disparities: 60}",
       "s.yaml:3:43: sensor.disparities: 60 is not a multiple of 16; the next is 64"},
      {"sensor: {preset: stereo_sgbm, disparities: 320}",
       "s.yaml:3:44: sensor.disparities: 320 is not below width_px, 320"},
      {"sensor: {preset: stereo_sgbm, block_px: 4}", "s.yaml:3:41: sensor.block_px: 4 is not odd"},
      {"sensor: {preset: stereo_sgbm, p1_factor: 32}",
       "s.yaml:3:42: sensor.p1_factor: 32 is not below p2_factor, 32"},
      {"sensor: {preset: stereo_sgm, block_px: 5}",
       "s.yaml:3:30: sensor.block_px: unknown key for kind stereo_sgm (a key of kind "
       "stereo_sgbm)"},
      {"sensor: {preset: stereo_original, paths: 6}",
       "s.yaml:3:42: sensor.paths: 6 is neither 4 nor 8"},
      {"sensor: {kind: depth_ideal, disparities: 64}",
       "s.yaml:3:29: sensor.disparities: unknown key for kind depth_ideal (a key of kind "
       "stereo_sgbm, "
       "stereo_sgm)"},
      {"sensor: {kind: stereo}",
       "s.yaml:3:16: sensor.kind: \"stereo\" is not one of depth_ideal, depth_noisy, stereo_sgbm, "
       "stereo_sgm, none (did you mean stereo_sgbm?)"},
      {"sensor: {more_mountings: [{yaw: 90}]}",
       "s.yaml:3:28: sensor.more_mountings[0].yaw: unknown key (did you mean yaw_deg?)"},
      {"imu: {rate_hz: 2000}",
       "s.yaml:3:16: imu.rate_hz: 2000 Hz is faster than rates.physics_hz, 1000"},
      {"odometry: {drift: 1}",
       "s.yaml:3:12: odometry.drift: unknown key (did you mean position_drift_ratio?)"},
      {"axes: {wind.mean_mps: [1]}",
       "s.yaml:3:8: wind.mean_mps: unknown key (did you mean mean_world_mps?)"},
      {"axes: {wind.mean_world_mps: [0, 4]}",
       "s.yaml:3:30: wind.mean_world_mps: expected a list of 3 values, found \"0\"\n"
       "s.yaml:3:33: wind.mean_world_mps: expected a list of 3 values, found \"4\""},
      {"axes: {maps.poisson_radius_m: [3, 0]}",
       "s.yaml:3:35: map.poisson_radius_m: 0 is outside [1, 20]"},
      {"axes: {map.generator: [forest, hall]}",
       "s.yaml:3:8: axes.map.generator: a generator can't be an axis; write one sweep for each"},
      {"axes: {vehicle: [firefly]}", "s.yaml:3:8: axes.vehicle: is a group of fields, not one"},
      {"axes: {planner.label: [a]}",
       "s.yaml:3:8: axes.planner.label: write a planner's parameters as lists in its entry of "
       "'planners'"},
      {"maps: {poisson_radius_m: [3, 4]}\naxes: {maps.poisson_radius_m: [5, 6]}",
       "s.yaml:4:8: axes.maps.poisson_radius_m: already has several values above"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(problems(kHead + text + "\n"), expected) << text;
}

TEST_F(SweepFiles, RatesAreRoundedToTicksWithAWarning) {
  const SweepSpec sweep = read(kHead +
                               "sensor: {rate_hz: 7.7}\nrates: {plan_hz: 31, sample_hz: 100}\n"
                               "imu: {rate_hz: [200, 333]}\n");
  EXPECT_EQ(sweep.base.sensor.rate_hz, 36000.0 / 4675.0);
  EXPECT_EQ(sweep.base.rates.plan_hz, 36000.0 / 1161.0);
  EXPECT_EQ(sweep.base.rates.sample_hz, 100.0);
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(sweep.axes[0].values[0].get<double>(), 200.0);
  EXPECT_EQ(sweep.axes[0].values[1].get<double>(), 36000.0 / 108.0);
  ASSERT_EQ(sweep.warnings.size(), 3U);
  for (const char* expected :
       {"sensor.rate_hz: 7.7 Hz is not a whole number of ticks of 1/36000 s; rounded to "
        "7.7005347593582885 Hz",
        "rates.plan_hz: 31 Hz is not a whole number of ticks of 1/36000 s; rounded to "
        "31.007751937984494 Hz",
        "imu.rate_hz: 333 Hz is not a whole number of ticks of 1/36000 s; rounded to "
        "333.3333333333333 Hz"}) {
    const bool found = std::any_of(sweep.warnings.begin(), sweep.warnings.end(),
                                   [&](const auto& text) { return text.ends_with(expected); });
    EXPECT_TRUE(found) << expected;
  }
  EXPECT_TRUE(sweep.warnings[1].find("s.yaml:3:19: ") != std::string::npos) << sweep.warnings[1];
}

TEST_F(SweepFiles, ProblemsOfTheHead) {
  EXPECT_EQ(problems("trials: 3\n"),
            "s.yaml:1:1: lacks 'sweep', the name of the result set\n"
            "s.yaml:1:1: lacks 'planners', the list of planners to compare");
  EXPECT_EQ(problems("sweep: a/b\nplanners: tunable\n"),
            "s.yaml:1:8: sweep: \"a/b\" is not a name of A-Z a-z 0-9 _ . - that begins with a "
            "letter, digit or _");
  for (const std::string name : {"..", ".hidden", "-o", "\"a\\eb\"", "\"a\\nb\"", "ü"}) {
    const std::string found = problems("sweep: " + name + "\nplanners: tunable\n");
    EXPECT_NE(found.find(" is not a name of A-Z"), std::string::npos) << found;
  }
  EXPECT_EQ(problems("- 1\n"), "s.yaml:1:1: expected a mapping (name: value), found a list");
  EXPECT_EQ(problems("sweep: a\nplanners: []\n"),
            "s.yaml:2:11: planners: expected at least one planner");
}

TEST_F(SweepFiles, ProblemsOfPlanners) {
  const auto of = [&](const std::string& entry) {
    return problems("sweep: a\nplanners:\n  - " + entry + "\n");
  };
  EXPECT_TRUE(of("tunabel").starts_with(
      "s.yaml:3:5: planners[0]: no planner 'tunabel' (did you mean tunable?)"));
  EXPECT_EQ(of("{label: x}"),
            "s.yaml:3:5: planners[0]: lacks 'plugin', the planner's name or file");
  EXPECT_EQ(of("{plugin: tunable, labell: x}"),
            "s.yaml:3:23: planners[0].labell: unknown key (did you mean label?)");
  EXPECT_EQ(of("{plugin: tunable, horizon_m: 6}"),
            "s.yaml:3:23: planners[0].horizon_m: a parameter of tunable: write parameters: "
            "{horizon_m: 6}");
  EXPECT_EQ(of("{plugin: tunable, label: \"\"}"),
            "s.yaml:3:30: planners[0].label: expected 1 to 100 printable characters without outer "
            "spaces");
  EXPECT_EQ(of("{plugin: tunable, label: \"a\\nb\"}"),
            "s.yaml:3:30: planners[0].label: expected 1 to 100 printable characters without outer "
            "spaces");
  // Values of which there are several become part of labels.
  EXPECT_EQ(of("{plugin: tunable, parameters: {note: [x, \"a\\nb\"]}}"),
            "s.yaml:3:46: planners[0].parameters.note: one of several values is part of a label: "
            "expected printable characters");
  EXPECT_EQ(of("{plugin: tunable, parameters: {note: \"a\\nb\"}}"), "");
  EXPECT_EQ(of("{plugin: tunable, parameters: {note: [\"a\\nb\"]}}"), "");
  EXPECT_EQ(of("{plugin: tunable, parameters: {horizn_m: 3}}"),
            "s.yaml:3:36: planners[0].parameters.horizn_m: planner tunable has no such parameter "
            "(did you "
            "mean horizon_m?)");
  EXPECT_EQ(of("{plugin: tunable, parameters: {horizon_m: 30}}"),
            "s.yaml:3:47: planners[0].parameters.horizon_m: 30 is outside [1, 20] m");
  EXPECT_EQ(of("{plugin: tunable, parameters: {horizon_m: far}}"),
            "s.yaml:3:47: planners[0].parameters.horizon_m: expected a number, found \"far\"");
  EXPECT_EQ(of("{plugin: tunable, parameters: {steps_count: 2.5}}"),
            "s.yaml:3:49: planners[0].parameters.steps_count: 2.5 is not a whole number");
  EXPECT_EQ(of("{plugin: tunable, parameters: {mode: fst}}"),
            "s.yaml:3:42: planners[0].parameters.mode: 'fst' is not one of safe, fast (did you "
            "mean fast?)");
  EXPECT_EQ(of("tunable\n  - tunable"),
            "s.yaml:4:5: planners[1]: the label 'tunable' is that of planners[0]; give one of them "
            "another 'label'");
  // Of a planner that is not known, no key is.
  EXPECT_EQ(of("{kind: tunable, horizon_m: 3, parameters: {x: 3}}"),
            "s.yaml:3:5: planners[0]: lacks 'plugin', the planner's name or file");
  EXPECT_TRUE(
      of("{plugin: ./s.yaml, horizon_m: 3}").starts_with("s.yaml:3:14: planners[0].plugin"));
  EXPECT_EQ(of("{plugin: ./s.yaml, horizon_m: 3}").find('\n'), std::string::npos);
  EXPECT_EQ(of("[tunable]"),
            "s.yaml:3:5: planners[0]: expected a planner's name or {plugin, label, parameters}, "
            "found a list");
  EXPECT_TRUE(of("./s.yaml").starts_with("s.yaml:3:5: planners[0]: s.yaml: "));
}

TEST_F(SweepFiles, ProblemsOfAllPartsComeTogetherInOrder) {
  EXPECT_EQ(
      problems("sweep: a\ntrials: x\nmaps: {poisson_radius_m: 0}\nplanners:\n  - {plugin: tunable, "
               "a: 1}\n"
               "rate: 3\n"),
      "s.yaml:2:9: trials: expected a whole number, found \"x\"\n"
      "s.yaml:3:26: maps.poisson_radius_m: 0 is outside [1, 20]\n"
      "s.yaml:5:23: planners[0].a: unknown key (known: plugin, label, parameters, camera, "
      "filter, max_speed_mps)\n"
      "s.yaml:6:1: rate: unknown key (did you mean rates?)");
}

TEST_F(SweepFiles, TooManyTrialsAreRefused) {
  EXPECT_EQ(problems(kHead + "trials: 1000000\nmaps: {seeds: 11}\n"),
            "s.yaml:1:1: the sweep has 11000000 trials, more than 10000000");
}

TEST_F(SweepFiles, MapsAloneAreRead) {
  EXPECT_EQ(read_map("hall").trial.map.index(), 1U);
  const MapChoice choice = read_map("forest", {"poisson_radius_m=3", "maps.seeds=[5, 6]"});
  EXPECT_EQ(std::get<ForestSpec>(choice.trial.map).poisson_radius_m, 3.0);
  EXPECT_EQ(choice.trial.map_seed, 5U);
  const auto file = write("m.yaml", "generator: hall\nheight_m: 4\n");
  EXPECT_EQ(std::get<HallSpec>(read_map(file.string()).trial.map).height_m, 4.0);
  const auto sweep =
      write("w.yaml", "sweep: a\nplanners: [no_such]\nmaps: {poisson_radius_m: [4, 5]}\n");
  EXPECT_EQ(std::get<ForestSpec>(read_map(sweep.string()).trial.map).poisson_radius_m, 4.0);
  EXPECT_EQ(test::message_of([] { read_map("forrest"); }),
            "'forrest' is neither a file, nor a generator, nor a built-in sweep (did you mean "
            "forest?); generators: " +
                generators());
}

/// Bytes of a good sweep changed at random: a sweep or an InputError, nothing else.
TEST_F(SweepFiles, MutatedSweepsNeverCrash) {
  const std::string special = "{}[],:&*!|>'\"#?- \n.059eax";
  for (const std::string& text : test::sweeps_of_all_blocks()) {
    RandomStream random = stream(2, "sweep mutations");
    int accepted = 0, refused = 0;
    for (int round = 0; round < 1500; ++round) {
      try {
        read(test::mutated(text, 4, special, random));
        ++accepted;
      } catch (const InputError& error) {
        ++refused;
        EXPECT_FALSE(error.problems().empty());
      }
    }
    EXPECT_GT(accepted, 5) << text;
    EXPECT_GT(refused, 20) << text;
  }
}

/// What is given and can't mean anything is a contradiction; what a preset or a changed mode leaves
/// behind is not.
TEST_F(SweepFiles, GivenValuesThatMeanNothingAreProblems) {
  EXPECT_EQ(
      problems(kHead + "latency: {mode: zero, ms: 50}\n"),
      "s.yaml:3:27: latency.ms: has no effect in mode zero; leave it out, or write mode: fixed");
  EXPECT_EQ(problems(kHead + "latency: {mode: fixed, scale: 2}\n"),
            "s.yaml:3:31: latency.scale: has no effect in mode fixed; leave it out, or write mode: "
            "measured or replay");
  EXPECT_EQ(
      problems(kHead + "latency: {mode: zero}\naxes: {latency.ms: [0, 33]}\n"),
      "s.yaml:4:20: latency.ms: has no effect in mode zero; leave it out, or write mode: fixed");
  EXPECT_EQ(problems(kHead + "latency: {mode: [zero, fixed], ms: 50}\n"), "");
  EXPECT_EQ(problems(kHead + "latency: {mode: zero, ms: 33, scale: 1, database: ''}\n"), "");
  EXPECT_EQ(problems(kHead + "latency: {mode: fixed, ms: 50}\n", {"latency.mode=zero"}), "");
  EXPECT_NE(problems(kHead, {"latency.mode=zero", "latency.ms=50"}), "");
  write("base.yaml", "latency: {mode: fixed, ms: 50}\n");
  EXPECT_EQ(problems(kHead + "include: base.yaml\nlatency: {mode: zero}\n"), "");

  EXPECT_EQ(problems(kHead + "mission: {goal_radius_m: 2, free_radius_m: 1.5}\n"),
            "s.yaml:3:26: mission.goal_radius_m: 2 m is above free_radius_m, 1.5 m: a flight would "
            "end at the goal with obstacles between them");
  EXPECT_EQ(problems(kHead + "mission: {free_radius_m: 0.5}\n"), "");  // the default goal's is 0.8
  EXPECT_EQ(problems(kHead + "mission: {goal_radius_m: 20, free_radius_m: 10}\n").substr(0, 12),
            "s.yaml:3:26:");
  EXPECT_EQ(problems(kHead + "mission: {free_radius_m: 2.5}\n"),
            "s.yaml:3:26: mission.free_radius_m: 2.5 m is above the flight height, 2 m: the floor "
            "is nearer than that to every start and goal");
  EXPECT_EQ(problems(kHead + "maps: {flight_height_m: 1}\nmission: {free_radius_m: 0.9}\n"), "");
  EXPECT_EQ(problems(kHead + "latency: {ms: 5000}\nmission: {time_limit_s: 4}\n"),
            "s.yaml:3:15: latency.ms: 5000 ms is not below mission.time_limit_s, 4 s: no command "
            "would take effect");
}

}  // namespace
}  // namespace avoidbench
