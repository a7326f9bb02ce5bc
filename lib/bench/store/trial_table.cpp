#include "store/trial_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "store/record_format.hpp"
#include "store/row_digest.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/trial_fields.hpp"
#include "trial/periods.hpp"

namespace avoidbench {
namespace {

/// A pair of parameters for each sweep.
std::string places_of(std::size_t sweep_count) {
  std::string places;
  for (std::size_t i = 0; i < sweep_count; ++i) places += i == 0 ? "(?,?)" : ",(?,?)";
  return places;
}

/// The SELECT of the view trial_table with a column for each of these axes.
std::string select_of_view(const Database& db, const std::vector<std::string>& axes) {
  constexpr std::string_view kBegin = "CREATE VIEW trial_table AS", kEnd = ";\n";
  const std::size_t begin = kViewsSql.find(kBegin);
  AB_CHECK(begin != std::string_view::npos);
  std::string_view select = kViewsSql.substr(begin + kBegin.size());
  select = select.substr(0, select.find(kEnd));
  std::string metrics = metric_columns(db);
  return with_replaced(with_replaced(std::string(select), "{metrics}", metrics), "{axes}",
                       axis_columns(db, axes));
}

std::string trial_query(const std::string& select, std::size_t sweep_count) {
  return "SELECT v.* FROM (" + select + "\n) v WHERE (v.sweep, v.revision) IN (VALUES " +
         places_of(sweep_count) +
         ") ORDER BY v.sweep, v.revision, v.planner, v.planner_key, v.map_key, v.mission_index, "
         "v.trial_key";
}

/// How many samples a flight of the spec has at most: one a period and one a period of jerks, one
/// at each end and at each goal. What the spec does not say counts as the most that any can.
std::int64_t most_samples(const std::string& spec_json) {
  constexpr double kMostTime_s = 3600.0, kMostRate_hz = 1000.0;  // trial_spec.hpp
  const auto spec = nlohmann::json::parse(spec_json, nullptr, false);
  const auto said = [&](const char* path) {
    const nlohmann::json::json_pointer at(path);
    return spec.is_object() && spec.contains(at) ? spec.at(at) : nlohmann::json();
  };
  const auto field = [&](const char* path, double most, double otherwise) {
    const nlohmann::json value = said(path);
    return value.is_number() ? std::clamp(value.get<double>(), 0.0, most) : otherwise;
  };
  double goals = field("/mission/waypoints", kMostGoals, 0.0);
  if (said("/mission/return_to_start") == true) goals += 1.0;
  // Of listed missions only the mission itself says how many goals it has.
  const nlohmann::json listed = said("/missions_digest");
  if (listed.is_string() && listed != "") goals = kMostGoals;
  return 2 + static_cast<std::int64_t>(
                 goals +
                 std::ceil(field("/mission/time_limit_s", kMostTime_s, kMostTime_s) *
                           (field("/rates/sample_hz", kMostRate_hz, kMostRate_hz) + kJerkRate_hz)));
}

/// Checked against count and digest; none for a trial without a stored flight. A count above `most`
/// is damage that is found before anything is unpacked: a few kB can inflate to gigabytes.
std::vector<Sample> read_samples(Statement& s, std::string_view key, std::int64_t most) {
  s.reset().bind_text(key);
  if (!s.step()) return {};
  if (s.integer(2) > most) {
    s.damaged("it has " + std::to_string(s.integer(2)) +
              " samples; the trial's time limit and sample rate allow " + std::to_string(most));
  }
  // Negative in a damaged file; the sizes below then contradict it.
  const auto count = static_cast<std::size_t>(std::max<std::int64_t>(0, s.integer(2)));
  const std::vector<std::byte> bytes = unpacked_samples(s.blob(1), count);
  const bool has_size = bytes.size() % (kSampleDoubles * sizeof(double)) == 0 &&
                        bytes.size() / (kSampleDoubles * sizeof(double)) == count;
  if (!has_size) s.damaged("its samples can't be unpacked");
  // The digest is of the samples, not of their packing, which may change.
  if (Digest().add_bytes(bytes).hex() != s.text(3)) {
    s.damaged("its samples are not those that were stored (samples_digest)");
  }
  return samples_from_bytes(bytes);
}

/// The same of the calls.
std::vector<PlanCall> read_plan_calls(Statement& s, std::string_view key) {
  s.reset().bind_text(key);
  if (!s.step()) return {};
  std::vector<PlanCall> calls;
  try {
    calls = plan_calls_from_json(s.text(3));
  } catch (const nlohmann::json::exception&) {
    s.damaged("calls_json is no list of plan calls");
  }
  const bool has_count = s.integer(1) == static_cast<std::int64_t>(calls.size());
  if (!has_count || plan_calls_digest(calls) != s.text(2)) {
    s.damaged("its calls are not those that were stored (calls_digest)");
  }
  return calls;
}

std::vector<Collision> read_collisions(Statement& s, std::string_view key) {
  s.reset().bind_text(key);
  std::vector<Collision> collisions;
  while (s.step()) {
    collisions.push_back({.time_s = s.real(0),
                          .speed_mps = s.real(1),
                          .obstacle = s.integer(2),
                          .kind = s.free_text(3)});
  }
  return collisions;
}

}  // namespace

TrialTableReader::TrialTableReader(const Database& database, std::span<const SweepInfo> sweeps,
                                   const std::vector<std::string>& axes)
    : statement_(
          std::make_unique<Statement>(database.handle(), database.path(),
                                      trial_query(select_of_view(database, axes), sweeps.size()))) {
  AB_CHECK(!sweeps.empty(), sweeps.size());
  for (const SweepInfo& sweep : sweeps) {
    statement_->bind_text(sweep.name).bind_integer(sweep.revision);
  }
  for (int i = 0; i < statement_->column_count(); ++i) {
    columns_.push_back(statement_->column_name(i));
  }
  const auto place_of = [&](std::string_view name) {
    return std::find(columns_.begin(), columns_.end(), name) - columns_.begin();
  };
  statement_->rows_of("trials", static_cast<int>(place_of("trial_key")));
  seed_column_ = static_cast<std::size_t>(place_of(kSeedField));
  row_.resize(columns_.size());
}

TrialTableReader::~TrialTableReader() = default;
TrialTableReader::TrialTableReader(TrialTableReader&& other) noexcept = default;
TrialTableReader& TrialTableReader::operator=(TrialTableReader&& other) noexcept = default;

bool TrialTableReader::next() {
  if (!statement_->step()) return false;
  for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = statement_->value(static_cast<int>(i));
  // SQLite's integers have a sign: a seed is stored by its bits.
  TableValue& seed = row_[seed_column_];
  if (const auto* bits = std::get_if<std::int64_t>(&seed)) {
    seed = std::bit_cast<std::uint64_t>(*bits);
  }
  return true;
}

std::vector<std::string> axis_paths(std::string_view sweep_spec_json) {
  std::vector<std::string> paths;
  // From a file of anybody's: what is no spec has no axes.
  const auto spec = nlohmann::json::parse(sweep_spec_json, nullptr, false);
  if (!spec.is_object() || !spec.contains("axes") || !spec["axes"].is_array()) return paths;
  for (const nlohmann::json& axis : spec["axes"]) {
    if (axis.contains("path") && axis["path"].is_string()) paths.push_back(axis["path"]);
  }
  return paths;
}

void visit_trials(const Database& database, std::string_view sweep, std::int64_t revision,
                  std::span<const std::string> paths,
                  const std::function<void(VisitedTrial)>& visit) {
  // Rows are found by key, all over the file: pages that several share are to stay in memory.
  execute(database.handle(), database.path(), "PRAGMA cache_size = -65536");  // KiB
  std::string columns;
  // As JSON text, so that 1 and "1" differ.
  for (std::size_t i = 0; i < paths.size(); ++i) columns += ", t.spec_json -> ?";
  for (const MetricRow& metric : database.metrics()) columns += ", t." + sql_name(metric.name);
  Statement s(
      database.handle(), database.path(),
      "SELECT t.planner_key, t.map_key, t.mission_index, t.outcome" + columns +
          ", t.trial_key, t.flight_digest, (SELECT cause FROM explanations e WHERE e.trial_key = "
          "t.trial_key) FROM sweep_trials s JOIN trials t USING (trial_key) WHERE s.sweep = ? AND "
          "s.revision = ?");
  s.rows_of("trials", 4 + static_cast<int>(paths.size() + database.metrics().size()));
  for (const std::string& path : paths) s.bind_text(sql_json_path(path));
  s.bind_text(sweep).bind_integer(revision);
  while (s.step()) {
    VisitedTrial trial;
    trial.planner_key = s.text(0);
    trial.map_key = s.text(1);
    trial.mission_index = s.integer(2);
    trial.outcome = outcome_of(s, 3);
    int column = 4;
    for (std::size_t i = 0; i < paths.size(); ++i) trial.settings.push_back(s.free_text(column++));
    trial.metrics.reserve(database.metrics().size());
    for (std::size_t i = 0; i < database.metrics().size(); ++i) {
      trial.metrics.push_back(s.real(column++));
    }
    trial.key = s.text(column);
    trial.flight_digest = s.text(column + 1);
    trial.cause = s.free_text(column + 2);
    visit(std::move(trial));
  }
}

std::vector<std::string> generators_of(const Database& database,
                                       std::span<const SweepInfo> sweeps) {
  Statement s(database.handle(), database.path(),
              "SELECT DISTINCT m.generator, m.map_key FROM sweep_trials s JOIN trials t USING "
              "(trial_key) JOIN maps m ON m.map_key = t.map_key WHERE (s.sweep, s.revision) IN "
              "(VALUES " +
                  places_of(sweeps.size()) + ") ORDER BY 1");
  s.rows_of("maps", 1);
  for (const SweepInfo& sweep : sweeps) s.bind_text(sweep.name).bind_integer(sweep.revision);
  std::vector<std::string> generators;
  while (s.step()) {
    // Sorted: equal names follow each other.
    if (generators.empty() || generators.back() != s.text(0)) generators.push_back(s.text(0));
  }
  return generators;
}

std::vector<MapFlights> read_map_flights(const Database& database, const SweepInfo& sweep) {
  std::vector<MapFlights> flights;
  Statement maps(database.handle(), database.path(),
                 "SELECT t.map_key, max(json_extract(t.spec_json, '$.mission.time_limit_s')), "
                 "coalesce(sum(t.wall_time_s), 0), m.generator, m.map_seed FROM sweep_trials s "
                 "JOIN trials t USING (trial_key) JOIN maps m ON m.map_key = t.map_key WHERE "
                 "s.sweep = ? AND s.revision = ? GROUP BY t.map_key ORDER BY 4, 5, 1");
  maps.rows_of("maps").bind_text(sweep.name).bind_integer(sweep.revision);
  while (maps.step()) {
    flights.push_back({.map_key = maps.text(0),
                       .first_run = {},
                       .time_limit_s = maps.real(1),
                       .wall_time_s = maps.real(2)});
  }
  // The first run that flew on the map; later ones may have added to it.
  Statement run(
      database.handle(), database.path(),
      "SELECT r.started_at, r.program_version, r.git_hash, r.compiler, r.flags, r.host, "
      "r.cpu, r.isa, r.command_line, r.shard, r.sandbox FROM trials t JOIN sweep_trials s USING "
      "(trial_key) JOIN runs r USING (run_id) WHERE t.map_key = ? AND s.sweep = ? AND "
      "s.revision = ? ORDER BY r.started_at, r.run_id LIMIT 1");
  for (MapFlights& map : flights) {
    run.bind_text(map.map_key).bind_text(sweep.name).bind_integer(sweep.revision);
    if (run.step()) {
      map.first_run = {.started_at = run.free_text(0),
                       .program_version = run.free_text(1),
                       .git_hash = run.free_text(2),
                       .compiler = run.free_text(3),
                       .flags = run.free_text(4),
                       .host = run.free_text(5),
                       .cpu = run.free_text(6),
                       .isa = run.free_text(7),
                       .command_line = run.free_text(8),
                       .shard = run.free_text(9),
                       .sandbox = run.free_text(10)};
    }
    run.run();
  }
  return flights;
}

struct TrialReader::Statements {
  explicit Statements(const Database& db)
      : row(db.handle(), db.path(),
            // A trial may belong to several sweeps: any one, but always the same.
            "SELECT t.trial_key, (SELECT min(sweep) FROM sweep_trials x WHERE x.trial_key = "
            "t.trial_key), t.map_key, p.label, p.file_digest, t.mission_index, t.spec_json, "
            "t.outcome, t.reason, t.end_time_s, t.wall_time_s" +
                metric_columns(db) +
                " FROM trials t JOIN planners p USING (planner_key) WHERE t.trial_key = ?"),
        samples(db.handle(), db.path(),
                "SELECT trial_key, samples, sample_count, samples_digest FROM "
                "trajectories WHERE trial_key = ?"),
        plan_calls(db.handle(), db.path(),
                   "SELECT trial_key, call_count, calls_digest, calls_json FROM plan_calls WHERE "
                   "trial_key = ?"),
        collisions(db.handle(), db.path(),
                   "SELECT time_s, speed_mps, obstacle_index, obstacle_kind, trial_key FROM events "
                   "WHERE trial_key = ? AND kind = 'collision' ORDER BY event_index"),
        digests(db) {
    row.rows_of("trials");
    samples.rows_of("trajectories");
    plan_calls.rows_of("plan_calls");
    collisions.rows_of("events", 4);
  }

  Statement row, samples, plan_calls, collisions;
  TrialDigests digests;
};

TrialReader::TrialReader(const Database& database)
    : database_(&database), statements_(std::make_unique<Statements>(database)) {}
TrialReader::TrialReader(TrialReader&& other) noexcept = default;
TrialReader::~TrialReader() = default;

std::optional<TrialRow> TrialReader::read(std::string_view key) {
  Statement& s = statements_->row.reset().bind_text(key);
  if (!s.step()) return std::nullopt;
  TrialRow row;
  row.key = s.text(0);
  row.sweep = s.text(1);
  row.map_key = s.text(2);
  row.planner_label = s.text(3);
  row.planner_file_digest = s.text(4);
  row.mission_index = s.integer(5);
  row.spec_json = s.text(6);
  row.record.outcome = outcome_of(s, 7);
  row.record.reason = s.free_text(8);
  row.record.end_time_s = s.real(9);
  row.wall_time_s = s.real(10);
  row.metrics = metrics_of(*database_, s, 11);
  // Only one trial: its flight is looked at too.
  statements_->digests.check(key);
  row.record.samples = read_samples(statements_->samples, key, most_samples(row.spec_json));
  row.record.plan_calls = read_plan_calls(statements_->plan_calls, key);
  row.record.collisions = read_collisions(statements_->collisions, key);
  return row;
}

}  // namespace avoidbench
