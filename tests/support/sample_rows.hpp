#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "base/digest.hpp"
#include "store/database.hpp"
#include "support/temporary_folder.hpp"

/// Rows made by hand for tests of the database and of reports.
namespace avoidbench::sample_rows {

inline double no_value(const MetricInput&) { return 0.0; }

inline constexpr MetricDef kMetrics[] = {
    {"path_optimality_pct", 1, "%", "Excess of the flown path.", "(L - d_min) / d_min", "eq. (4)",
     Better::less, Population::finished, false, no_value},
    {"mission_progress_pct", 1, "%", "Progress toward the goal.", "eq. (7)", "eq. (7)",
     Better::more, Population::all, false, no_value},
    {"processing_time_ms", 2, "ms", "Mean time of a plan call.", "mean", "host", Better::less,
     Population::all, true, no_value}};

using test::TemporaryFolder;

inline std::string key_of(const std::string& name) { return Digest().add(name).hex(); }

inline RunRow run_row() {
  return {.started_at = "2024-02-03T04:05:06Z",
          .program_version = "0.1.0",
          .git_hash = "abcdef",
          .compiler = "g++ 12.2",
          .flags = "-O2",
          .host = "bench",
          .cpu = "a processor",
          .isa = "sse2",
          .command_line = "avoidbench run forest.yaml",
          .shard = {}};
}

inline SweepRow sweep_row(const std::string& spec_json = R"({"trials":2})") {
  return {.name = "forest", .spec_json = spec_json};
}

inline PlannerRow planner_row(const std::string& label) {
  return {.label = label,
          .name = "A planner",
          .version = "1.2",
          .file_digest = key_of("so " + label),
          .parameters_json = R"({"horizon_m":5.0})",
          .is_privileged = false};
}

/// Map `index` with `mission_count` missions, of which the last is invalid where `has_invalid`.
inline MapRow map_row(int index, int mission_count, bool has_invalid = false) {
  MapRow row;
  row.record.key = key_of("map " + std::to_string(index));
  row.record.world_digest = key_of("world " + std::to_string(index));
  row.record.obstacle_count = 10 + index;
  row.record.triangle_count = 5000 + index;
  row.record.traversability = 20.0 + index;
  row.record.traversability_normalized_ratio = 0.3 + 0.05 * index;
  row.record.relative_gap_size = std::numeric_limits<double>::quiet_NaN();
  row.record.obstacle_density_1pm2 = 0.1;
  row.record.free_volume_ratio = 0.95;
  row.generator = "forest";
  row.spec_json =
      R"({"generator":"forest","poisson_radius_m":)" + std::to_string(2.5 + 0.5 * index) + "}";
  row.map_seed = std::numeric_limits<std::uint64_t>::max() - static_cast<std::uint64_t>(index);
  for (int i = 0; i < mission_count; ++i) {
    MissionRecord mission;
    mission.index = i;
    mission.mission.start_world = {0.5, -20.25 + i, 2.0};
    mission.mission.goal_world = {1.0 / 3.0, 20.0, 2.0};
    mission.mission.start_yaw_rad = 1.5;
    mission.reference_length_m = 40.0 + i;
    mission.difficulty = {1.5, 0.25 * i, 0.125};
    if (has_invalid && i == mission_count - 1) {
      mission.is_valid = false;
      mission.invalid_reason = "the goal can't be reached";
      mission.reference_length_m = std::numeric_limits<double>::quiet_NaN();
      mission.difficulty = {};
    }
    row.record.missions.push_back(mission);
  }
  return row;
}

inline Sample sample(int i) {
  Sample s;
  s.time_s = 0.01 * i;
  s.position_world = {0.1 * i, 1.0 / 3.0, 2.0};
  s.velocity_world = {1.0, 2.0, 3.0 + i};
  s.acceleration_world = {4.0, 5.0, 6.0};
  s.q_world_body = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  s.rates_body_radps = {7.0, 8.0, 9.0};
  s.reference_world = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  s.clearance_m = std::numeric_limits<double>::infinity();
  s.rotor_power_w = 100.0 + i;
  return s;
}

/// The trial of this planner on mission `mission` of map `map`.
inline TrialRow trial_row(const std::string& label, int map, int mission, Outcome outcome) {
  TrialRow row;
  row.key = key_of(label + " " + std::to_string(map) + " " + std::to_string(mission));
  row.sweep = "forest";
  row.map_key = key_of("map " + std::to_string(map));
  row.planner_label = label;
  row.planner_file_digest = planner_row(label).file_digest;
  row.mission_index = mission;
  row.spec_json = R"({"seed":1})";
  row.record.outcome = outcome;
  row.record.reason = outcome == Outcome::reached_goal ? "" : "touched a \"tree\"\n\tat x = 5 m";
  row.record.end_time_s = 12.5 + mission;
  for (int i = 0; i < 20; ++i) row.record.samples.push_back(sample(i + mission));
  for (int i = 0; i < 5; ++i) {
    row.record.plan_calls.push_back({.time_s = i / 30.0,
                                     .cpu_time_s = 0.001 * (i + 1) / 3.0,
                                     .wall_time_s = 0.0011,
                                     .status = i == 2 ? 1 : 0,
                                     .command_kind = 8});
  }
  if (outcome == Outcome::collided) {
    row.record.collisions.push_back(
        {.time_s = 12.5, .speed_mps = 2.25, .obstacle = 7, .kind = "tree"});
  }
  const bool finished = outcome == Outcome::reached_goal;
  row.metrics = {finished ? 4.0 + mission : std::numeric_limits<double>::quiet_NaN(),
                 finished ? 100.0 : 40.0, 3.5};
  return row;
}

/// A database with run, sweep, planners a and b, and `map_count` maps of 2 missions; no trials.
inline Database begun(const std::filesystem::path& path, int map_count = 2) {
  Database db = Database::open_for_run(path, kMetrics);
  db.add_run(run_row());
  db.add_sweep(sweep_row());
  db.add_planner(planner_row("a"));
  db.add_planner(planner_row("b"));
  for (int i = 0; i < map_count; ++i) db.add_map(map_row(i, 2), "forest");
  return db;
}

inline TrialRow finished() { return trial_row("a", 0, 0, Outcome::reached_goal); }
inline TrialRow collided() { return trial_row("a", 0, 1, Outcome::collided); }

/// Names of the files in the folder.
inline std::set<std::string> files_in(const TemporaryFolder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

}  // namespace avoidbench::sample_rows
