#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "store/database.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/stored_text.hpp"
#include "store/trial_fields.hpp"
#include "store/trial_table.hpp"

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
/// Throws that the row is damaged where `parse` does not take its JSON.
template <class Parse>
void check_json(const Statement& s, const std::string& text, Parse parse) {
  try {
    parse(text);
  } catch (const BadText& bad) {
    s.damaged(std::string("its JSON is ") + bad.what());
  }
}

/// Of a row of kMapColumns, and below of kMissionColumns: their order is that of the numbers here.
MapRow map_of(const Statement& s) {
  MapRow row;
  row.record.key = s.text(0);
  row.generator = s.text(1);
  // The same 64 bits: SQLite knows signed numbers only.
  row.map_seed = std::bit_cast<std::uint64_t>(s.integer(2));
  row.spec_json = s.text(3);
  check_json(s, row.spec_json, stored_object);
  row.record.world_digest = s.text(4);
  row.record.obstacle_count = s.integer(5);
  row.record.triangle_count = s.integer(6);
  row.record.traversability = s.real(7);
  row.record.traversability_normalized_ratio = s.real(8);
  row.record.relative_gap_size = s.real(9);
  row.record.obstacle_density_1pm2 = s.real(10);
  row.record.free_volume_ratio = s.real(11);
  const bool is_possible = row.record.obstacle_count >= 0 && row.record.triangle_count >= 0;
  if (!is_possible) s.damaged("a count is negative");
  return row;
}

/// Whether a mission's numbers are what the program stores: finite, and there where it is valid.
bool is_possible(const MissionRecord& record) {
  constexpr std::int64_t kMostMissions = 1'000'000'000;
  const Mission& mission = record.mission;
  const double numbers[] = {mission.start_world.x(), mission.start_world.y(),
                            mission.start_world.z(), mission.goal_world.x(),
                            mission.goal_world.y(),  mission.goal_world.z(),
                            mission.start_yaw_rad,   record.reference_length_m};
  for (const double number : numbers) {
    if (std::isinf(number) || (record.is_valid && std::isnan(number))) return false;
  }
  // NaN has passed: an invalid mission has no length.
  const bool has_length = !(record.reference_length_m < 0.0);
  return has_length && record.index >= 0 && record.index < kMostMissions;
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
  record.invalid_reason = s.free_text(14);
  if (!is_possible(record)) {
    s.damaged("mission " + std::to_string(record.index) + " has impossible numbers");
  }
  return record;
}

/// The legs of a map's missions, which are in the order of their indices.
void read_legs(const Database& db, MapRecord& map) {
  Statement s(db.handle(), db.path(),
              "SELECT map_key, mission_index, leg_index, goal_x_m, goal_y_m, goal_z_m, "
              "reference_length_m FROM mission_legs WHERE map_key = ? ORDER BY mission_index, "
              "leg_index");
  s.rows_of("mission_legs").bind_text(map.key);
  auto mission = map.missions.begin();
  std::vector<Eigen::Vector3d> goals;
  // A mission's goals are complete where the next one's begin.
  const auto finish = [&] {
    if (goals.empty()) return;
    const bool is_there = mission != map.missions.end() && goals.size() > 1 &&
                          goals.back() == mission->mission.goal_world;
    if (!is_there) {
      throw_damaged(db.path(), "mission_legs", map.key,
                    "their mission is not there or has another last goal");
    }
    goals.pop_back();
    mission->mission.waypoints_world = std::exchange(goals, {});
    if (!mission->is_valid) mission->leg_lengths_m.clear();
  };
  while (s.step()) {
    const std::int64_t index = s.integer(1);
    if (mission == map.missions.end() || mission->index != index) {
      finish();
      mission = std::find_if(map.missions.begin(), map.missions.end(),
                             [&](const MissionRecord& other) { return other.index == index; });
      // Sweeps read the missions that they ask for.
      if (mission == map.missions.end()) continue;
    }
    if (s.integer(2) != static_cast<std::int64_t>(goals.size())) {
      s.damaged("a leg before this one is missing");
    }
    goals.emplace_back(s.real(3), s.real(4), s.real(5));
    mission->leg_lengths_m.push_back(s.real(6));
    const bool is_possible = goals.back().allFinite() &&
                             (!mission->is_valid || (std::isfinite(mission->leg_lengths_m.back()) &&
                                                     mission->leg_lengths_m.back() >= 0.0));
    if (!is_possible) s.damaged("it has impossible numbers");
  }
  finish();
}

PlannerRow planner_of(const Statement& s) {
  PlannerRow row{.label = s.text(0),
                 .name = s.text(1),
                 .version = s.text(2),
                 .file_digest = s.text(3),
                 .parameters_json = s.text(4),
                 .is_privileged = s.integer(5) != 0};
  check_json(s, row.parameters_json, stored_object);
  // A planner's row is checked by its own key.
  if (planner_key(row) != s.text(6))
    s.damaged("planner_key is not the digest of the other columns");
  return row;
}

/// All planners, by label, then key.
std::vector<PlannerRow> planner_rows(const Database& db) {
  Statement s(db.handle(), db.path(),
              "SELECT p.label, p.name, p.version, p.file_digest, p.parameters_json, "
              "p.is_privileged, p.planner_key FROM planners p ORDER BY p.label, p.planner_key");
  s.rows_of("planners", 6);
  std::vector<PlannerRow> planners;
  while (s.step()) planners.push_back(planner_of(s));
  return planners;
}

/// The mission's; nothing where the map lacks it.
std::optional<double> reference_length_m(const MapRow& map, std::int64_t mission_index) {
  const std::vector<MissionRecord>& missions = map.record.missions;  // by index
  const auto found = std::lower_bound(
      missions.begin(), missions.end(), mission_index,
      [](const MissionRecord& mission, std::int64_t index) { return mission.index < index; });
  if (found == missions.end() || found->index != mission_index) return std::nullopt;
  return found->reference_length_m;
}

/// Of these keys, by label; each must be there.
std::vector<PlannerRow> planners_of(const Database& db, std::set<std::string> keys) {
  std::vector<PlannerRow> planners = planner_rows(db);
  // erase() takes each wanted key out of the set: what is left in it was not found.
  std::erase_if(planners,
                [&](const PlannerRow& planner) { return keys.erase(planner_key(planner)) == 0; });
  if (!keys.empty()) {
    throw_damaged(db.path(), "planners", *keys.begin(), "it is not there, but has trials");
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

/// Of a row of key, planner, map, mission, outcome, run, end and metrics.
TrialSummary summary_of(const Database& db, const Statement& row) {
  TrialSummary trial{.key = row.text(0),
                     .planner_key = row.text(1),
                     .map_key = row.text(2),
                     .mission_index = row.integer(3),
                     .outcome = outcome_of(row, 4),
                     .reference_length_m = 0.0,
                     .end_time_s = row.real(6),
                     .metrics = metrics_of(db, row, 7)};
  const double end_s = trial.end_time_s;
  // A worker that died has no end of its flight; whoever arrived has.
  const bool must_have_end = trial.outcome == Outcome::reached_goal;
  if (std::isinf(end_s) || end_s < 0.0 || (must_have_end && std::isnan(end_s))) {
    row.damaged("end_time_s is not a time");
  }
  return trial;
}

/// What listings() reads, with these fields behind it, up to what follows the joins.
std::string listing_query(const Database& db, const std::vector<std::string>& fields) {
  // The row's number is the id that users type.
  return "SELECT t.rowid, t.trial_key, p.label, m.generator, m.map_seed, "
         "t.mission_index, t.outcome, t.reason, t.end_time_s, i.start_x_m, i.start_y_m, "
         "i.start_z_m, i.goal_x_m, i.goal_y_m, i.goal_z_m, "
         "t.map_key, p.file_digest = ''" +
         field_columns(db, fields) +
         " FROM trials t JOIN planners p USING (planner_key) JOIN maps m ON m.map_key = t.map_key "
         "JOIN missions i ON i.map_key = t.map_key AND i.mission_index = t.mission_index JOIN runs "
         "r USING (run_id)";
}

/// The rows of listing_query(). `axes`: what the file's sweeps vary.
std::vector<TrialListing> listings(Statement& s, const std::vector<std::string>& fields,
                                   const std::vector<std::string>& axes) {
  constexpr int kFirstField = 17;
  s.rows_of("trials", 1);
  std::vector<TrialListing> trials;
  while (s.step()) {
    trials.push_back({.id = s.integer(0),
                      .key = s.text(1),
                      .planner_label = s.text(2),
                      .generator = s.text(3),
                      .map_seed = std::bit_cast<std::uint64_t>(s.integer(4)),
                      .mission_index = s.integer(5),
                      .outcome = outcome_of(s, 6),
                      .reason = s.free_text(7),
                      .end_time_s = s.real(8),
                      .mission = {.start_world = {s.real(9), s.real(10), s.real(11)},
                                  .goal_world = {s.real(12), s.real(13), s.real(14)}},
                      .map_key = s.text(15),
                      .is_recorded = s.integer(16) != 0});
    TrialListing& trial = trials.back();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      trial.fields.push_back(s.value(kFirstField + static_cast<int>(i)));
    }
    trial.setting = setting_text(fields, trial.fields, axes);
  }
  return trials;
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

constexpr std::string_view kOfSweep = " WHERE s.sweep = ? AND s.revision = ? ";

/// A query that ends in kOfSweep, with the sweep's name and revision.
std::unique_ptr<Statement> of_sweep(const Database& db, const SweepResult& sweep,
                                    std::string_view sql) {
  // On the heap, since statements don't move.
  auto statement = std::make_unique<Statement>(db.handle(), db.path(), sql);
  statement->bind_text(sweep.name).bind_integer(sweep.revision);
  return statement;
}

void read_sweep_spec(const Database& db, SweepResult& result) {
  const auto spec =
      of_sweep(db, result, "SELECT s.spec_json, s.sweep FROM sweeps s" + std::string(kOfSweep));
  spec->rows_of("sweeps", 1);
  if (spec->step()) {
    result.spec_json = spec->text(0);
    check_json(*spec, result.spec_json, stored_sweep);
  }
  Statement latest(db.handle(), db.path(), "SELECT max(revision) FROM sweeps WHERE sweep = ?");
  latest.bind_text(result.name);
  if (latest.step() && !latest.is_null(0)) result.latest_revision = latest.integer(0);
}

/// Reads maps and missions; the place of each map by its key.
std::map<std::string, std::size_t> read_sweep_maps(const Database& db, SweepResult& result) {
  const auto maps = of_sweep(db, result,
                             // By the sweep's missions, not by its trials: maps that nobody has
                             // flown yet belong to it too.
                             "SELECT DISTINCT " + std::string(kMapColumns) +
                                 " FROM sweep_missions s JOIN maps m USING (map_key)" +
                                 std::string(kOfSweep) + "ORDER BY m.map_key");
  maps->rows_of("maps");
  std::map<std::string, std::size_t> indices;
  while (maps->step()) {
    result.maps.push_back(map_of(*maps));
    indices.emplace(result.maps.back().record.key, result.maps.size() - 1);
  }
  const auto missions =
      // In order of the index, by which reference_length_m() looks them up.
      of_sweep(db, result,
               "SELECT " + std::string(kMissionColumns) +
                   " FROM sweep_missions s JOIN missions i USING (map_key, mission_index)" +
                   std::string(kOfSweep) + "ORDER BY i.map_key, i.mission_index");
  missions->rows_of("missions");
  while (missions->step()) {
    const auto map = indices.find(missions->text(0));
    if (map == indices.end()) missions->damaged("its map is not there");
    result.maps[map->second].record.missions.push_back(mission_of(*missions));
  }
  for (MapRow& map : result.maps) read_legs(db, map.record);
  return indices;
}

}  // namespace

double goal_velocity_mps(const TrialSummary& trial) {
  if (trial.outcome != Outcome::reached_goal || !(trial.end_time_s > 0.0)) return 0.0;
  return trial.reference_length_m / trial.end_time_s;
}

std::map<std::string, Outcome> Database::finished_trials() const {
  std::map<std::string, Outcome> trials;
  Statement s(handle(), path(), "SELECT trial_key, outcome FROM trials");
  s.rows_of("trials");
  while (s.step()) trials.emplace(s.text(0), outcome_of(s, 1));
  return trials;
}

std::map<std::string, double> Database::goal_velocities_mps() const {
  std::map<std::string, double> velocities;
  Statement s(handle(), path(),
              "SELECT t.trial_key, t.outcome, t.end_time_s, i.reference_length_m FROM trials t "
              "JOIN missions i USING (map_key, mission_index)");
  s.rows_of("trials");
  while (s.step()) {
    velocities.emplace(s.text(0), goal_velocity_mps({.outcome = outcome_of(s, 1),
                                                     .reference_length_m = s.real(3),
                                                     .end_time_s = s.real(2)}));
  }
  return velocities;
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
  s.rows_of("maps").bind_text(key);
  if (!s.step()) return std::nullopt;
  MapRow row = map_of(s);
  Statement missions(handle(), path(),
                     "SELECT " + std::string(kMissionColumns) +
                         " FROM missions i WHERE i.map_key = ? ORDER BY i.mission_index");
  missions.rows_of("missions").bind_text(key);
  while (missions.step()) {
    row.record.missions.push_back(mission_of(missions));
    // Missions are drawn one after the other, so a map has them from 0 on without a gap.
    const bool is_next = row.record.missions.back().index + 1 ==
                         static_cast<std::int64_t>(row.record.missions.size());
    if (!is_next) missions.damaged("a mission before this one is missing");
  }
  read_legs(*this, row.record);
  return row;
}

std::optional<TrialRow> Database::read_trial(std::string_view key) const {
  return TrialReader(*this).read(key);
}

std::vector<TrialListing> Database::list_trials(const std::vector<std::string>& fields) const {
  Statement s(handle(), path(), listing_query(*this, fields) + " ORDER BY t.rowid");
  return listings(s, fields, fields.empty() ? fields : axis_fields(read_sweeps()));
}

std::vector<TrialListing> Database::list_trials(std::string_view sweep,
                                                std::int64_t revision) const {
  Statement s(handle(), path(),
              listing_query(*this, {}) +
                  " JOIN sweep_trials s USING (trial_key) WHERE s.sweep = ? AND s.revision = ? "
                  "ORDER BY t.rowid");
  s.bind_text(sweep).bind_integer(revision);
  return listings(s, {}, {});
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

std::vector<PlannerRow> Database::read_planners() const { return planner_rows(*this); }

std::vector<SweepInfo> Database::read_sweeps() const {
  Statement s(
      handle(), path(),
      "SELECT s.sweep, s.revision, s.spec_json, (SELECT count(*) FROM sweep_trials t WHERE "
      "t.sweep = s.sweep AND t.revision = s.revision) FROM sweeps s ORDER BY s.sweep, s.revision");
  s.rows_of("sweeps");
  std::vector<SweepInfo> sweeps;
  while (s.step()) {
    check_json(s, s.text(2), stored_sweep);
    sweeps.push_back({.name = s.text(0),
                      .revision = s.integer(1),
                      .spec_json = s.text(2),
                      .trial_count = s.integer(3)});
  }
  return sweeps;
}

SweepResult Database::read_sweep(std::string_view name, std::int64_t revision,
                                 const std::vector<std::string>& fields) const {
  // A run may commit trials between two of the queries below.
  const OneMoment moment(handle());
  SweepResult result{.name = std::string(name),
                     .revision = revision,
                     .latest_revision = revision,
                     .metrics = metrics_,
                     .planners = {},
                     .maps = {},
                     .trials = {},
                     .program_versions = {},
                     .spec_json = {},
                     .fields = fields,
                     .has_measured_latency = false};
  read_sweep_spec(*this, result);
  const std::map<std::string, std::size_t> map_indices = read_sweep_maps(*this, result);

  // Once over the sweep's trials; what they refer to is few and looked up here, unless a field asks
  // for it.
  const std::string_view tables =
      fields.empty() ? " FROM sweep_trials s JOIN trials t USING (trial_key)" : kTrialTables;
  const auto trials = of_sweep(
      *this, result,
      "SELECT t.trial_key, t.planner_key, t.map_key, t.mission_index, t.outcome, t.run_id, "
      "t.end_time_s" +
          metric_columns(*this) + field_columns(*this, fields) + std::string(tables) +
          std::string(kOfSweep) + "ORDER BY s.trial_key");
  const int first_field = 7 + static_cast<int>(metrics_.size());
  trials->rows_of("trials");
  std::set<std::string> planner_keys;
  std::set<std::int64_t> runs;
  std::map<std::string, std::string> causes;
  for (ExplanationRow& row : read_explanations()) {
    causes.emplace(std::move(row.trial_key), std::move(row.cause));
  }
  while (trials->step()) {
    TrialSummary trial = summary_of(*this, *trials);
    if (const auto cause = causes.find(trial.key); cause != causes.end()) {
      trial.cause = cause->second;
    }
    const auto map = map_indices.find(trial.map_key);
    if (map == map_indices.end()) trials->damaged("its map is not there");
    const auto length_m = reference_length_m(result.maps[map->second], trial.mission_index);
    if (!length_m) trials->damaged("its mission is not there");
    trial.reference_length_m = *length_m;
    // Most trials have a planner that was seen before: looking is cheaper than a node made in vain.
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
