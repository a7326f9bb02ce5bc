#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "config/sweep_file.hpp"
#include "metrics/metric_table.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/schedule.hpp"
#include "sweep/sweep_rows.hpp"
#include "worker/worker.hpp"

/// Fills a database as if a large sweep had been flown: every trial has its own key and spec, and
/// the map and record of one real flight a planner. tests/bench/large_sweep.py measures with it.
namespace avoidbench {
namespace {

/// A map and a mission that are flown, and what came of it for each planner.
struct Sample {
  MapRecord map;
  std::map<std::string, JobResult> flights;  // by label
};

Sample fly(const SweepSpec& sweep, const std::vector<PlannedTrial>& trials) {
  Worker worker;
  Sample sample;
  sample.map =
      *worker.work({.spec = trials.front().spec(), .mission_count = sweep.trials, .mission = {}})
           .map;
  for (const MissionRecord& mission : sample.map.missions) {
    if (!mission.is_valid) continue;
    for (std::size_t i = 0; i < sweep.planners.size(); ++i) {
      sample.flights[trials[i].planner_label()] =
          worker.work({.spec = trials[i].spec(), .mission_count = 0, .mission = mission});
    }
    return sample;
  }
  throw InputError("the first map of the sweep has no mission that can be flown");
}

void add_maps(const SweepSpec& sweep, const Schedule& schedule, const MapRecord& flown,
              Database& database) {
  for (const MapPlan& plan : schedule.maps) {
    MapRecord record = flown;
    record.key = plan.key;
    for (MissionRecord& mission : record.missions) mission.is_valid = true;
    database.add_map({.record = record,
                      .generator = std::string(kind(plan.spec.map)),
                      .spec_json = spec_to_json(plan.spec.map).dump(),
                      .map_seed = plan.spec.map_seed},
                     sweep.name);
  }
}

void fill(const std::string& sweep_file, const std::string& file, bool has_samples) {
  const SweepSpec sweep = read_sweep(sweep_file);
  const std::vector<PlannedTrial> trials = expand(sweep);
  const std::string spec_json = sweep_json(sweep, trials);
  const Sample sample = fly(sweep, trials);
  const Schedule schedule = make_schedule(trials, {});
  Database database = Database::open_for_run(file, metric_table());
  database.add_sweep({.name = sweep.name, .spec_json = spec_json});
  for (const PlannerChoice& planner : sweep.planners) database.add_planner(planner_row(planner));
  RunRow run;
  run.started_at = "2024-01-01T00:00:00Z";
  database.add_run(run);
  add_maps(sweep, schedule, sample.map, database);
  std::clock_t writing = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialSpec spec = trials[i].spec();
    const JobResult& flight = sample.flights.at(spec.planner.label);
    TrialRow row{.key = schedule.keys[i],
                 .sweep = sweep.name,
                 .map_key = schedule.maps[schedule.map_of[i]].key,
                 .planner_label = spec.planner.label,
                 .planner_file_digest = spec.planner.file_digest,
                 .mission_index = spec.mission_index,
                 .spec_json = trial_json(spec),
                 .record = *flight.trial,
                 .metrics = flight.metrics,
                 .wall_time_s = flight.wall_time_s};
    // Some fail, and no two have one value.
    if (i % 7 == 3) row.record.outcome = Outcome::collided;
    for (double& value : row.metrics) value *= 1.0 + 1e-4 * static_cast<double>(i % 1009);
    if (!has_samples) row.record.samples.clear();
    if (!has_samples) row.record.plan_calls.clear();
    const std::clock_t before = std::clock();
    database.add_trial(row);
    writing += std::clock() - before;
  }
  const double writing_ms = 1e3 * static_cast<double>(writing) / CLOCKS_PER_SEC;
  std::printf("%zu trials on %zu maps in %s, %.3f ms CPU to write one\n", trials.size(),
              schedule.maps.size(), file.c_str(), writing_ms / static_cast<double>(trials.size()));
}

}  // namespace
}  // namespace avoidbench

int main(int count, char** words) {
  if (count < 3) {
    std::fprintf(stderr, "usage: %s SWEEP.yaml NEW.db [--no-trajectories]\n", words[0]);
    return 2;
  }
  try {
    avoidbench::fill(words[1], words[2], count == 3);
  } catch (const avoidbench::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
