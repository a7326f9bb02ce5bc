#include <gtest/gtest.h>

#include "store/merge.hpp"
#include "store/row_digest.hpp"
#include "store/run_sql.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;  // NOLINT(google-build-using-namespace): a test's own rows
using test::has;
using test::message_of;
using test::run_sql;

WhatIfRow what_if_row(const TrialRow& trial, const std::string& change, Outcome outcome) {
  return {.trial_key = trial.key,
          .change = change,
          .outcome = outcome,
          .reason = "reached the goal after 3.20 s",
          .end_time_s = 3.2,
          .program_version = "0.1.0 abcdef",
          .planner_digest = key_of("planner"),
          .record_digest = key_of("record")};
}

const TrialRow& flown() {
  static const TrialRow row = trial_row("a", 0, 0, Outcome::collided);
  return row;
}

/// A file with a trial and what became of it with each of these changes.
void write_answers(const std::filesystem::path& file, const std::vector<WhatIfRow>& rows) {
  Database db = begun(file);
  db.add_trial(flown());
  for (const WhatIfRow& row : rows) db.add_what_if(row);
}

TEST(WhatIfRows, ComeBackByTrialAndChange) {
  const TemporaryFolder folder;
  const WhatIfRow wind = what_if_row(flown(), "no_wind", Outcome::reached_goal);
  const WhatIfRow depth = what_if_row(flown(), "true_depth", Outcome::collided);
  write_answers(folder / "w.db", {depth, wind});
  EXPECT_EQ(Database::open_for_reading(folder / "w.db").read_what_ifs(),
            (std::vector<WhatIfRow>{wind, depth}));
  // Another answer takes the place of the one before.
  WhatIfRow again = wind;
  again.outcome = Outcome::timed_out;
  Database::open_for_run(folder / "w.db", kMetrics).add_what_if(again);
  EXPECT_EQ(Database::open_for_reading(folder / "w.db").read_what_ifs(),
            (std::vector<WhatIfRow>{again, depth}));
  // Of no trial that is there.
  WhatIfRow lost = wind;
  lost.trial_key = key_of("no such trial");
  Database db = Database::open_for_run(folder / "w.db", kMetrics);
  EXPECT_NE(message_of([&] { db.add_what_if(lost); }), "");
}

TEST(WhatIfRows, ShowEveryChange) {
  const TemporaryFolder folder;
  for (const std::string change :
       {"outcome = 'timed_out'", "reason = ''", "end_time_s = 3.3", "end_time_s = NULL",
        "program_version = '0'", "planner_digest = 'x'", "record_digest = 'x'", "row_digest = 'x'",
        "change = 'no_latency'"}) {
    std::filesystem::remove(folder / "c.db");
    write_answers(folder / "c.db", {what_if_row(flown(), "no_wind", Outcome::reached_goal)});
    run_sql(folder / "c.db", "UPDATE what_ifs SET " + change);
    const Database db = Database::open_for_reading(folder / "c.db");
    EXPECT_TRUE(has(message_of([&] { db.read_what_ifs(); }), "damaged: table what_ifs, row "))
        << change;
    EXPECT_TRUE(has(message_of([&] { check_digests(db, false); }), "what_ifs")) << change;
  }
}

TEST(WhatIfRows, ARowWithoutItsTrialIsFound) {
  const TemporaryFolder folder;
  write_answers(folder / "t.db", {what_if_row(flown(), "no_wind", Outcome::reached_goal)});
  run_sql(folder / "t.db", "UPDATE what_ifs SET trial_key = 'gone'");
  EXPECT_TRUE(has(message_of([&] { Database::open_for_reading(folder / "t.db"); }), "what_ifs"));
}

TEST(WhatIfRows, MergeTakesThemOverAndRefusesOthers) {
  const TemporaryFolder folder;
  const WhatIfRow wind = what_if_row(flown(), "no_wind", Outcome::reached_goal);
  const WhatIfRow depth = what_if_row(flown(), "true_depth", Outcome::collided);
  write_answers(folder / "into.db", {wind});
  write_answers(folder / "from.db", {wind, depth});
  {
    Database into = Database::open_for_run(folder / "into.db", kMetrics);
    merge_database(into, folder / "from.db");
    EXPECT_EQ(into.read_what_ifs(), (std::vector<WhatIfRow>{wind, depth}));
  }
  // Flown by another planner's file or program: ours stays.
  WhatIfRow other = wind;
  other.outcome = Outcome::timed_out;
  other.planner_digest = key_of("another planner");
  write_answers(folder / "other.db", {other});
  {
    Database into = Database::open_for_run(folder / "into.db", kMetrics);
    merge_database(into, folder / "other.db");
    EXPECT_EQ(into.read_what_ifs(), (std::vector<WhatIfRow>{wind, depth}));
  }
  // By the same ones it must have come out the same.
  other.planner_digest = wind.planner_digest;
  write_answers(folder / "wrong.db", {other});
  Database into = Database::open_for_run(folder / "into.db", kMetrics);
  EXPECT_TRUE(has(message_of([&] { merge_database(into, folder / "wrong.db"); }),
                  "holds the what-if of trial"));
}

}  // namespace
}  // namespace avoidbench
