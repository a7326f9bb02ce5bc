#include "store/row_digest.hpp"

#include <algorithm>
#include <set>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/trial_table.hpp"

namespace avoidbench {
namespace {

// These say where and how often a trial was flown, not what came of it: merge renumbers runs.
constexpr std::string_view kOfTheFile[] = {"attempt", "run_id", "row_digest"};

/// Our columns of trials and those of metrics that the digest covers, by name.
std::vector<std::string> digested_columns(const Database& db) {
  std::vector<std::string> columns = columns_of("trials");
  for (const MetricRow& metric : db.metrics()) columns.push_back(metric.name);
  std::erase_if(columns, [](const std::string& column) {
    return std::find(std::begin(kOfTheFile), std::end(kOfTheFile), column) != std::end(kOfTheFile);
  });
  // By name, since files that grew by ALTER TABLE have them in another order.
  std::sort(columns.begin(), columns.end());
  return columns;
}

/// The trials, or one: row_digest and flight_digest, then what row_digest covers.
std::string row_query(const std::vector<std::string>& columns, bool is_of_one) {
  std::string sql = "SELECT trial_key, row_digest, flight_digest";
  for (const std::string& column : columns) sql += ", " + sql_name(column);
  return sql + " FROM trials" + (is_of_one ? " WHERE trial_key = ?" : "");
}

constexpr int kFirstColumn = 3;

/// Name, type and bytes of each value that is not NULL, one after the other. `bytes` is a buffer to
/// use again.
std::string row_digest(const Statement& row, const std::vector<std::string>& columns,
                       std::string& bytes) {
  bytes.clear();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    row.append_value(columns[i], kFirstColumn + static_cast<int>(i), bytes);
  }
  return Digest().add(bytes).hex();
}

/// What flight_digest covers of each trial, or of one: the counts and digests, then its events.
class FlightDigests {
 public:
  FlightDigests(const Database& db, bool is_of_one)
      : flights_(db.handle(), db.path(),
                 std::string("SELECT t.trial_key, r.sample_count, r.samples_digest, c.call_count, "
                             "c.calls_digest FROM trials t LEFT JOIN trajectories r USING "
                             "(trial_key) LEFT JOIN plan_calls c USING (trial_key)") +
                     // The order in which check_digests() goes through the rows: both walk side by
                     // side, and no flight is looked up by its key.
                     (is_of_one ? " WHERE t.trial_key = ?" : " ORDER BY t.rowid")),
        events_(db.handle(), db.path(),
                "SELECT event_index, kind, time_s, speed_mps, obstacle_index, obstacle_kind FROM "
                "events WHERE trial_key = ? ORDER BY event_index") {}

  FlightDigests& of(std::string_view key) {
    flights_.reset().bind_text(key);
    return *this;
  }

  /// The digest of the next trial, and its key; false after the last.
  bool next(std::string& key, std::string& digest) {
    if (!flights_.step()) return false;
    key = flights_.text(0);
    bytes_.clear();
    for (int i = 1; i < flights_.column_count(); ++i) {
      flights_.append_value(flights_.column_name(i), i, bytes_);
    }
    events_.reset().bind_text(key);
    while (events_.step()) {
      for (int i = 0; i < events_.column_count(); ++i) {
        events_.append_value(events_.column_name(i), i, bytes_);
      }
    }
    digest = Digest().add(bytes_).hex();
    return true;
  }

 private:
  Statement flights_, events_;
  std::string bytes_;
};

void check_row(const Statement& row, const std::vector<std::string>& columns, std::string& bytes) {
  if (row.is_null(1)) row.damaged("it has no row_digest: it was removed");
  if (row.text(1) == row_digest(row, columns, bytes)) return;
  row.damaged("its values are not those that were stored (row_digest)");
}

void check_flight(const Statement& row, const std::string& digest) {
  if (row.text(2) == digest) return;
  row.damaged(
      "its trajectory, plan calls or events are not those that were stored "
      "(flight_digest)");
}

/// A table whose rows have a row_digest over their other columns.
struct DigestedTable {
  explicit DigestedTable(std::string table_name)
      : name(std::move(table_name)), columns(columns_of(name)) {
    std::erase(columns, "row_digest");
    // By name, as in trials.
    std::sort(columns.begin(), columns.end());
  }

  /// All rows: row_digest, then what it covers.
  std::string query() const {
    std::string sql = "SELECT row_digest";
    for (const std::string& column : columns) sql += ", " + sql_name(column);
    return sql + " FROM " + name;
  }
  int at(std::string_view column) const {
    return 1 +
           static_cast<int>(std::find(columns.begin(), columns.end(), column) - columns.begin());
  }
  std::string digest(const Statement& row) const {
    std::string bytes;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      row.append_value(columns[i], 1 + static_cast<int>(i), bytes);
    }
    return Digest().add(bytes).hex();
  }
  void check(const Statement& row) const {
    if (row.text(0) == digest(row)) return;
    row.damaged("its values are not those that were stored (row_digest)");
  }
  /// Writes the digest of the row as it is stored: a text may have been made UTF-8.
  void write_digest(const Database& db, const std::string& key,
                    const std::vector<std::string_view>& key_values) const {
    std::string written;
    {
      Statement stored(db.handle(), db.path(), query() + " WHERE " + key);
      for (const std::string_view value : key_values) stored.bind_text(value);
      stored.step();
      written = digest(stored);
    }
    Statement write(db.handle(), db.path(), "UPDATE " + name + " SET row_digest = ? WHERE " + key);
    write.bind_text(written);
    for (const std::string_view value : key_values) write.bind_text(value);
    write.run();
  }

  std::string name;
  std::vector<std::string> columns;
};

}  // namespace

/// flight_digest first: row_digest covers it.
void write_digests(const Database& db, std::string_view trial_key) {
  std::string key, digest, bytes;
  FlightDigests(db, true).of(trial_key).next(key, digest);
  Statement flight(db.handle(), db.path(),
                   "UPDATE trials SET flight_digest = ? WHERE trial_key = ?");
  flight.bind_text(digest).bind_text(trial_key).run();
  const std::vector<std::string> columns = digested_columns(db);
  {
    Statement row(db.handle(), db.path(), row_query(columns, true));
    row.bind_text(trial_key).step();
    digest = row_digest(row, columns, bytes);
  }
  Statement write(db.handle(), db.path(), "UPDATE trials SET row_digest = ? WHERE trial_key = ?");
  write.bind_text(digest).bind_text(trial_key).run();
}

void check_digests(const Database& db, bool flights) {
  db.read_what_ifs();  // each checks its own
  db.read_explanations();
  db.read_planners();
  const std::vector<std::string> columns = digested_columns(db);
  Statement row(db.handle(), db.path(),
                row_query(columns, false) + (flights ? " ORDER BY rowid" : ""));
  row.rows_of("trials");
  FlightDigests flight_digests(db, false);
  std::string bytes, key, digest;
  while (row.step()) {
    // As many flights as rows, unless a joined table has a key twice.
    if (flights && !flight_digests.next(key, digest)) row.damaged("it is stored twice");
    check_row(row, columns, bytes);
    if (flights) check_flight(row, digest);
  }
}

std::int64_t check_all(const Database& db) {
  Statement pages(db.handle(), db.path(), "PRAGMA integrity_check(1)");
  pages.step();
  const std::string answer = pages.free_text(0);
  if (answer != "ok") refuse_file(db.path(), "damaged (" + answer + ")");
  check_digests(db, true);
  TrialReader reader(db);
  const std::set<std::string> keys = db.finished_keys();
  for (const std::string& key : keys) reader.read(key);
  return static_cast<std::int64_t>(keys.size());
}

struct TrialDigests::Statements {
  explicit Statements(const Database& db)
      : columns(digested_columns(db)),
        row(db.handle(), db.path(), row_query(columns, true)),
        flights(db, true) {
    row.rows_of("trials");
  }

  std::vector<std::string> columns;
  Statement row;
  FlightDigests flights;
};

TrialDigests::TrialDigests(const Database& db) : statements_(std::make_unique<Statements>(db)) {}
TrialDigests::~TrialDigests() = default;

void TrialDigests::check(std::string_view trial_key) {
  Statement& row = statements_->row.reset().bind_text(trial_key);
  if (!row.step()) return;
  std::string bytes, key, digest;
  check_row(row, statements_->columns, bytes);
  statements_->flights.of(trial_key).next(key, digest);
  check_flight(row, digest);
}

void Database::add_what_if(const WhatIfRow& row) {
  Transaction transaction(handle(), path());
  Statement insert(handle(), path(),
                   "INSERT OR REPLACE INTO what_ifs (trial_key, change, outcome, reason, "
                   "end_time_s, program_version, planner_digest, record_digest, row_digest) VALUES "
                   "(?,?,?,?,?,?,?,?,'')");
  insert.bind_text(row.trial_key).bind_text(row.change).bind_text(text(row.outcome));
  insert.bind_text(row.reason).bind_real(row.end_time_s).bind_text(row.program_version);
  insert.bind_text(row.planner_digest).bind_text(row.record_digest).run();
  DigestedTable("what_ifs")
      .write_digest(*this, "trial_key = ? AND change = ?", {row.trial_key, row.change});
  transaction.commit();
  require_in_place();
}

std::vector<WhatIfRow> Database::read_what_ifs() const {
  const DigestedTable table("what_ifs");
  Statement s(handle(), path(), table.query() + " ORDER BY trial_key, change");
  s.rows_of(table.name, table.at("trial_key"));
  std::vector<WhatIfRow> rows;
  while (s.step()) {
    table.check(s);
    const auto outcome = enum_from_text<Outcome>(s.text(table.at("outcome")));
    if (!outcome) s.damaged("this avoidbench does not know such an outcome");
    rows.push_back({.trial_key = s.text(table.at("trial_key")),
                    .change = s.text(table.at("change")),
                    .outcome = *outcome,
                    .reason = s.free_text(table.at("reason")),
                    .end_time_s = s.real(table.at("end_time_s")),
                    .program_version = s.free_text(table.at("program_version")),
                    .planner_digest = s.text(table.at("planner_digest")),
                    .record_digest = s.text(table.at("record_digest"))});
  }
  return rows;
}

void Database::add_explanation(const ExplanationRow& row) {
  Transaction transaction(handle(), path());
  Statement insert(handle(), path(),
                   "INSERT OR REPLACE INTO explanations (trial_key, cause, facts_json, "
                   "rules_version, record_digest, row_digest) VALUES (?,?,?,?,?,'')");
  insert.bind_text(row.trial_key).bind_text(row.cause).bind_text(row.facts_json);
  insert.bind_integer(row.rules_version).bind_text(row.record_digest).run();
  DigestedTable("explanations").write_digest(*this, "trial_key = ?", {row.trial_key});
  transaction.commit();
  require_in_place();
}

std::vector<ExplanationRow> Database::read_explanations() const {
  const DigestedTable table("explanations");
  Statement s(handle(), path(), table.query() + " ORDER BY trial_key");
  s.rows_of(table.name, table.at("trial_key"));
  std::vector<ExplanationRow> rows;
  while (s.step()) {
    table.check(s);
    rows.push_back({.trial_key = s.text(table.at("trial_key")),
                    .cause = s.text(table.at("cause")),
                    .facts_json = s.text(table.at("facts_json")),
                    .rules_version = s.integer(table.at("rules_version")),
                    .record_digest = s.text(table.at("record_digest"))});
  }
  return rows;
}

}  // namespace avoidbench
