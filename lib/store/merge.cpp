#include "store/merge.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/input_error.hpp"
#include "store/statement.hpp"

namespace avoidbench {
namespace {

/// Keeps a file attached as `shard`.
class Attached {
 public:
  Attached(const Database& database, const std::filesystem::path& file) : database_(database) {
    Statement attach(database.handle(), database.path(), "ATTACH ? AS shard");
    attach.bind_text(file.string()).run();
  }
  ~Attached() { sqlite3_exec(database_.handle(), "DETACH shard", nullptr, nullptr, nullptr); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  const Database& database_;
};

[[noreturn]] void refuse(const std::filesystem::path& file, std::string message) {
  throw InputError(InputProblem{.file = file.string(), .message = std::move(message)});
}

void check_metrics(const Database& into, const Database& from) {
  for (const MetricRow& metric : from.metrics()) {
    const auto same = std::find_if(into.metrics().begin(), into.metrics().end(),
                                   [&](const MetricRow& row) { return row.name == metric.name; });
    if (same == into.metrics().end() || same->version != metric.version) {
      refuse(from.path(), "holds metric " + metric.name + " in version " +
                              std::to_string(metric.version) + ", which " + into.path().string() +
                              " does not: databases of two versions can't be merged");
    }
  }
}

/// " OR m.a IS NOT s.a …" for the columns named.
std::string differs(const std::vector<std::string>& columns, const std::string& ours,
                    const std::string& theirs) {
  std::string text;
  for (const std::string& column : columns) {
    text += text.empty() ? "" : " OR ";
    text += ours + "." + column + " IS NOT " + theirs + "." + column;
  }
  return text;
}

const std::vector<std::string>& map_columns() {
  static const std::vector<std::string> columns{
      "world_digest",          "obstacle_count",    "triangle_count",
      "traversability",        "relative_gap_size", "traversability_normalized_ratio",
      "obstacle_density_1pm2", "free_volume_ratio"};
  return columns;
}

const std::vector<std::string>& mission_columns() {
  static const std::vector<std::string> columns{
      "start_x_m", "start_y_m", "start_z_m",      "goal_x_m",      "goal_y_m",
      "goal_z_m",  "is_valid",  "invalid_reason", "start_yaw_rad", "reference_length_m"};
  return columns;
}

void check_agreement(const Database& into, const std::filesystem::path& from) {
  std::vector<std::string> results{"outcome", "reason", "end_time_s"};
  for (const MetricRow& metric : into.metrics()) {
    if (!metric.is_measured) results.push_back(metric.name);
  }
  const std::pair<std::string, std::string> checks[] = {
      {"map", "SELECT m.map_key FROM main.maps m JOIN shard.maps s USING (map_key) WHERE " +
                  differs(map_columns(), "m", "s")},
      {"a mission of map",
       "SELECT m.map_key FROM main.missions m JOIN shard.missions s USING (map_key, "
       "mission_index) WHERE " +
           differs(mission_columns(), "m", "s")},
      {"trial",
       "SELECT m.trial_key FROM main.trials m JOIN shard.trials s USING (trial_key) "
       "LEFT JOIN main.trajectories mt ON mt.trial_key = m.trial_key "
       "LEFT JOIN shard.trajectories st ON st.trial_key = m.trial_key "
       "LEFT JOIN main.plan_calls mc ON mc.trial_key = m.trial_key "
       "LEFT JOIN shard.plan_calls sc ON sc.trial_key = m.trial_key WHERE " +
           differs(results, "m", "s") +
           " OR mt.samples_digest IS NOT st.samples_digest OR mc.calls_digest IS NOT "
           "sc.calls_digest"}};
  for (const auto& [what, sql] : checks) {
    Statement statement(into.handle(), into.path(), sql + " LIMIT 1");
    if (!statement.step()) continue;
    refuse(from, "holds " + what + " " + statement.text(0).substr(0, 12) +
                     " with other values than " + into.path().string() +
                     ": they come from other programs or files, or times were measured; nothing "
                     "was merged");
  }
}

/// Runs that are not there yet, and temp.run_of: their number here.
void take_runs(const Database& into) {
  const std::vector<std::string> columns{
      "started_at", "program_version", "git_hash", "compiler", "flags", "host", "cpu",
      "isa",        "command_line",    "shard"};
  std::string list;
  for (const std::string& column : columns) list += (list.empty() ? "" : ", ") + column;
  const std::string same = "NOT (" + differs(columns, "m", "s") + ")";
  execute(into.handle(), into.path(),
          "INSERT INTO main.runs (" + list + ") SELECT " + list +
              " FROM shard.runs s WHERE NOT EXISTS (SELECT 1 FROM main.runs m WHERE " + same +
              ") ORDER BY run_id;"
              "CREATE TEMP TABLE run_of AS SELECT s.run_id AS theirs, (SELECT min(m.run_id) FROM "
              "main.runs m WHERE " +
              same + ") AS ours FROM shard.runs s;");
}

/// Sweeps that are not there yet, and temp.sweep_of: their revisions here.
void take_sweeps(const Database& into) {
  execute(into.handle(), into.path(),
          "INSERT INTO main.sweeps (sweep, revision, spec_json) SELECT s.sweep, "
          "(SELECT coalesce(max(revision), 0) FROM main.sweeps m WHERE m.sweep = s.sweep) + "
          "row_number() OVER (PARTITION BY s.sweep ORDER BY s.revision), s.spec_json FROM "
          "shard.sweeps s WHERE NOT EXISTS (SELECT 1 FROM main.sweeps m WHERE m.sweep = s.sweep "
          "AND m.spec_json = s.spec_json);"
          "CREATE TEMP TABLE sweep_of AS SELECT s.sweep, s.revision AS theirs, m.revision AS ours "
          "FROM shard.sweeps s JOIN main.sweeps m ON m.sweep = s.sweep AND m.spec_json = "
          "s.spec_json;");
}

/// The columns of a table of the attached file that we have too.
std::string columns_of(const Database& database, const std::string& table) {
  Statement statement(database.handle(), database.path(),
                      "SELECT name FROM pragma_table_info(?, 'shard')");
  statement.bind_text(table);
  std::string columns;
  while (statement.step()) columns += (columns.empty() ? "" : ", ") + statement.text(0);
  return columns;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  if (const std::size_t at = text.find(from); at != std::string::npos) {
    text.replace(at, from.size(), to);
  }
  return text;
}

void take_rows(const Database& into) {
  std::string sql;
  for (const std::string table : {"planners", "maps", "missions"}) {
    const std::string columns = columns_of(into, table);
    sql += "INSERT OR IGNORE INTO main." + table + " (" + columns + ") SELECT " + columns +
           " FROM shard." + table + ";";
  }
  const std::string trials = columns_of(into, "trials");
  sql +=
      "CREATE TEMP TABLE added AS SELECT trial_key FROM shard.trials WHERE trial_key NOT IN "
      "(SELECT trial_key FROM main.trials);"
      "INSERT INTO main.trials (" +
      trials + ") SELECT " +
      replaced(trials, "run_id", "(SELECT ours FROM temp.run_of WHERE theirs = run_id)") +
      " FROM shard.trials WHERE trial_key IN (SELECT trial_key FROM temp.added) ORDER BY rowid;";
  for (const std::string table : {"trajectories", "plan_calls", "events"}) {
    const std::string columns = columns_of(into, table);
    sql += "INSERT INTO main." + table + " (" + columns + ") SELECT " + columns + " FROM shard." +
           table + " WHERE trial_key IN (SELECT trial_key FROM temp.added);";
  }
  sql +=
      "INSERT OR IGNORE INTO main.sweep_missions (sweep, revision, map_key, mission_index) SELECT "
      "s.sweep, o.ours, s.map_key, s.mission_index FROM shard.sweep_missions s JOIN temp.sweep_of "
      "o ON o.sweep = s.sweep AND o.theirs = s.revision;"
      "INSERT OR IGNORE INTO main.sweep_trials (sweep, revision, trial_key) SELECT s.sweep, "
      "o.ours, s.trial_key FROM shard.sweep_trials s JOIN temp.sweep_of o ON o.sweep = s.sweep "
      "AND o.theirs = s.revision;";
  execute(into.handle(), into.path(), sql);
}

std::int64_t count_of(const Database& database, const std::string& sql) {
  Statement statement(database.handle(), database.path(), sql);
  statement.step();
  return statement.integer(0);
}

/// Whether an axis of this path makes other maps or missions: see map_key() of the room sweep.
bool changes_map(const std::string& path) {
  return path.starts_with("map") || path.starts_with("mission.") || path == "seed" ||
         path == "vehicle.body_size_m";
}

/// The shards that a set of "2/3", "" … lacks.
std::vector<std::string> lost_of(const std::set<std::string>& seen) {
  std::vector<std::string> lost;
  if (seen.contains("")) return lost;
  std::set<std::string> counts;
  for (const std::string& shard : seen) counts.insert(shard.substr(shard.find('/') + 1));
  for (const std::string& count : counts) {
    for (int i = 1; i <= std::atoi(count.c_str()); ++i) {
      const std::string shard = std::to_string(i) + "/" + count;
      if (!seen.contains(shard)) lost.push_back(shard);
    }
  }
  return lost;
}

}  // namespace

MergeResult merge_database(Database& into, const std::filesystem::path& from) {
  {
    const Database checked = Database::open_for_reading(from);
    std::error_code error;
    if (std::filesystem::equivalent(from, into.path(), error)) {
      refuse(from, "is the file to merge into");
    }
    check_metrics(into, checked);
  }
  const Attached attached(into, from);
  MergeResult result{.trials = count_of(into, "SELECT count(*) FROM shard.trials"),
                     .new_trials = 0};
  Transaction transaction(into.handle(), into.path());
  check_agreement(into, from);
  take_runs(into);
  take_sweeps(into);
  take_rows(into);
  result.new_trials = count_of(into, "SELECT count(*) FROM temp.added");
  execute(into.handle(), into.path(),
          "DROP TABLE temp.added; DROP TABLE temp.run_of; DROP TABLE temp.sweep_of;");
  transaction.commit();
  return result;
}

std::vector<SweepCompleteness> sweep_completeness(const Database& database) {
  std::vector<SweepCompleteness> all;
  for (const SweepInfo& sweep : database.read_sweeps()) {
    const nlohmann::json spec = nlohmann::json::parse(sweep.spec_json);
    SweepCompleteness one{.name = sweep.name,
                          .revision = sweep.revision,
                          .wanted = 0,
                          .flown = sweep.trial_count,
                          .shards = {},
                          .lost_shards = {}};
    const auto planners = static_cast<std::int64_t>(spec.at("planners").size());
    one.wanted = planners * spec.at("trials").get<std::int64_t>();
    for (const nlohmann::json& axis : spec.at("axes")) {
      one.wanted *= static_cast<std::int64_t>(axis.at("values").size());
    }
    // An invalid mission of a map is one of every combination of the axes that leave the map alone.
    std::int64_t per_mission = planners;
    for (const nlohmann::json& axis : spec.at("axes")) {
      if (!changes_map(axis.at("path"))) {
        per_mission *= static_cast<std::int64_t>(axis.at("values").size());
      }
    }
    Statement invalid(database.handle(), database.path(),
                      "SELECT count(*) FROM sweep_missions s JOIN missions i USING (map_key, "
                      "mission_index) WHERE s.sweep = ? AND s.revision = ? AND NOT i.is_valid");
    invalid.bind_text(sweep.name).bind_integer(sweep.revision).step();
    one.wanted -= per_mission * invalid.integer(0);
    Statement shards(database.handle(), database.path(),
                     "SELECT DISTINCT r.shard FROM sweep_trials s JOIN trials t USING (trial_key) "
                     "JOIN runs r USING (run_id) WHERE s.sweep = ? AND s.revision = ? ORDER BY 1");
    shards.bind_text(sweep.name).bind_integer(sweep.revision);
    std::set<std::string> seen;
    while (shards.step()) seen.insert(shards.text(0));
    one.shards.assign(seen.begin(), seen.end());
    one.lost_shards = lost_of(seen);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace avoidbench
