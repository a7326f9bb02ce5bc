#include "page/comparison_page.hpp"

#include <gtest/gtest.h>

#include "page/page_text.hpp"
#include "support/sample_rows.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

/// A database of one planner on one map, with a trial of each outcome.
void write_database(const std::filesystem::path& file, const std::vector<Outcome>& outcomes) {
  Database database = sample_rows::begun(file, 0);
  database.add_map(sample_rows::map_row(0, static_cast<int>(outcomes.size())), "forest");
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const int mission = static_cast<int>(i);
    TrialRow row = sample_rows::trial_row("a", 0, mission, outcomes[i]);
    TrialSpec spec;
    spec.mission_index = mission;
    row.spec_json = trial_json(spec);
    database.add_trial(row);
  }
}

/// The page of b.db against a.db, `has_base` with the flights of a.db.
ordered_json compared_page(const std::filesystem::path& folder, std::size_t limit_bytes,
                           bool has_base = true) {
  const TablePair tables = read_tables(folder / "a.db", folder / "b.db", "");
  CompareSettings settings;
  settings.metrics = {"mission_progress_pct"};
  const Comparison comparison = compare_tables(tables.base, tables.now, settings);
  const Database base = Database::open_for_reading(folder / "a.db");
  const Database now = Database::open_for_reading(folder / "b.db");
  const ComparedSide of_base{.table = &tables.base,
                             .database = {.database = has_base ? &base : nullptr, .files = {}}};
  const ComparedSide of_now{.table = &tables.now, .database = {.database = &now, .files = {}}};
  return comparison_page(comparison, of_base, of_now, {}, limit_bytes);
}

constexpr Outcome kGood = Outcome::reached_goal, kHit = Outcome::collided,
                  kLate = Outcome::timed_out;

TEST(ComparisonPage, HasEveryPairByWhatBecameOfItWithBothFlights) {
  const sample_rows::TemporaryFolder folder;
  // Alike, won, lost, failed otherwise, failed alike.
  write_database(folder / "a.db", {kGood, kHit, kGood, kHit, kLate});
  write_database(folder / "b.db", {kGood, kGood, kHit, kLate, kLate});
  const ordered_json page = compared_page(folder.path(), 10'000'000);
  EXPECT_EQ(page["kind"], "comparison");
  const auto id = [](Outcome outcome) { return static_cast<int>(outcome); };
  EXPECT_EQ(page["pairs"]["rows"], (ordered_json{{0, 0, 2, id(kGood), id(kHit)},
                                                 {0, 0, 1, id(kHit), id(kGood)},
                                                 {0, 0, 3, id(kHit), id(kLate)},
                                                 {0, 0, 4, id(kLate), id(kLate)},
                                                 {0, 0, 0, id(kGood), id(kGood)}}));
  EXPECT_EQ(page["comparison"]["planners"][0]["lost_count"], 1);
  EXPECT_EQ(page["comparison"]["metrics"].size(), 2U);
  EXPECT_TRUE(page["comparison"]["no_flights"].empty());
  // The trials' keys are the same in both files: each flight is that of its side.
  ASSERT_EQ(page["flights"].size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const ordered_json& flight = page["flights"][i];
    const std::size_t place = i % 2 == 0 ? 3 : 4;
    EXPECT_EQ(flight["pair"], i / 2);
    EXPECT_EQ(flight["side"], i % 2 == 0 ? "base" : "new");
    const std::size_t outcome = page["pairs"]["rows"][i / 2][place];
    EXPECT_EQ(flight["head"]["outcome"], page["pairs"]["outcomes"][outcome]);
  }
  EXPECT_EQ(page["worlds"].size(), 1U);
  EXPECT_EQ(page["flights_left_out"], 0);
}

TEST(ComparisonPage, APairIsThereWholeOrNotAtAll) {
  const sample_rows::TemporaryFolder folder;
  const std::vector<Outcome> outcomes(40, kGood);
  write_database(folder / "a.db", outcomes);
  write_database(folder / "b.db", outcomes);
  const ordered_json whole = compared_page(folder.path(), 10'000'000);
  ASSERT_EQ(whole["flights"].size(), 80U);
  // Every size between that of no flight and that of a few.
  const std::size_t beside = size_in_page(whole) - size_in_page(whole["flights"]) + 8000;
  std::size_t most = 0;
  for (std::size_t limit = beside; limit < beside + 4000; limit += 400) {
    const ordered_json page = compared_page(folder.path(), limit);
    EXPECT_LE(size_in_page(page), limit);
    const std::size_t shown = page["flights"].size();
    EXPECT_EQ(shown % 2, 0U);
    EXPECT_EQ(page["flights_left_out"], 80 - shown);
    EXPECT_EQ(page["pairs"]["rows"].size(), 40U);
    most = std::max(most, shown);
  }
  EXPECT_GT(most, 0U);
  EXPECT_LT(most, 80U);
}

TEST(ComparisonPage, ASideWithoutADatabaseHasNoFlightsAndIsNamed) {
  const sample_rows::TemporaryFolder folder;
  write_database(folder / "a.db", {kGood, kHit});
  write_database(folder / "b.db", {kHit, kHit});
  const ordered_json page = compared_page(folder.path(), 10'000'000, false);
  EXPECT_EQ(page["comparison"]["no_flights"], ordered_json::array({"base"}));
  ASSERT_EQ(page["flights"].size(), 2U);
  for (const ordered_json& flight : page["flights"]) EXPECT_EQ(flight["side"], "new");
}

}  // namespace
}  // namespace avoidbench
