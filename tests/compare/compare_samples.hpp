#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include "base/math.hpp"
#include "base/random.hpp"
#include "compare/compare.hpp"

/// Tables of trials made by hand for tests of comparisons.
namespace avoidbench::compare_samples {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

inline MetricRow metric_row(std::string name, std::string unit, Better better,
                            Population population, bool is_measured = false) {
  return {.name = std::move(name),
          .version = 1,
          .unit = std::move(unit),
          .doc = {},
          .formula = {},
          .source = {},
          .better = better,
          .population = population,
          .is_measured = is_measured};
}

/// Metrics as the program has them: some of all trials, some of finished ones, one measured, one
/// without direction.
inline TrialTable empty_table(std::string source) {
  TrialTable table{
      .source = std::move(source), .sweep = "forest", .axes = {}, .metrics = {}, .trials = {}};
  table.metrics = {
      metric_row("path_optimality_pct", "%", Better::less, Population::finished),
      metric_row("average_goal_velocity_mps", "m/s", Better::more, Population::finished),
      metric_row("mission_progress_pct", "%", Better::more, Population::all),
      metric_row("min_clearance_m", "m", Better::more, Population::all),
      metric_row("rotor_energy_j", "J", Better::less, Population::all),
      metric_row("collision_count", "", Better::less, Population::all),
      metric_row("path_length_m", "m", Better::neither, Population::all),
      metric_row("processing_time_ms", "ms", Better::less, Population::all, true)};
  return table;
}

/// Mission `mission` of map `map`, with the values of a smooth flight or of a crash half way.
inline TableTrial trial(const std::string& planner, int map, int mission, bool is_finished) {
  TableTrial row;
  row.identity = {.planner = planner,
                  .generator = "hall",
                  .map_seed = static_cast<std::uint64_t>(map),
                  .setting = {},
                  .mission_index = mission};
  row.map = static_cast<std::uint64_t>(map) + 1;
  row.mission = static_cast<std::uint64_t>(1000 * map + mission) + 1;
  row.flight = row.mission;
  row.outcome = is_finished ? Outcome::reached_goal : Outcome::collided;
  row.metrics = is_finished ? std::vector<double>{5.0, 2.0, 100.0, 0.5, 300.0, 0.0, 15.0, 1.5}
                            : std::vector<double>{kNone, kNone, 40.0, 0.0, 120.0, 1.0, 6.0, 0.5};
  return row;
}

inline void sort(TrialTable& table) {
  std::sort(table.trials.begin(), table.trials.end(),
            [](const TableTrial& a, const TableTrial& b) { return a.identity < b.identity; });
}

/// Trials of `planner`, all finished.
inline TrialTable finished_table(std::string source, int map_count, int mission_count,
                                 const std::string& planner = "ego") {
  TrialTable table = empty_table(std::move(source));
  for (int map = 0; map < map_count; ++map) {
    for (int mission = 0; mission < mission_count; ++mission) {
      table.trials.push_back(trial(planner, map, mission, true));
    }
  }
  return table;
}

/// How a synthetic planner fares on each mission: its chance of success and its usual values.
struct MissionNature {
  double success_chance = 0.0, path_optimality_pct = 0.0, velocity_mps = 0.0, clearance_m = 0.0;
};

/// Natures of missions on maps that differ: easy maps, hard maps, and missions around them.
inline std::vector<MissionNature> mission_natures(int map_count, int mission_count,
                                                  std::uint64_t seed) {
  RandomStream random = stream(seed, "natures");
  std::vector<MissionNature> natures;
  for (int map = 0; map < map_count; ++map) {
    const double of_map = random.normal();
    for (int mission = 0; mission < mission_count; ++mission) {
      const double of_mission = random.normal();
      const double ease = 2.0 + of_map + of_mission;
      natures.push_back({.success_chance = 1.0 / (1.0 + math::exp(-ease)),
                         .path_optimality_pct = 5.0 * math::exp(-0.3 * ease),
                         .velocity_mps = 2.0 + 0.1 * ease,
                         .clearance_m = 0.5 + 0.05 * ease});
    }
  }
  return natures;
}

/// One run: every mission flown once, with luck of this seed.
inline TrialTable flown_table(std::string source, const std::vector<MissionNature>& natures,
                              int mission_count, std::uint64_t seed) {
  RandomStream random = stream(seed, "flights");
  TrialTable table = empty_table(std::move(source));
  for (std::size_t i = 0; i < natures.size(); ++i) {
    const auto index = static_cast<int>(i);
    const bool is_finished = random.uniform() < natures[i].success_chance;
    TableTrial row = trial("ego", index / mission_count, index % mission_count, is_finished);
    const double longer = random.normal(), faster = random.normal(), nearer = random.normal();
    if (is_finished) {
      row.metrics[0] = natures[i].path_optimality_pct * math::exp(0.4 * longer);
      row.metrics[1] = natures[i].velocity_mps + 0.1 * faster;
    }
    row.metrics[3] = is_finished ? std::max(0.01, natures[i].clearance_m + 0.1 * nearer) : 0.0;
    table.trials.push_back(std::move(row));
  }
  return table;
}

inline void crash(TableTrial& row) {
  row = trial(row.identity.planner, static_cast<int>(row.identity.map_seed),
              static_cast<int>(row.identity.mission_index), false);
}

inline const MetricComparison& row_of(const Comparison& comparison, std::string_view metric) {
  return *std::find_if(comparison.rows.begin(), comparison.rows.end(),
                       [&](const MetricComparison& row) { return row.metric == metric; });
}

}  // namespace avoidbench::compare_samples
