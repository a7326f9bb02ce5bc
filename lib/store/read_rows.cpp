#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "base/input_error.hpp"
#include "store/database.hpp"
#include "store/record_format.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/trial_fields.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kMapColumns =
    "m.map_key, m.generator, m.map_seed, m.spec_json, m.world_digest, m.obstacle_count, "
    "m.triangle_count, m.traversability, m.traversability_normalized_ratio, m.relative_gap_size, "
    "m.obstacle_density_1pm2, m.free_volume_ratio";
constexpr std::string_view kMissionColumns =
    "i.map_key, i.mission_index, i.start_x_m, i.start_y_m, i.start_z_m, i.goal_x_m, i.goal_y_m, "
    "i.goal_z_m, i.start_yaw_rad, i.reference_length_m, i.traversability_obstruction, "
    "i.view_occlusion, i.angle_over_length_1pm, i.is_valid, i.invalid_reason";
constexpr std::string_view kPlannerColumns =
    "p.label, p.name, p.version, p.file_digest, p.parameters_json, p.is_privileged";

MapRow map_of(const Statement& s) {
  MapRow row;
  row.record.key = s.text(0);
  row.generator = s.text(1);
  row.map_seed = std::bit_cast<std::uint64_t>(s.integer(2));
  row.spec_json = s.text(3);
  row.record.world_digest = s.text(4);
  row.record.obstacle_count = s.integer(5);
  row.record.triangle_count = s.integer(6);
  row.record.traversability = s.real(7);
  row.record.traversability_normalized_ratio = s.real(8);
  row.record.relative_gap_size = s.real(9);
  row.record.obstacle_density_1pm2 = s.real(10);
  row.record.free_volume_ratio = s.real(11);
  return row;
}

MissionRecord mission_of(const Statement& s) {
  MissionRecord record;
  record.index = s.integer(1);
  record.mission.start_world = {s.real(2), s.real(3), s.real(4)};
  record.mission.goal_world = {s.real(5), s.real(6), s.real(7)};
  record.mission.start_yaw_rad = s.real(8);
  record.reference_length_m = s.real(9);
  record.difficulty = {.traversability_obstruction = s.real(10),
                       .view_occlusion = s.real(11),
                       .angle_over_length_1pm = s.real(12)};
  record.is_valid = s.integer(13) != 0;
  record.invalid_reason = s.text(14);
  return record;
}

PlannerRow planner_of(const Statement& s) {
  return {.label = s.text(0),
          .name = s.text(1),
          .version = s.text(2),
          .file_digest = s.text(3),
          .parameters_json = s.text(4),
          .is_privileged = s.integer(5) != 0};
}

Outcome outcome_of(const Database& db, const std::string& name) {
  const auto outcome = enum_from_text<Outcome>(name);
  if (!outcome) {
    throw InputError(
        InputProblem{.file = db.path().string(),
                     .message = "holds an outcome that this avoidbench does not know: " + name});
  }
  return *outcome;
}

/// `, t.a, t.b` for the metrics a and b.
std::string metric_columns(const Database& db) {
  std::string columns;
  for (const MetricRow& metric : db.metrics()) columns += ", t." + sql_name(metric.name);
  return columns;
}

std::vector<double> metrics_of(const Database& db, const Statement& s, int first_column) {
  std::vector<double> values;
  for (std::size_t i = 0; i < db.metrics().size(); ++i) {
    values.push_back(s.real(first_column + static_cast<int>(i)));
  }
  return values;
}

std::vector<Collision> read_collisions(const Database& db, std::string_view key) {
  Statement s(db.handle(), db.path(),
              "SELECT time_s, speed_mps, obstacle_index, obstacle_kind FROM events "
              "WHERE trial_key = ? AND kind = 'collision' ORDER BY event_index");
  s.bind_text(key);
  std::vector<Collision> collisions;
  while (s.step()) {
    collisions.push_back(
        {.time_s = s.real(0), .speed_mps = s.real(1), .obstacle = s.integer(2), .kind = s.text(3)});
  }
  return collisions;
}

void read_flight(const Database& db, std::string_view key, TrialRecord& record) {
  Statement s(db.handle(), db.path(),
              "SELECT r.samples, r.is_packed, r.sample_count, c.calls_json FROM trajectories r "
              "JOIN plan_calls c USING (trial_key) "
              "WHERE trial_key = ?");
  s.bind_text(key);
  if (s.step()) {
    const auto count = static_cast<std::size_t>(std::max<std::int64_t>(0, s.integer(2)));
    const auto bytes = s.integer(1) != 0
                           ? unpacked_samples(s.blob(0), count)
                           : std::vector<std::byte>(s.blob(0).begin(), s.blob(0).end());
    if (bytes.size() != count * kSampleDoubles * sizeof(double)) {
      throw InputError(InputProblem{
          .file = db.path().string(),
          .message = "damaged (trajectory of trial " + std::string(key.substr(0, 12)) + ")"});
    }
    record.samples = samples_from_bytes(bytes);
    record.plan_calls = plan_calls_from_json(s.text(3));
  }
  record.collisions = read_collisions(db, key);
}

/// NaN where the map lacks the mission.
double reference_length_m(const MapRow& map, std::int64_t mission_index) {
  const std::vector<MissionRecord>& missions = map.record.missions;  // by index
  const auto found = std::lower_bound(
      missions.begin(), missions.end(), mission_index,
      [](const MissionRecord& mission, std::int64_t index) { return mission.index < index; });
  if (found == missions.end() || found->index != mission_index) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return found->reference_length_m;
}

std::vector<PlannerRow> planners_of(const Database& db, const std::set<std::string>& keys) {
  Statement s(db.handle(), db.path(),
              "SELECT " + std::string(kPlannerColumns) +
                  ", p.planner_key FROM planners p ORDER BY p.label, p.planner_key");
  std::vector<PlannerRow> planners;
  while (s.step()) {
    if (keys.contains(s.text(6))) planners.push_back(planner_of(s));
  }
  return planners;
}

std::vector<std::string> versions_of(const Database& db, const std::set<std::int64_t>& runs) {
  Statement s(db.handle(), db.path(),
              "SELECT run_id, program_version || ' ' || git_hash FROM runs");
  std::set<std::string> versions;
  while (s.step()) {
    if (runs.contains(s.integer(0))) versions.insert(s.text(1));
  }
  return {versions.begin(), versions.end()};
}

/// By the sweep's latency.mode or the axis of it.
bool has_measured_latency(const Database& db, std::string_view name, std::int64_t revision) {
  Statement s(db.handle(), db.path(),
              "SELECT EXISTS (SELECT 1 FROM sweeps s WHERE s.sweep = ? AND s.revision = ? AND ("
              "json_extract(s.spec_json, '$.base.latency.mode') IN ('measured', 'replay') OR "
              "EXISTS (SELECT 1 FROM json_each(s.spec_json, '$.axes') a, "
              "json_each(a.value, '$.values') v WHERE json_extract(a.value, '$.path') = "
              "'latency.mode' AND v.value IN ('measured', 'replay'))))");
  s.bind_text(name).bind_integer(revision).step();
  return s.integer(0) != 0;
}

}  // namespace

std::map<std::string, Outcome> Database::finished_trials() const {
  std::map<std::string, Outcome> trials;
  Statement s(handle(), path(), "SELECT trial_key, outcome FROM trials");
  while (s.step()) trials.emplace(s.text(0), outcome_of(*this, s.text(1)));
  return trials;
}

std::set<std::string> Database::finished_keys() const {
  std::set<std::string> keys;
  Statement s(handle(), path(), "SELECT trial_key FROM trials ORDER BY trial_key");
  while (s.step()) keys.insert(keys.end(), s.text(0));  // in order: each at the end
  return keys;
}

std::optional<MapRow> Database::read_map(std::string_view key) const {
  Statement s(handle(), path(),
              "SELECT " + std::string(kMapColumns) + " FROM maps m WHERE m.map_key = ?");
  s.bind_text(key);
  if (!s.step()) return std::nullopt;
  MapRow row = map_of(s);
  Statement missions(handle(), path(),
                     "SELECT " + std::string(kMissionColumns) +
                         " FROM missions i WHERE i.map_key = ? ORDER BY i.mission_index");
  missions.bind_text(key);
  while (missions.step()) row.record.missions.push_back(mission_of(missions));
  return row;
}

std::optional<TrialRow> Database::read_trial(std::string_view key) const {
  Statement s(handle(), path(),
              "SELECT t.trial_key, (SELECT min(sweep) FROM sweep_trials x WHERE x.trial_key = "
              "t.trial_key), t.map_key, p.label, p.file_digest, t.mission_index, t.spec_json, "
              "t.outcome, t.reason, t.end_time_s, t.wall_time_s" +
                  metric_columns(*this) +
                  " FROM trials t JOIN planners p USING (planner_key) WHERE t.trial_key = ?");
  s.bind_text(key);
  if (!s.step()) return std::nullopt;
  TrialRow row;
  row.key = s.text(0);
  row.sweep = s.text(1);
  row.map_key = s.text(2);
  row.planner_label = s.text(3);
  row.planner_file_digest = s.text(4);
  row.mission_index = s.integer(5);
  row.spec_json = s.text(6);
  row.record.outcome = outcome_of(*this, s.text(7));
  row.record.reason = s.text(8);
  row.record.end_time_s = s.real(9);
  row.wall_time_s = s.real(10);
  row.metrics = metrics_of(*this, s, 11);
  read_flight(*this, key, row.record);
  return row;
}

std::vector<TrialListing> Database::list_trials() const {
  Statement s(handle(), path(),
              "SELECT t.rowid, t.trial_key, p.label, m.generator, m.map_seed, "
              "json_extract(m.spec_json, '$.poisson_radius_m'), t.mission_index, t.outcome, "
              "t.reason, t.end_time_s FROM trials t JOIN planners p USING (planner_key) "
              "JOIN maps m USING (map_key) ORDER BY t.rowid");
  std::vector<TrialListing> trials;
  while (s.step()) {
    trials.push_back({.id = s.integer(0),
                      .key = s.text(1),
                      .planner_label = s.text(2),
                      .generator = s.text(3),
                      .map_seed = std::bit_cast<std::uint64_t>(s.integer(4)),
                      .poisson_radius_m = s.real(5),
                      .mission_index = s.integer(6),
                      .outcome = outcome_of(*this, s.text(7)),
                      .reason = s.text(8),
                      .end_time_s = s.real(9)});
  }
  return trials;
}

std::map<std::string, TrialCost> Database::mean_costs() const {
  constexpr double kRowBytes = 6000.0;  // of a trial's spec and metrics
  Statement s(handle(), path(),
              "SELECT p.label, coalesce(avg(t.wall_time_s), 0), avg(coalesce(length(r.samples), 0) "
              "+ coalesce(length(c.calls_json), 0)) FROM trials t JOIN planners p USING "
              "(planner_key) LEFT JOIN trajectories r USING (trial_key) LEFT JOIN plan_calls c "
              "USING (trial_key) GROUP BY p.label");
  std::map<std::string, TrialCost> costs;
  while (s.step()) costs[s.text(0)] = {.wall_time_s = s.real(1), .bytes = s.real(2) + kRowBytes};
  return costs;
}

std::vector<PlannerRow> Database::read_planners() const {
  Statement s(handle(), path(),
              "SELECT " + std::string(kPlannerColumns) +
                  " FROM planners p ORDER BY p.label, p.planner_key");
  std::vector<PlannerRow> planners;
  while (s.step()) planners.push_back(planner_of(s));
  return planners;
}

std::vector<SweepInfo> Database::read_sweeps() const {
  Statement s(
      handle(), path(),
      "SELECT s.sweep, s.revision, s.spec_json, (SELECT count(*) FROM sweep_trials t WHERE "
      "t.sweep = s.sweep AND t.revision = s.revision) FROM sweeps s ORDER BY s.sweep, s.revision");
  std::vector<SweepInfo> sweeps;
  while (s.step()) {
    sweeps.push_back({.name = s.text(0),
                      .revision = s.integer(1),
                      .spec_json = s.text(2),
                      .trial_count = s.integer(3)});
  }
  return sweeps;
}

SweepResult Database::read_sweep(std::string_view name, std::int64_t revision,
                                 const std::vector<std::string>& fields) const {
  SweepResult result{.name = std::string(name),
                     .revision = revision,
                     .metrics = metrics_,
                     .planners = {},
                     .maps = {},
                     .trials = {},
                     .program_versions = {},
                     .spec_json = {},
                     .fields = fields,
                     .has_measured_latency = false};
  const auto query = [&](std::string_view sql) {
    auto statement = std::make_unique<Statement>(handle(), path(), sql);
    statement->bind_text(name).bind_integer(revision);
    return statement;
  };
  const std::string of_sweep = " WHERE s.sweep = ? AND s.revision = ? ";

  auto spec = query("SELECT s.spec_json FROM sweeps s" + of_sweep);
  if (spec->step()) result.spec_json = spec->text(0);

  auto maps =
      query("SELECT DISTINCT " + std::string(kMapColumns) +
            " FROM sweep_missions s JOIN maps m USING (map_key)" + of_sweep + "ORDER BY m.map_key");
  std::map<std::string, std::size_t> map_indices;
  while (maps->step()) {
    result.maps.push_back(map_of(*maps));
    map_indices.emplace(result.maps.back().record.key, result.maps.size() - 1);
  }
  auto missions = query("SELECT " + std::string(kMissionColumns) +
                        " FROM sweep_missions s JOIN missions i USING (map_key, mission_index)" +
                        of_sweep + "ORDER BY i.map_key, i.mission_index");
  while (missions->step()) {
    result.maps[map_indices.at(missions->text(0))].record.missions.push_back(mission_of(*missions));
  }

  // Once over the trials, which are most of the file; what they refer to is few and looked up here,
  // unless a field asks for it.
  const std::string_view tables =
      fields.empty() ? " FROM sweep_trials s JOIN trials t USING (trial_key)" : kTrialTables;
  auto trials = query(
      "SELECT t.trial_key, t.planner_key, t.map_key, t.mission_index, t.outcome, t.run_id, "
      "t.end_time_s" +
      metric_columns(*this) + field_columns(*this, fields) + std::string(tables) + of_sweep +
      "ORDER BY s.trial_key");
  const int first_field = 7 + static_cast<int>(metrics_.size());
  std::set<std::string> planner_keys;
  std::set<std::int64_t> runs;
  while (trials->step()) {
    TrialSummary trial{.key = trials->text(0),
                       .planner_key = trials->text(1),
                       .map_key = trials->text(2),
                       .mission_index = trials->integer(3),
                       .outcome = outcome_of(*this, trials->text(4)),
                       .reference_length_m = 0.0,
                       .end_time_s = trials->real(6),
                       .metrics = metrics_of(*this, *trials, 7)};
    const auto map = map_indices.find(trial.map_key);
    if (map == map_indices.end()) continue;
    trial.reference_length_m = reference_length_m(result.maps[map->second], trial.mission_index);
    if (!planner_keys.contains(trial.planner_key)) planner_keys.insert(trial.planner_key);
    runs.insert(trials->integer(5));
    for (std::size_t i = 0; i < fields.size(); ++i) {
      trial.fields.push_back(trials->value(first_field + static_cast<int>(i)));
    }
    result.trials.push_back(std::move(trial));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) refuse_empty_field(*this, result, i);
  result.planners = planners_of(*this, planner_keys);
  result.program_versions = versions_of(*this, runs);
  result.has_measured_latency = has_measured_latency(*this, name, revision);
  return result;
}

}  // namespace avoidbench
