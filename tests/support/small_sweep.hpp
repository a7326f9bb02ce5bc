#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "metrics/metric_table.hpp"
#include "support/canonical_rows.hpp"
#include "support/planner_files.hpp"
#include "sweep/run_sweep.hpp"

namespace avoidbench::test {

/// Two small halls, two missions each, one blind planner and one that sees.
inline SweepSpec small_sweep() {
  SweepSpec sweep;
  sweep.name = "small";
  sweep.base.map = HallSpec{.area_m = {10, 14}, .poisson_radius_m = 3.0};
  sweep.base.mission.time_limit_s = 20.0;
  sweep.base.sensor.width_px = 80;
  sweep.base.sensor.height_px = 60;
  sweep.axes = {{.path = "map_seed", .values = {1, 2}}};
  sweep.trials = 2;
  sweep.planners = {preset_choice("straight_line"), preset_choice("reactive")};
  return sweep;
}

/// Runs sweeps into databases in a folder of its own, removed afterwards.
class SweepTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() /
        (std::string("sweep_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    options_.worker_command = {std::string(AVOIDBENCH_BINARY_DIR) + "/avoidbench",
                               "worker",
                               "--plan-timeout",
                               "3",
                               "--memory-limit",
                               "800"};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  RunSummary run(const SweepSpec& sweep, const std::string& file, int jobs,
                 bool in_process = false) {
    Database database = Database::open_for_run(folder_ / file, metric_table());
    options_.jobs = jobs;
    options_.in_process = in_process;
    const RunSummary summary = run_sweep(sweep, {}, database, options_);
    rows_ = canonical_rows(database);
    return summary;
  }

  std::filesystem::path folder_;
  RunOptions options_;
  std::string rows_;  ///< of the last run
};

}  // namespace avoidbench::test
