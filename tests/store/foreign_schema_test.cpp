#include <gtest/gtest.h>

#include <set>

#include "store/merge.hpp"
#include "store/run_sql.hpp"
#include "store/trial_table.hpp"
#include "support/canonical_rows.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

/// Files whose schema is not what the program makes: by another hand, or on purpose.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::canonical_rows;
using test::has;
using test::message_of;
using test::run_sql;

/// A file with a run, sweep, planners, a map and two trials, one of which collided.
void write_sample(const std::filesystem::path& file, const std::string& label) {
  Database db = begun(file, 1);
  db.add_trial(trial_row(label, 0, 0, Outcome::reached_goal));
  db.add_trial(trial_row(label, 0, 1, Outcome::collided));
}

/// What `merge` says of a file that was changed by `sql`, after checking that it took nothing from
/// it and made no file.
std::string refusal_of(const std::string& sql) {
  static const TemporaryFolder samples;
  if (files_in(samples).empty()) {
    write_sample(samples / "ours.db", "a");
    write_sample(samples / "theirs.db", "b");
  }
  const TemporaryFolder folder;
  for (const char* file : {"ours.db", "theirs.db"}) copy_file(samples / file, folder / file);
  std::string with_folder = sql;
  if (const auto at = sql.find("FOLDER"); at != std::string::npos) {
    with_folder.replace(at, 6, folder.path().string());
  }
  run_sql(folder / "theirs.db", with_folder);
  const std::string before = canonical_rows(Database::open_for_reading(folder / "ours.db"));
  const std::set<std::string> files = files_in(folder);
  std::string message;
  {
    Database db = Database::open_for_run(folder / "ours.db", kMetrics);
    message = message_of([&] { merge_database(db, folder / "theirs.db"); });
  }
  EXPECT_EQ(canonical_rows(Database::open_for_reading(folder / "ours.db")), before) << sql;
  EXPECT_EQ(files_in(folder), files) << sql;
  EXPECT_EQ(message.find((folder / "theirs.db").string() + ": "), 0U) << message;
  return message;
}

TEST(ForeignSchema, SqlInTheNameOfAColumnIsRefused) {
  const std::string message = refusal_of(
      "DROP TABLE planners; CREATE TABLE planners (\"planner_key) SELECT 'x' WHERE 0; "
      "UPDATE main.trials SET outcome='reached_goal', reason=''; COMMIT; "
      "ATTACH 'FOLDER/made.db' AS made; CREATE TABLE made.t (x); --\" TEXT)");
  EXPECT_TRUE(has(message, "table planners")) << message;
  EXPECT_TRUE(has(refusal_of("ALTER TABLE maps ADD COLUMN \"x) SELECT 1; DROP TABLE main.trials; "
                             "--\" TEXT"),
                  "table maps"));
}

TEST(ForeignSchema, SqlInTheNameOfAMetricIsRefused) {
  const std::string define =
      "INSERT INTO metric_definitions SELECT 'NAME', 9, 1, unit, doc, formula, source, better, "
      "population, is_measured FROM metric_definitions LIMIT 1;";
  for (const std::string name : {"x, (SELECT 1)", "x\"; DROP TABLE main.trials; --", "outcome", "",
                                 "trial_key", "a.b", "Ü"}) {
    std::string sql = define, escaped;
    sql.replace(sql.find("NAME"), 4, name);
    for (const char c : name) escaped += c == '"' ? std::string("\"\"") : std::string(1, c);
    const bool is_column = name == "outcome" || name == "trial_key";
    if (!is_column) sql += "ALTER TABLE trials ADD COLUMN \"" + escaped + "\" REAL;";
    EXPECT_TRUE(has(refusal_of(sql), "metric_definitions")) << name;
  }
}

TEST(ForeignSchema, TriggersAndTheLikeAreRefused) {
  EXPECT_TRUE(
      has(refusal_of("CREATE TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM events; END"),
          "trigger 't'"));
  EXPECT_TRUE(has(refusal_of("CREATE VIEW mine AS SELECT 1"), "view 'mine'"));
  EXPECT_TRUE(has(refusal_of("CREATE TABLE notes (x)"), "table 'notes'"));
  EXPECT_TRUE(has(refusal_of("CREATE UNIQUE INDEX i ON trials (outcome)"), "index 'i'"));
  EXPECT_TRUE(has(refusal_of("DROP INDEX trials_by_mission; "
                             "CREATE INDEX trials_by_mission ON trials (abs(mission_index))"),
                  "index 'trials_by_mission'"));
  EXPECT_TRUE(has(refusal_of("CREATE VIRTUAL TABLE v USING fts5(x)"), "table 'v"));
}

TEST(ForeignSchema, OtherThingsUnderTheNamesOfOursAreRefused) {
  EXPECT_TRUE(has(refusal_of("ALTER TABLE planners RENAME TO notes; CREATE VIEW planners AS "
                             "SELECT * FROM notes"),
                  "planners"));
  EXPECT_TRUE(
      has(refusal_of("DROP TABLE planners; CREATE VIEW planners AS SELECT 1 AS planner_key"),
          "view 'planners'"));
  EXPECT_TRUE(has(refusal_of("DROP TABLE planners"), "lacks the table planners"));
  EXPECT_TRUE(has(refusal_of("DROP VIEW trial_table; CREATE TABLE trial_table (x)"),
                  "table 'trial_table'"));
  EXPECT_TRUE(has(refusal_of("ALTER TABLE events ADD COLUMN g TEXT GENERATED ALWAYS AS (kind)"),
                  "column 'g'"));
  EXPECT_TRUE(has(refusal_of("ALTER TABLE events RENAME COLUMN kind TO sort"), "column 'sort'"));
  EXPECT_TRUE(has(refusal_of("ALTER TABLE trials ADD COLUMN more REAL"), "column 'more'"));
  EXPECT_TRUE(
      has(refusal_of("DROP VIEW latest_trials; DROP VIEW trial_table; DROP VIEW planner_summary; "
                     "ALTER TABLE trials DROP COLUMN mission_progress_pct"),
          "mission_progress_pct"));
  EXPECT_TRUE(
      has(refusal_of("ALTER TABLE trajectories DROP COLUMN samples_digest"), "samples_digest"));
  EXPECT_TRUE(has(refusal_of("ALTER TABLE sweeps RENAME TO old; CREATE TABLE sweeps (sweep TEXT, "
                             "revision INTEGER, spec_json TEXT); INSERT INTO sweeps SELECT * FROM "
                             "old; DROP TABLE old"),
                  "table sweeps is of a different kind"));
}

TEST(ForeignSchema, ARunRefusesTriggersAndLeavesTablesApartAlone) {
  const TemporaryFolder folder;
  write_sample(folder / "r.db", "a");
  run_sql(folder / "r.db",
          "CREATE TABLE notes (x); CREATE INDEX on_notes ON notes (x); "
          "CREATE VIEW of_notes AS SELECT * FROM notes; ANALYZE");
  { EXPECT_NO_THROW(Database::open_for_run(folder / "r.db", kMetrics)); }
  EXPECT_NO_THROW(Database::open_for_reading(folder / "r.db"));
  run_sql(folder / "r.db", "CREATE TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM events; END");
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(folder / "r.db", kMetrics); }),
                  "holds the trigger 't'"));
}

TEST(ForeignSchema, TheFilesOwnViewsAreNotRead) {
  const TemporaryFolder folder;
  write_sample(folder / "r.db", "a");
  const auto outcomes = [&] {
    const Database db = Database::open_for_reading(folder / "r.db");
    const std::vector<SweepInfo> sweeps = db.read_sweeps();
    TrialTableReader rows(db, sweeps);
    const auto column = std::find(rows.columns().begin(), rows.columns().end(), "outcome");
    std::multiset<std::string> texts;
    while (rows.next()) {
      texts.insert(std::get<std::string>(
          rows.row()[static_cast<std::size_t>(column - rows.columns().begin())]));
    }
    return texts;
  };
  const std::multiset<std::string> before = outcomes();
  ASSERT_EQ(before, (std::multiset<std::string>{"collided", "reached_goal"}));
  run_sql(
      folder / "r.db",
      "ALTER TABLE main.events RENAME TO e; ALTER TABLE e RENAME TO events;"
      "CREATE TABLE copy AS SELECT * FROM trial_table; UPDATE copy SET outcome = 'reached_goal';"
      "DROP VIEW trial_table; CREATE VIEW trial_table AS SELECT * FROM copy");
  EXPECT_EQ(outcomes(), before);
}

TEST(ForeignSchema, AFileThatClaimsToBeAUriIsAFile) {
  const TemporaryFolder folder;
  write_sample(folder / "ours.db", "a");
  write_sample(folder / "x.db?mode=rwc&a=b#c", "b");
  Database db = Database::open_for_run(folder / "ours.db", kMetrics);
  EXPECT_EQ(merge_database(db, folder / "x.db?mode=rwc&a=b#c").new_trials, 2);
}

}  // namespace
}  // namespace avoidbench
