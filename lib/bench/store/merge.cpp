#include "store/merge.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "base/input_error.hpp"
#include "store/row_digest.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/stored_text.hpp"
#include "store/trial_table.hpp"
#include "trial/map_fields.hpp"

namespace avoidbench {
namespace {

/// Keeps a file attached as `shard`, for reading only. No other file can be attached meanwhile.
class Attached {
 public:
  Attached(const Database& into, const Database& from) : handle_(into.handle()) {
    sqlite3_limit(handle_, SQLITE_LIMIT_ATTACHED, 1);
    Statement attach(handle_, into.path(), "ATTACH ? AS shard");
    // Read-only, even if the file could be written: what is merged from stays as it is.
    const bool has_options = from.uri().find('?') != std::string::npos;
    attach.bind_text(from.uri() + (has_options ? "&mode=ro" : "?mode=ro")).run();
  }
  ~Attached() {
    sqlite3_exec(handle_, "DETACH shard", nullptr, nullptr, nullptr);
    sqlite3_limit(handle_, SQLITE_LIMIT_ATTACHED, 0);
  }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  sqlite3* handle_;
};

bool is_same_quantity(const MetricRow& a, const MetricRow& b) {
  return a.version == b.version && a.unit == b.unit && a.better == b.better &&
         a.population == b.population && a.is_measured == b.is_measured;
}

/// A column must not hold two quantities under one name.
void check_metrics(const Database& into, const Database& from) {
  for (const MetricRow& metric : from.metrics()) {
    const auto same = std::find_if(into.metrics().begin(), into.metrics().end(),
                                   [&](const MetricRow& row) { return row.name == metric.name; });
    if (same == into.metrics().end() || !is_same_quantity(*same, metric)) {
      refuse_file(from.path(), "holds metric " + metric.name + " in version " +
                                   std::to_string(metric.version) + ", which " +
                                   into.path().string() +
                                   " does not: databases of two versions can't be merged");
    }
  }
}

/// The columns, quoted, with commas.
std::string list_of(const std::vector<std::string>& columns) {
  std::string list;
  for (const std::string& column : columns) list += (list.empty() ? "" : ", ") + sql_name(column);
  return list;
}

/// "m.a IS NOT s.a OR …" for the columns named.
/// IS NOT tells NULL from values, and NULL equals itself.
std::string differs(const std::vector<std::string>& columns, const std::string& ours,
                    const std::string& theirs) {
  std::string text;
  for (const std::string& column : columns) {
    text += text.empty() ? "" : " OR ";
    text += ours + "." + sql_name(column) + " IS NOT " + theirs + "." + sql_name(column);
  }
  return text;
}

/// The specs differ in more than the names of files, of which keys hold the digests.
std::string specs_differ(const std::string& file_paths) {
  return "(m.spec_json IS NOT s.spec_json AND json_remove(m.spec_json, " + file_paths +
         ") IS NOT json_remove(s.spec_json, " + file_paths + "))";
}

/// Our columns of the table without these.
std::vector<std::string> columns_without(const std::string& table,
                                         const std::set<std::string>& left_out) {
  std::vector<std::string> columns = columns_of(table);
  std::erase_if(columns, [&](const std::string& column) { return left_out.contains(column); });
  return columns;
}

/// A query of the keys of rows of `table` that both files have, with other values.
std::string differing_rows(const std::string& table, const std::string& keys,
                           const std::string& condition) {
  // The first key names the row in messages.
  return "SELECT m." + keys.substr(0, keys.find(',')) + " FROM main." + table + " m JOIN shard." +
         table + " s USING (" + keys + ") WHERE " + condition;
}

/// A query of the trials that both have, with events that one of them lacks.
std::string differing_events(const std::string& one, const std::string& other) {
  const std::string columns = list_of(columns_of("events"));
  return "SELECT trial_key FROM (SELECT " + columns + " FROM " + one + ".events EXCEPT SELECT " +
         columns + " FROM " + other +
         ".events) WHERE trial_key IN (SELECT trial_key FROM main.trials INTERSECT SELECT "
         "trial_key "
         "FROM shard.trials)";
}

/// Whether the attached file has missions of several goals; those of older programs lack the table.
bool has_legs(const Database& into) {
  return has_table(into.handle(), into.path(), "shard", "mission_legs");
}

/// Refuses a file that holds a row of ours with other values. What a clock measured may differ, and
/// so may runs, attempts and how samples are packed.
void check_agreement(const Database& into, const Database& from) {
  // Digests cover what may differ, such as wall times: the columns themselves are compared.
  std::vector<std::string> results =
      columns_without("trials", {"trial_key", "attempt", "run_id", "wall_time_s", "spec_json",
                                 "row_digest", "flight_digest"});
  for (const MetricRow& metric : from.metrics()) {
    if (!metric.is_measured) results.push_back(metric.name);
  }
  const auto all_of = [](const std::string& table, const std::set<std::string>& left_out) {
    return differs(columns_without(table, left_out), "m", "s");
  };
  const std::pair<std::string, std::string> checks[] = {
      {"planner", differing_rows("planners", "planner_key", all_of("planners", {"planner_key"}))},
      {"map", differing_rows(
                  "maps", "map_key",
                  all_of("maps", {"map_key", "spec_json"}) + " OR " + specs_differ("'$.file'"))},
      {"a mission of map", differing_rows("missions", "map_key, mission_index",
                                          all_of("missions", {"map_key", "mission_index"}))},
      {"a leg of a mission of map",
       has_legs(into)
           ? differing_rows("mission_legs", "map_key, mission_index, leg_index",
                            all_of("mission_legs", {"map_key", "mission_index", "leg_index"}))
           : ""},
      {"trial", differing_rows("trials", "trial_key",
                               differs(results, "m", "s") + " OR " +
                                   specs_differ("'$.map.file', '$.wind.field.file', "
                                                "'$.planner.plugin', '$.planner.filter.plugin'"))},
      {"the flight of trial", differing_rows("trajectories", "trial_key",
                                             all_of("trajectories", {"trial_key", "samples"}))},
      {"the calls of trial", differing_rows("plan_calls", "trial_key",
                                            all_of("plan_calls", {"trial_key", "calls_json"}))},
      // EXCEPT sees one direction only.
      {"an event of trial", differing_events("main", "shard")},
      {"an event of trial", differing_events("shard", "main")},
      // Other programs and planners may have flown them: such rows stay as they are here.
      {"the what-if of trial",
       differing_rows("what_ifs", "trial_key, change",
                      "m.program_version IS s.program_version AND m.planner_digest IS "
                      "s.planner_digest AND (" +
                          differs({"outcome", "reason", "end_time_s", "record_digest"}, "m", "s") +
                          ")")},
      {"the explanation of trial",
       differing_rows("explanations", "trial_key",
                      "m.rules_version IS s.rules_version AND m.record_digest IS s.record_digest "
                      "AND (" +
                          differs({"cause", "facts_json"}, "m", "s") + ")")},
      {"trial",
       // Flights or calls that only one of the two has.
       "SELECT trial_key FROM main.trials JOIN shard.trials USING (trial_key) WHERE "
       "(trial_key IN (SELECT trial_key FROM main.trajectories)) IS NOT "
       "(trial_key IN (SELECT trial_key FROM shard.trajectories)) OR "
       "(trial_key IN (SELECT trial_key FROM main.plan_calls)) IS NOT "
       "(trial_key IN (SELECT trial_key FROM shard.plan_calls))"}};
  for (const auto& [what, sql] : checks) {
    if (sql.empty()) continue;
    Statement statement(into.handle(), into.path(), sql + " LIMIT 1");
    if (!statement.step()) continue;
    refuse_file(from.path(),
                "holds " + what + " " + statement.text(0).substr(0, 12) +
                    " with other values than " + into.path().string() +
                    ": they come from other programs or files, or times were measured; "
                    "nothing was merged");
  }
}

/// Runs that are not there yet, and temp.run_of: their number here.
void take_runs(const Database& into) {
  const std::vector<std::string> columns = columns_without("runs", {"run_id"});
  const std::string list = list_of(columns);
  // Runs have no key: equal in all columns is the same run.
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
          // A sweep of equal name and content is there already; another content becomes the next
          // revision, in the order of the other file's revisions.
          "INSERT INTO main.sweeps (sweep, revision, spec_json) SELECT s.sweep, "
          "(SELECT coalesce(max(revision), 0) FROM main.sweeps m WHERE m.sweep = s.sweep) + "
          "row_number() OVER (PARTITION BY s.sweep ORDER BY s.revision), s.spec_json FROM "
          "shard.sweeps s WHERE NOT EXISTS (SELECT 1 FROM main.sweeps m WHERE m.sweep = s.sweep "
          "AND m.spec_json = s.spec_json);"
          "CREATE TEMP TABLE sweep_of AS SELECT s.sweep, s.revision AS theirs, m.revision AS ours "
          "FROM shard.sweeps s JOIN main.sweeps m ON m.sweep = s.sweep AND m.spec_json = "
          "s.spec_json;");
}

/// Adds the rows of the attached file's table that `condition` chooses and that are not there yet.
std::string taking(const std::string& table, const std::string& condition) {
  const std::string columns = list_of(columns_of(table));
  return "INSERT INTO main." + table + " (" + columns + ") SELECT " + columns + " FROM shard." +
         table + " WHERE " + condition + " ON CONFLICT DO NOTHING;";
}

/// All rows that are new, in one script: planners, maps and missions, trials with their flights,
/// and what belongs to which sweep.
void take_rows(const Database& into, const Database& from) {
  std::string sql;
  for (const std::string table : {"planners", "maps", "missions"}) sql += taking(table, "true");
  if (has_legs(into)) sql += taking("mission_legs", "true");
  std::vector<std::string> own = columns_without("trials", {"run_id"});
  for (const MetricRow& metric : from.metrics()) own.push_back(metric.name);
  const std::string trials = list_of(own);
  // Which trials are new has to be known before they are added: their flights follow by it.
  sql +=
      "CREATE TEMP TABLE added AS SELECT trial_key FROM shard.trials WHERE trial_key NOT IN "
      "(SELECT trial_key FROM main.trials);"
      "INSERT INTO main.trials (" +
      trials + ", run_id) SELECT " + trials +
      ", (SELECT ours FROM temp.run_of WHERE theirs = run_id) FROM shard.trials WHERE trial_key IN "
      // Ids of trials count in the order in which they were flown.
      "(SELECT trial_key FROM temp.added) ORDER BY rowid;";
  for (const std::string table : {"trajectories", "plan_calls", "events"}) {
    // Only those of trials that are new here: rows that are there stay as they are.
    sql += taking(table, "trial_key IN (SELECT trial_key FROM temp.added)");
  }
  sql += taking("what_ifs", "true") + taking("explanations", "true");
  sql +=
      "INSERT INTO main.sweep_missions (sweep, revision, map_key, mission_index) SELECT "
      "s.sweep, o.ours, s.map_key, s.mission_index FROM shard.sweep_missions s JOIN temp.sweep_of "
      "o ON o.sweep = s.sweep AND o.theirs = s.revision WHERE true ON CONFLICT DO NOTHING;"
      "INSERT INTO main.sweep_trials (sweep, revision, trial_key) SELECT s.sweep, "
      "o.ours, s.trial_key FROM shard.sweep_trials s JOIN temp.sweep_of o ON o.sweep = s.sweep "
      "AND o.theirs = s.revision WHERE true ON CONFLICT DO NOTHING;";
  execute(into.handle(), into.path(), sql);
}

/// What digests say of the flights and plan calls that were taken over is true.
void check_added_flights(const Database& into, const Database& from) {
  TrialReader reader(from);
  Statement added(into.handle(), into.path(), "SELECT trial_key FROM temp.added");
  while (added.step()) reader.read(added.text(0));
}

std::int64_t count_of(const Database& database, const std::string& sql) {
  Statement statement(database.handle(), database.path(), sql);
  statement.step();
  return statement.integer(0);
}

/// The shards that a set of "2/3", "" … lacks; not more than a thousand.
std::vector<std::string> lost_of(const std::set<std::string>& seen) {
  // A file may say that it is one of a billion shards.
  constexpr std::size_t kMost = 1000;
  std::vector<std::string> lost;
  // A whole run flew all shards.
  if (seen.contains("")) return lost;
  std::set<std::string> counts;
  for (const std::string& shard : seen) counts.insert(shard.substr(shard.find('/') + 1));
  for (const std::string& text : counts) {
    int count = 0;
    // What is no number stays 0: no shard of it is missing.
    std::from_chars(text.data(), text.data() + text.size(), count);
    for (int i = 1; i <= count && lost.size() < kMost; ++i) {
      const std::string shard = std::to_string(i) + "/" + text;
      if (!seen.contains(shard)) lost.push_back(shard);
    }
  }
  return lost;
}

}  // namespace

MergeResult merge_database(Database& into, const std::filesystem::path& from) {
  // The file is checked as for reading, digests and all, by a connection of its own.
  const Database checked = Database::open_for_reading(from);
  std::error_code error;
  if (std::filesystem::equivalent(from, into.path(), error))
    refuse_file(from, "is the file to merge into");
  check_metrics(into, checked);
  MergeResult result;
  // With the flights: what is taken over is never looked at again so closely.
  check_digests(checked, true);
  {
    // In a block: detached before anything is looked at again.
    const Attached attached(into, checked);
    Transaction transaction(into.handle(), into.path());
    // Again, for the file as it is attached now: another one may have taken its place.
    check_objects(into.handle(), from, "shard", Extras::none);
    check_columns(into.handle(), from, "shard");
    check_agreement(into, checked);
    try {
      take_runs(into);
      take_sweeps(into);
      take_rows(into, checked);
      check_added_flights(into, checked);
    } catch (const InputError&) {
      // A row that breaks a constraint is the file's fault, not the disk's.
      if ((sqlite3_errcode(into.handle()) & 0xff) != SQLITE_CONSTRAINT) throw;
      refuse_file(from, std::string("damaged: its rows contradict each other (") +
                            sqlite3_errmsg(into.handle()) + "); nothing was merged");
    }
    result.trials = count_of(into, "SELECT count(*) FROM shard.trials");
    result.new_trials = count_of(into, "SELECT count(*) FROM temp.added");
    execute(into.handle(), into.path(),
            "DROP TABLE temp.added; DROP TABLE temp.run_of; DROP TABLE temp.sweep_of;");
    into.remake_views();
    transaction.commit();
  }
  into.require_in_place();
  return result;
}

std::vector<SweepCompleteness> sweep_completeness(const Database& database) {
  std::vector<SweepCompleteness> all;
  for (const SweepInfo& sweep : database.read_sweeps()) {
    const nlohmann::json spec = stored_sweep(sweep.spec_json);  // as read_sweeps() checked it
    const nlohmann::json axes = spec.value("axes", nlohmann::json::array());
    SweepCompleteness one{.name = sweep.name,
                          .revision = sweep.revision,
                          .wanted = 0,
                          .flown = sweep.trial_count,
                          .shards = {},
                          .lost_shards = {}};
    const auto planners =
        static_cast<std::int64_t>(spec.value("planners", nlohmann::json::array()).size());
    // Planners × missions per map × values of every axis, the maps' seeds among them.
    one.wanted = planners * spec.value("trials", std::int64_t{0});
    for (const nlohmann::json& axis : axes) {
      one.wanted *= static_cast<std::int64_t>(axis.at("values").size());
    }
    // Where missions are listed, maps have unlike numbers of them: the spec says the sum.
    one.wanted = spec.value("trial_count", one.wanted);
    // An invalid mission of a map is one of every combination of the axes that leave the map alone.
    std::int64_t per_mission = planners;
    for (const nlohmann::json& axis : axes) {
      if (!makes_maps(axis.at("path").get_ref<const std::string&>())) {
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
