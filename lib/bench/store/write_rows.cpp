#include <bit>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/math.hpp"
#include "store/database.hpp"
#include "store/record_format.hpp"
#include "store/row_digest.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

// NaN, a value that is not defined, is equal to itself here.
bool same(double a, double b) { return a == b || (a != a && b != b); }

bool same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

bool same(const MapRecord& a, const MapRecord& b) {
  return a.world_digest == b.world_digest && a.obstacle_count == b.obstacle_count &&
         a.triangle_count == b.triangle_count && same(a.traversability, b.traversability) &&
         same(a.traversability_normalized_ratio, b.traversability_normalized_ratio) &&
         same(a.relative_gap_size, b.relative_gap_size) &&
         same(a.obstacle_density_1pm2, b.obstacle_density_1pm2) &&
         same(a.free_volume_ratio, b.free_volume_ratio);
}

bool same(const MissionRecord& a, const MissionRecord& b) {
  return same(a.mission.start_world, b.mission.start_world) &&
         same(a.mission.goal_world, b.mission.goal_world) &&
         same(a.mission.start_yaw_rad, b.mission.start_yaw_rad) &&
         a.mission.waypoints_world == b.mission.waypoints_world &&
         a.leg_lengths_m == b.leg_lengths_m && same(a.reference_length_m, b.reference_length_m) &&
         same(a.difficulty.traversability_obstruction, b.difficulty.traversability_obstruction) &&
         same(a.difficulty.view_occlusion, b.difficulty.view_occlusion) &&
         same(a.difficulty.angle_over_length_1pm, b.difficulty.angle_over_length_1pm) &&
         a.is_valid == b.is_valid && a.invalid_reason == b.invalid_reason;
}

void insert_map(const Database& db, const MapRow& row) {
  const MapRecord& r = row.record;
  Statement insert(
      db.handle(), db.path(),
      "INSERT INTO maps (map_key, generator, map_seed, spec_json, world_digest, "
      "obstacle_count, triangle_count, traversability, traversability_normalized_ratio, "
      "relative_gap_size, obstacle_density_1pm2, free_volume_ratio) "
      "VALUES (?,?,?,?,?,?,?,?,?,?,?,?)");
  insert.bind_text(r.key).bind_text(row.generator);
  // SQLite's integers have a sign: the same 64 bits.
  insert.bind_integer(std::bit_cast<std::int64_t>(row.map_seed));
  insert.bind_text(row.spec_json).bind_text(r.world_digest);
  insert.bind_integer(r.obstacle_count).bind_integer(r.triangle_count);
  insert.bind_real(r.traversability).bind_real(r.traversability_normalized_ratio);
  insert.bind_real(r.relative_gap_size).bind_real(r.obstacle_density_1pm2);
  insert.bind_real(r.free_volume_ratio).run();
}

void insert_missions(const Database& db, const MapRow& row) {
  Statement insert(db.handle(), db.path(),
                   "INSERT INTO missions (map_key, mission_index, start_x_m, start_y_m, start_z_m, "
                   "goal_x_m, goal_y_m, goal_z_m, start_yaw_rad, reference_length_m, "
                   "traversability_obstruction, view_occlusion, angle_over_length_1pm, is_valid, "
                   // More missions may have been asked for before than now, or fewer.
                   "invalid_reason) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT DO NOTHING");
  for (const MissionRecord& m : row.record.missions) {
    const Eigen::Vector3d& start = m.mission.start_world;
    const Eigen::Vector3d& goal = m.mission.goal_world;
    insert.bind_text(row.record.key).bind_integer(m.index);
    insert.bind_real(start.x()).bind_real(start.y()).bind_real(start.z());
    insert.bind_real(goal.x()).bind_real(goal.y()).bind_real(goal.z());
    insert.bind_real(m.mission.start_yaw_rad).bind_real(m.reference_length_m);
    insert.bind_real(m.difficulty.traversability_obstruction);
    insert.bind_real(m.difficulty.view_occlusion).bind_real(m.difficulty.angle_over_length_1pm);
    insert.bind_integer(m.is_valid ? 1 : 0).bind_text(m.invalid_reason).run();
  }
}

/// The legs of missions that have several.
void insert_legs(const Database& db, const MapRow& row) {
  Statement insert(db.handle(), db.path(),
                   "INSERT INTO mission_legs (map_key, mission_index, leg_index, goal_x_m, "
                   "goal_y_m, goal_z_m, reference_length_m) VALUES (?,?,?,?,?,?,?) ON CONFLICT DO "
                   "NOTHING");
  for (const MissionRecord& m : row.record.missions) {
    if (m.mission.waypoints_world.empty()) continue;
    const std::vector<Eigen::Vector3d> goals = goals_of(m.mission);
    for (std::size_t i = 0; i < goals.size(); ++i) {
      insert.bind_text(row.record.key).bind_integer(m.index);
      insert.bind_integer(static_cast<std::int64_t>(i));
      insert.bind_real(goals[i].x()).bind_real(goals[i].y()).bind_real(goals[i].z());
      insert.bind_real(m.is_valid ? m.leg_lengths_m[i] : math::kNaN).run();
    }
  }
}

/// A map of this key is there: all that both know of it must be the same, or results of two
/// programs would stand in one file.
void check_same_map(const Database& db, const MapRow& stored, const MapRow& row) {
  bool agrees = same(stored.record, row.record);
  std::map<std::int64_t, const MissionRecord*> missions;
  for (const MissionRecord& mission : stored.record.missions) missions[mission.index] = &mission;
  for (const MissionRecord& mission : row.record.missions) {
    const auto other = missions.find(mission.index);
    agrees = agrees && (other == missions.end() || same(*other->second, mission));
  }
  if (!agrees) {
    throw InputError(InputProblem{
        .file = db.path().string(),
        .message =
            "map " + row.record.key.substr(0, 12) +
            " is stored with other values than this avoidbench computes: write to another file"});
  }
}

/// A trial that is flown again takes its row over: id and key stay, `attempt` rises.
std::string insert_trial_sql(const Database& db) {
  std::string columns, marks, updates;
  for (const MetricRow& metric : db.metrics()) {
    const std::string name = sql_name(metric.name);
    columns += ", " + name;
    marks += ",?";
    updates += ", " + name + " = excluded." + name;
  }
  return "INSERT INTO trials (trial_key, map_key, mission_index, planner_key, outcome, reason, "
         "end_time_s, attempt, run_id, spec_json, wall_time_s" +
         columns + ") VALUES (?,?,?,?,?,?,?,1,?,?,?" + marks +
         ") ON CONFLICT (trial_key) DO UPDATE SET outcome = excluded.outcome, reason = "
         "excluded.reason, "
         "end_time_s = excluded.end_time_s, attempt = attempt + 1, run_id = excluded.run_id, "
         "spec_json = excluded.spec_json, wall_time_s = excluded.wall_time_s" +
         updates;
}

void write_record(const Database& db, const TrialRow& row) {
  const std::vector<std::byte> samples = sample_bytes(row.record.samples);
  Statement trajectory(
      db.handle(), db.path(),
      "INSERT OR REPLACE INTO trajectories (trial_key, sample_count, samples_digest, "
      "samples) VALUES (?,?,?,?)");
  trajectory.bind_text(row.key).bind_integer(static_cast<std::int64_t>(row.record.samples.size()));
  // Digested as samples, not as they are packed.
  trajectory.bind_text(Digest().add_bytes(samples).hex()).bind_blob(packed_samples(samples)).run();

  Statement calls(
      db.handle(), db.path(),
      "INSERT OR REPLACE INTO plan_calls (trial_key, call_count, calls_digest, calls_json) "
      "VALUES (?,?,?,?)");
  calls.bind_text(row.key).bind_integer(static_cast<std::int64_t>(row.record.plan_calls.size()));
  calls.bind_text(plan_calls_digest(row.record.plan_calls));
  calls.bind_text(plan_calls_json(row.record.plan_calls)).run();

  // A trial that is flown again may have fewer events.
  Statement(db.handle(), db.path(), "DELETE FROM events WHERE trial_key = ?")
      .bind_text(row.key)
      .run();
  Statement event(
      db.handle(), db.path(),
      "INSERT INTO events (trial_key, event_index, kind, time_s, speed_mps, obstacle_index, "
      "obstacle_kind) VALUES (?,?,'collision',?,?,?,?)");
  for (std::size_t i = 0; i < row.record.collisions.size(); ++i) {
    const Collision& collision = row.record.collisions[i];
    event.bind_text(row.key).bind_integer(static_cast<std::int64_t>(i));
    event.bind_real(collision.time_s).bind_real(collision.speed_mps);
    event.bind_integer(collision.obstacle).bind_text(collision.kind).run();
  }
}

/// Notes that the finished trials among `keys`, and with them their missions, belong to the sweep.
void insert_sweep_trials(const Database& db, std::string_view sweep, std::int64_t revision,
                         std::span<const std::string> keys) {
  Statement trial(
      db.handle(), db.path(),
      // By SELECT: a key that has no trial adds nothing.
      "INSERT INTO sweep_trials (sweep, revision, trial_key) SELECT ?, ?, trial_key FROM "
      "trials WHERE trial_key = ? ON CONFLICT DO NOTHING");
  Statement mission(
      db.handle(), db.path(),
      "INSERT INTO sweep_missions (sweep, revision, map_key, mission_index) SELECT ?, ?, "
      "map_key, mission_index FROM trials WHERE trial_key = ? ON CONFLICT DO NOTHING");
  for (const std::string& key : keys) {
    trial.bind_text(sweep).bind_integer(revision).bind_text(key).run();
    mission.bind_text(sweep).bind_integer(revision).bind_text(key).run();
  }
}

}  // namespace

std::string planner_key(const PlannerRow& row) {
  Digest digest;
  digest.add(row.label)
      .add(row.name)
      .add(row.version)
      .add(row.file_digest)
      .add(row.parameters_json);
  digest.add(std::uint64_t{row.is_privileged ? 1U : 0U});
  return digest.hex();
}

std::int64_t Database::revision_of(std::string_view sweep) const {
  const auto found = revisions_.find(sweep);
  AB_CHECK(found != revisions_.end(), "add_sweep() comes first:", sweep);
  return found->second;
}

std::int64_t Database::add_run(const RunRow& row) {
  Statement insert(
      handle(), path(),
      "INSERT INTO runs (started_at, program_version, git_hash, compiler, flags, host, "
      "cpu, isa, command_line, shard, sandbox) VALUES (?,?,?,?,?,?,?,?,?,?,?) RETURNING run_id");
  insert.bind_text(row.started_at).bind_text(row.program_version).bind_text(row.git_hash);
  insert.bind_text(row.compiler).bind_text(row.flags).bind_text(row.host).bind_text(row.cpu);
  insert.bind_text(row.isa).bind_text(row.command_line).bind_text(row.shard);
  insert.bind_text(row.sandbox).step();
  // RETURNING gives a row, and the statement is done only behind it: run() steps to the end.
  run_id_ = insert.integer(0);
  insert.run();
  return run_id_;
}

std::int64_t Database::add_sweep(const SweepRow& row) {
  // Finding and adding in one, though nobody else writes: half of it must not be committed.
  Transaction transaction(handle(), path());
  std::int64_t revision = 0;
  // The same spec has the revision that it had.
  {
    Statement find(handle(), path(),
                   "SELECT revision FROM sweeps WHERE sweep = ? AND spec_json = ?");
    find.bind_text(row.name).bind_text(row.spec_json);
    if (find.step()) revision = find.integer(0);
  }
  if (revision == 0) {
    Statement insert(handle(), path(),
                     "INSERT INTO sweeps (sweep, revision, spec_json) SELECT ?1, "
                     "1 + coalesce(max(revision), 0), ?2 FROM sweeps WHERE sweep = ?1 "
                     "RETURNING revision");
    insert.bind_text(row.name).bind_text(row.spec_json).step();
    revision = insert.integer(0);
    insert.run();
    remake_views();
  }
  transaction.commit();
  require_in_place();
  revisions_[row.name] = revision;
  return revision;
}

void Database::add_planner(const PlannerRow& given) {
  PlannerRow row = given;  // as it can be stored: its key is checked against what is read
  for (std::string* text : {&row.label, &row.name, &row.version, &row.parameters_json}) {
    *text = as_utf8(*text);
  }
  const std::string key = planner_key(row);
  Statement insert(handle(), path(),
                   "INSERT INTO planners (planner_key, label, name, version, file_digest, "
                   "parameters_json, is_privileged) VALUES (?,?,?,?,?,?,?) ON CONFLICT DO NOTHING");
  insert.bind_text(key).bind_text(row.label).bind_text(row.name).bind_text(row.version);
  insert.bind_text(row.file_digest).bind_text(row.parameters_json);
  insert.bind_integer(row.is_privileged ? 1 : 0).run();
  // By what the caller knows of it; the stored text may be another one.
  planners_[{given.label, given.file_digest}] = key;
}

void Database::add_map(const MapRow& row, std::string_view sweep) {
  const std::int64_t revision = revision_of(sweep);
  Transaction transaction(handle(), path());
  if (const std::optional<MapRow> stored = read_map(row.record.key)) {
    check_same_map(*this, *stored, row);
  } else {
    insert_map(*this, row);
  }
  insert_missions(*this, row);
  insert_legs(*this, row);
  Statement insert(handle(), path(),
                   "INSERT INTO sweep_missions (sweep, revision, map_key, mission_index) "
                   "VALUES (?,?,?,?) ON CONFLICT DO NOTHING");
  for (const MissionRecord& mission : row.record.missions) {
    insert.bind_text(sweep).bind_integer(revision).bind_text(row.record.key);
    insert.bind_integer(mission.index).run();
  }
  transaction.commit();
  require_in_place();
}

void Database::add_trial(const TrialRow& row) {
  AB_CHECK(run_id_ != 0, "add_run() comes first");
  AB_CHECK(row.metrics.size() == metrics_.size(), row.metrics.size(), metrics_.size());
  const auto planner = planners_.find({row.planner_label, row.planner_file_digest});
  AB_CHECK(planner != planners_.end(), "add_planner() comes first:", row.planner_label);
  const std::int64_t revision = revision_of(row.sweep);

  Transaction transaction(handle(), path());
  Statement insert(handle(), path(), insert_trial_sql(*this));
  insert.bind_text(row.key).bind_text(row.map_key).bind_integer(row.mission_index);
  insert.bind_text(planner->second)
      .bind_text(text(row.record.outcome))
      .bind_text(row.record.reason);
  insert.bind_real(row.record.end_time_s).bind_integer(run_id_).bind_text(row.spec_json);
  insert.bind_real(row.wall_time_s);
  for (const double value : row.metrics) insert.bind_real(value);
  insert.run();
  write_record(*this, row);
  // Within the transaction: a row without its digests is never seen.
  write_digests(*this, row.key);
  insert_sweep_trials(*this, row.sweep, revision, std::span(&row.key, 1));
  transaction.commit();
  require_in_place();
}

void Database::add_to_sweep(std::string_view sweep, std::span<const std::string> keys) {
  const std::int64_t revision = revision_of(sweep);
  // The usual case, a second run of a whole sweep, then looks at no single key in the file.
  std::set<std::string> others;  // finished, and not of the sweep: mostly few or none
  {
    Statement s(handle(), path(),
                "SELECT trial_key FROM trials t WHERE NOT EXISTS (SELECT 1 FROM sweep_trials s "
                "WHERE s.sweep = ? AND s.revision = ? AND s.trial_key = t.trial_key)");
    s.bind_text(sweep).bind_integer(revision);
    while (s.step()) others.insert(s.text(0));
  }
  std::vector<std::string> added;
  for (const std::string& key : keys) {
    if (!others.empty() && others.contains(key)) added.push_back(key);
  }
  Transaction transaction(handle(), path());
  insert_sweep_trials(*this, sweep, revision, added);
  transaction.commit();
  require_in_place();
}

}  // namespace avoidbench
