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

ExplanationRow explanation_row(const std::string& cause) {
  return {.trial_key = trial_row("a", 0, 0, Outcome::collided).key,
          .cause = cause,
          .facts_json = R"({"contact_s":3.25})",
          .rules_version = 1,
          .record_digest = key_of("record")};
}

/// A file with a failed trial and why it failed.
void write_told(const std::filesystem::path& file, const std::string& cause) {
  Database db = begun(file);
  db.add_trial(trial_row("a", 0, 0, Outcome::collided));
  db.add_explanation(explanation_row(cause));
}

TEST(ExplanationRows, ComeBackAndAreReplaced) {
  const TemporaryFolder folder;
  write_told(folder / "e.db", "occluded");
  Database db = Database::open_for_run(folder / "e.db", kMetrics);
  EXPECT_EQ(db.read_explanations(), std::vector{explanation_row("occluded")});
  db.add_explanation(explanation_row("tracking"));
  EXPECT_EQ(db.read_explanations(), std::vector{explanation_row("tracking")});
  ExplanationRow lost = explanation_row("tracking");
  lost.trial_key = key_of("no such trial");
  EXPECT_NE(message_of([&] { db.add_explanation(lost); }), "");
}

TEST(ExplanationRows, AreWhatReportsAndListsSay) {
  const TemporaryFolder folder;
  write_told(folder / "e.db", "occluded");
  const Database db = Database::open_for_reading(folder / "e.db");
  EXPECT_EQ(db.read_sweep("forest", 1).trials.front().cause, "occluded");
  EXPECT_EQ(std::get<std::string>(db.list_trials({"cause"}).front().fields.front()), "occluded");
}

TEST(ExplanationRows, ShowEveryChange) {
  const TemporaryFolder folder;
  for (const std::string change :
       {"cause = 'trap'", "facts_json = '{}'", "rules_version = 2", "record_digest = 'x'"}) {
    std::filesystem::remove(folder / "c.db");
    write_told(folder / "c.db", "occluded");
    run_sql(folder / "c.db", "UPDATE explanations SET " + change);
    const Database db = Database::open_for_reading(folder / "c.db");
    EXPECT_TRUE(
        has(message_of([&] { check_digests(db, false); }), "damaged: table explanations, row "))
        << change;
  }
}

TEST(ExplanationRows, MergeTakesThemOverAndRefusesOthers) {
  const TemporaryFolder folder;
  write_told(folder / "told.db", "occluded");
  write_told(folder / "other.db", "tracking");
  {
    Database into = begun(folder / "into.db");
    merge_database(into, folder / "told.db");
    EXPECT_EQ(into.read_explanations(), std::vector{explanation_row("occluded")});
  }
  // By the same rules of the same flight it must be the same cause.
  Database into = Database::open_for_run(folder / "into.db", kMetrics);
  EXPECT_TRUE(has(message_of([&] { merge_database(into, folder / "other.db"); }),
                  "holds the explanation of trial"));
}

}  // namespace
}  // namespace avoidbench
