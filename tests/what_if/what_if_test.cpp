#include "what_if/what_if.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "base/input_error.hpp"
#include "base/option_error.hpp"
#include "metrics/metric_table.hpp"
#include "statistics/rates.hpp"
#include "support/planner_files.hpp"
#include "support/small_sweep.hpp"
#include "sweep/run_sweep.hpp"
#include "what_if/smallest_scene.hpp"
#include "what_if/what_if_tables.hpp"

namespace avoidbench {
namespace {

const std::vector<std::string> kFaults{"depth",    "latency", "crash",     "state", "wind",
                                       "tracking", "limit",   "own_speed", "view",  "range"};

PlannerChoice picky(const std::string& fault) {
  const PlannerDescription planner = PlannerLibrary::load({PICKY_FILE, {}}).description();
  return PlannerChoice{
      PluginChoice{.plugin = PICKY_FILE,
                   .label = fault,
                   .file = PICKY_FILE,
                   .file_digest = planner.file_digest,
                   .parameters = {{.name = "minds", .text = fault, .is_text = true},
                                  {.name = "cruise_speed_mps", .number = 2.0, .text = {}}}}};
}

/// A hall whose cylinders are far below, and all that a planner can mind.
SweepSpec picky_sweep(const std::vector<std::string>& faults, std::int64_t trials) {
  SweepSpec sweep;
  sweep.name = "picky";
  sweep.base.map = HallSpec{.area_m = {10, 14}, .cylinder_height_m = {0.3, 0.3}};
  sweep.base.mission.time_limit_s = 20.0;
  sweep.base.sensor.method = DepthNoisySpec{};
  sweep.base.sensor.width_px = 80;
  sweep.base.sensor.height_px = 60;
  sweep.base.odometry.rates_sigma_radps = 0.01;
  sweep.base.wind.mean_world_mps = {3.0, 0.0, 0.0};
  ImuSpec& imu = sweep.base.imu;
  imu.gyro_noise_density = imu.gyro_random_walk = imu.gyro_turn_on_bias_radps = 0.0;
  imu.accelerometer_noise_density = imu.accelerometer_random_walk = 0.0;
  imu.accelerometer_turn_on_bias_mps2 = 0.0;
  sweep.trials = trials;
  for (const std::string& fault : faults) sweep.planners.push_back(picky(fault));
  return sweep;
}

class WhatIfTest : public testing::Test {
 protected:
  WhatIfTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("what_if_" + std::to_string(::getpid()) +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~WhatIfTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path fly(const SweepSpec& sweep) {
    const std::filesystem::path file = folder_ / "flown.db";
    Database database = Database::open_for_run(file, metric_table());
    RunOptions options;
    options.jobs = 2;
    options.worker_command = worker();
    run_sweep(sweep, {}, database, options);
    return file;
  }
  static std::vector<std::string> worker() {
    return {std::string(AVOIDBENCH_BINARY_DIR) + "/avoidbench", "worker"};
  }
  static WhatIfSource source() {
    return {.read = read_stored_trial, .files = {}, .program_version = "1 test"};
  }
  static FleetOptions fleet(int jobs) {
    return {.worker_command = worker(), .sandbox = {}, .jobs = jobs};
  }

  /// Flies all that is asked for; the plan with its results.
  static WhatIfPlan answered(const std::filesystem::path& file, const WhatIfRequest& request,
                             int jobs = 2) {
    Database database = Database::open_for_run(file, metric_table());
    WhatIfPlan plan = plan_what_ifs(database, request, source());
    const WhatIfRun run =
        fly_what_ifs(plan, database, source(), fleet(jobs), [](std::size_t, std::size_t) {});
    EXPECT_FALSE(run.is_stopped);
    EXPECT_TRUE(run.unflown.empty());
    return plan;
  }

  std::filesystem::path folder_;
};

TEST_F(WhatIfTest, ExactlyTheRightChangeCures) {
  const std::map<std::string, std::string> cures{
      {"depth", "true_depth"},  {"latency", "no_latency"}, {"crash", "no_latency"},
      {"state", "true_state"},  {"wind", "no_wind"},       {"tracking", "perfect_tracking"},
      {"limit", "slower"},      {"own_speed", "slower"},   {"view", "wider_view"},
      {"range", "longer_range"}};
  std::vector<std::string> planners = kFaults;
  planners.emplace_back("nothing");
  const std::filesystem::path file = fly(picky_sweep(planners, 1));
  const WhatIfPlan plan = answered(file, {.changes = changes_of({"all", "nothing"})});
  ASSERT_EQ(plan.trials.size(), kFaults.size())
      << "the other planner has no failure, so no control";
  for (const WhatIfFlight& flight : plan.flights) {
    const WhatIfTrial& trial = plan.trials[flight.trial];
    const std::string change(flight.change->name);
    const std::string what = trial.planner_label + " with " + change;
    EXPECT_TRUE(trial.is_failure()) << what;
    if (change == "still_obstacles") {
      EXPECT_EQ(flight.not_applicable, "nothing moves on its map");
      continue;
    }
    if (change == "twice_compute") {  // latencies are fixed
      EXPECT_TRUE(flight.not_applicable.starts_with("its latency is not measured"))
          << flight.not_applicable;
      continue;
    }
    EXPECT_EQ(flight.not_applicable, "") << what;
    ASSERT_TRUE(flight.row) << what;
    EXPECT_EQ(flight.row->outcome == Outcome::reached_goal, change == cures.at(trial.planner_label))
        << what << ": " << flight.row->reason;
    if (trial.planner_label == "crash" && change == "no_wind") {
      EXPECT_EQ(flight.row->outcome, Outcome::planner_crashed) << "an outcome like others";
    }
  }
  EXPECT_TRUE(what_if_differences(plan).empty()) << what_if_differences(plan).front();
}

TEST_F(WhatIfTest, CountsFailuresAndAControl) {
  // Two maps, two missions each; the planner without faults gives the successes.
  SweepSpec sweep = picky_sweep({"latency", "nothing"}, 2);
  sweep.axes = {{.path = "map_seed", .values = {1, 2}}};
  sweep.planners[1].label = "latency_free";
  const std::filesystem::path file = fly(sweep);
  WhatIfRequest request{.changes = changes_of({"no_latency", "slower"})};
  std::vector<WhatIfCount> counts = count_what_ifs(answered(file, request));
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].failures, 4);
  EXPECT_EQ(counts[0].cured, 4);
  EXPECT_EQ(counts[0].maps, 2);
  EXPECT_EQ(counts[0].successes, 0) << "the failing planner has none";
  EXPECT_EQ(counts[1].cured, 0);
  EXPECT_EQ(sentence_of(counts[0]),
            "Without latency 4 of 4 of latency's failures vanish (100 %, 51–100).");
  request.control = 3;
  counts = count_what_ifs(answered(file, request));
  ASSERT_EQ(counts.size(), 4U);
  EXPECT_EQ(counts[2].planner_label, "latency_free");
  EXPECT_EQ(counts[2].successes, 3);
  EXPECT_EQ(counts[2].broken, 0);
  EXPECT_EQ(sentence_of(counts[2]), "Without latency, of 3 successes none breaks.");
  WhatIfPlan plan = answered(file, request);
  const Section section = what_if_section(plan, request, "");
  for (WhatIfFlight& flight : plan.flights) {
    if (plan.trials[flight.trial].is_failure()) continue;
    flight.row->outcome = Outcome::collided;
    break;
  }
  EXPECT_EQ(count_what_ifs(plan)[2].broken, 1);
  EXPECT_EQ(sentence_of(count_what_ifs(plan)[2]), "Without latency, of 3 successes 1 breaks.");
  for (const TableFormat format : {TableFormat::table, TableFormat::csv, TableFormat::json,
                                   TableFormat::markdown, TableFormat::latex}) {
    EXPECT_NE(format_sections(std::span(&section, 1), format).find("no"), std::string::npos);
  }
  // The table has what was counted, in percent; lower and upper end are Wilson's of 4 of 4.
  const Table& table = section.tables.front();
  ASSERT_EQ(table.rows.size(), 4U);
  const auto number = [&](std::string_view column) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (table.columns[i].name == column) return std::get<double>(table.rows[0][i].value);
    }
    return -1.0;
  };
  EXPECT_EQ(number("cured_pct"), 100.0);
  EXPECT_DOUBLE_EQ(number("cured_pct_lower"), 100.0 * wilson_interval(4, 4).lower);
  EXPECT_DOUBLE_EQ(number("cured_pct_upper"), 100.0 * wilson_interval(4, 4).upper);
  // A larger control has the smaller one's trials.
  request.control = 4;
  const WhatIfPlan larger = plan_what_ifs(Database::open_for_reading(file), request, source());
  EXPECT_EQ(larger.missing_count(), 2U) << "one more success, with both changes";
}

TEST_F(WhatIfTest, RowsDoNotDependOnWorkersNorOnStops) {
  const std::filesystem::path file = fly(picky_sweep({"wind", "tracking", "crash", "nothing"}, 1));
  const WhatIfRequest request{.changes = changes_of({"all", "nothing"}), .control = 1};
  std::vector<std::filesystem::path> copies;
  for (int i = 0; i < 3; ++i) {
    copies.push_back(folder_ / ("copy" + std::to_string(i) + ".db"));
    std::filesystem::copy_file(file, copies.back());
  }
  answered(copies[0], request, 1);
  answered(copies[1], request, 2);
  {
    // Stopped after every fifth flight, and begun again.
    std::size_t left = 1000, rounds = 0;
    while (left > 0) {
      Database database = Database::open_for_run(copies[2], metric_table());
      WhatIfPlan plan = plan_what_ifs(database, request, source());
      ASSERT_LT(plan.missing_count(), left) << "what was flown is there";
      left = plan.missing_count();
      std::atomic<bool> stop = false;
      FleetOptions options = fleet(2);
      options.stop = &stop;
      const WhatIfRun run =
          fly_what_ifs(plan, database, source(), options,
                       [&](std::size_t done, std::size_t) { stop = stop || done == 5; });
      EXPECT_EQ(run.is_stopped, plan.missing_count() > 0);
      ++rounds;
    }
    EXPECT_GT(rounds, 3U);
  }
  const std::vector<WhatIfRow> rows = Database::open_for_reading(copies[0]).read_what_ifs();
  EXPECT_EQ(rows.size(), 36U) << "nine changes of three failures and a success";
  EXPECT_EQ(Database::open_for_reading(copies[1]).read_what_ifs(), rows);
  EXPECT_EQ(Database::open_for_reading(copies[2]).read_what_ifs(), rows);
  // Trials are as they were.
  EXPECT_EQ(Database::open_for_reading(file).finished_trials(),
            Database::open_for_reading(copies[1]).finished_trials());
}

TEST_F(WhatIfTest, AnswersOfAnotherPlannersFileAreMissing) {
  const std::filesystem::path file = fly(picky_sweep({"latency"}, 1));
  const WhatIfRequest request{.changes = changes_of({"no_latency"})};
  const WhatIfPlan plan = answered(file, request);
  ASSERT_EQ(plan.flights.size(), 1U);
  Database database = Database::open_for_run(file, metric_table());
  EXPECT_EQ(plan_what_ifs(database, request, source()).missing_count(), 0U);
  WhatIfRow row = *plan.flights[0].row;
  row.planner_digest = "of another day";
  database.add_what_if(row);
  EXPECT_EQ(plan_what_ifs(database, request, source()).missing_count(), 1U);
}

TEST_F(WhatIfTest, OneTrialAlone) {
  const std::filesystem::path file = fly(picky_sweep({"latency", "nothing"}, 1));
  WhatIfRequest request{.changes = changes_of({"no_latency", "still_obstacles"})};
  {
    const Database database = Database::open_for_reading(file);
    for (const TrialListing& trial : database.list_trials()) {
      if (trial.outcome == Outcome::reached_goal) request.trial = trial.key;
    }
  }
  const WhatIfPlan plan = answered(file, request);
  ASSERT_EQ(plan.trials.size(), 1U);
  EXPECT_EQ(plan.trials[0].planner_label, "nothing");
  const Section section = what_if_section(plan, request, "");
  ASSERT_EQ(section.tables.size(), 1U);
  EXPECT_EQ(section.tables[0].rows.size(), 3U) << "as it was, and two changes";
}

/// A planner that sees nothing strikes one cylinder: the others go, whichever order they are in.
TEST_F(WhatIfTest, TheSmallestSceneIsTheObstacleThatWasStruck) {
  SweepSpec sweep = test::small_sweep();
  sweep.planners.resize(1);
  const Database database = Database::open_for_reading(fly(sweep));
  std::string key;
  for (const TrialListing& trial : database.list_trials()) {
    if (trial.outcome == Outcome::collided) key = trial.key;
  }
  ASSERT_NE(key, "");
  const SmallestScene scene = smallest_scene({.stored = read_stored_trial(database, key),
                                              .files = {},
                                              .folder = folder_,
                                              .fleet = fleet(2)});
  EXPECT_GT(scene.obstacles_before, 5U);
  EXPECT_EQ(scene.obstacles, 1U);
  EXPECT_EQ(scene.kinds, std::vector<std::string>{"cylinder"});
  EXPECT_TRUE(scene.is_minimal);
  EXPECT_EQ(scene.outcome, Outcome::collided) << scene.reason;
  EXPECT_GT(scene.flights, 3);
  EXPECT_TRUE(std::filesystem::exists(folder_ / kSceneMapFile));
}

TEST(WhatIfNames, AreSuggested) {
  try {
    changes_of({"no_wind", "true_deth"});
    FAIL() << "no such change";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean true_depth?"), std::string::npos);
    EXPECT_EQ(error.option(), "what-if");
  }
  EXPECT_EQ(changes_of({"no_wind", "nothing", "no_wind"}).size(), 2U);
  EXPECT_EQ(changes_of({"all"}).size(), changes().size() - 1);
}

}  // namespace
}  // namespace avoidbench
