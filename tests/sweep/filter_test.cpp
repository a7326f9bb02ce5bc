#include <gmock/gmock.h>

#include "base/kept_files.hpp"
#include "support/flown_again.hpp"
#include "support/small_sweep.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

const std::string kFilter = std::string(PLANNERS) + "/slow_down.so";

PluginChoice slow_down(double share, const std::string& way = "honest") {
  const PlannerDescription filter = PlannerLibrary::load(kFilter).description();
  PluginChoice choice;
  choice.plugin = choice.file = kFilter;
  choice.label = filter.name;
  choice.file_digest = filter.file_digest;
  choice.needs = filter.needs;
  choice.parameters = {{.name = "share", .number = share, .text = {}},
                       {.name = "way", .number = 0.0, .text = way, .is_text = true}};
  return choice;
}

/// One hall, two missions, flown straight with the filter.
class FilterSweep : public test::SweepTest {
 protected:
  static SweepSpec sweep_with(const PluginChoice& filter) {
    SweepSpec sweep = test::small_sweep();
    sweep.axes = {{.path = "map_seed", .values = {1}}};
    sweep.planners.resize(1);
    sweep.planners[0].filter = filter;
    sweep.planners[0].label += " + " + filter.label;
    return sweep;
  }

  std::vector<TrialRecord> records(const std::string& file) const {
    const Database database = Database::open_for_reading(folder_ / file);
    std::vector<TrialRecord> all;
    for (const TrialListing& trial : database.list_trials()) {
      all.push_back(read_stored_trial(database, trial.key).row.record);
    }
    return all;
  }

  static double most_speed_mps(const TrialRecord& record) {
    double most_mps = 0.0;
    for (const Sample& sample : record.samples) {
      most_mps = std::max(most_mps, sample.velocity_world.norm());
    }
    return most_mps;
  }

  test::FlownAgain replayed(const std::string& file) const {
    const Database database = Database::open_for_reading(folder_ / file);
    ReplayFiles files;
    files.database = folder_ / file;
    return test::flown_again(read_stored_trial(database, database.list_trials().at(0).key), files);
  }
};

TEST_F(FilterSweep, RowsAreTheSameWithOneWorkerAndWithTwo) {
  const SweepSpec sweep = sweep_with(slow_down(0.5));
  run(sweep, "one.db", 1);
  const std::string one = rows_;
  run(sweep, "two.db", 2);
  EXPECT_EQ(rows_, one);
  run(sweep, "here.db", 1, true);
  EXPECT_EQ(rows_, one);
  EXPECT_NE(one.find("straight_line + slow_down"), std::string::npos);
}

TEST_F(FilterSweep, WhatTheFilterAnswersIsFlown) {
  run(sweep_with(slow_down(1.0)), "all.db", 1, true);
  run(sweep_with(slow_down(0.25)), "slow.db", 1, true);
  EXPECT_GT(most_speed_mps(records("all.db").at(0)), 2.5);
  EXPECT_LT(most_speed_mps(records("slow.db").at(0)), 1.0);
  SweepSpec alone = sweep_with(slow_down(1.0));
  alone.planners[0].filter.reset();
  run(alone, "alone.db", 1, true);
  // What lets all pass changes no flight.
  EXPECT_TRUE(differences(records("alone.db").at(0), records("all.db").at(0)).empty());
}

TEST_F(FilterSweep, ItsFailuresHaveItsName) {
  run(sweep_with(slow_down(1.0, "error")), "error.db", 1, true);
  EXPECT_EQ(records("error.db").at(0).outcome, Outcome::planner_error);
  EXPECT_EQ(records("error.db").at(0).reason, "filter slow_down: no solution");
  run(sweep_with(slow_down(1.0, "give_up")), "give_up.db", 1, true);
  EXPECT_EQ(records("give_up.db").at(0).outcome, Outcome::planner_gave_up);
  EXPECT_EQ(records("give_up.db").at(0).reason, "filter slow_down: too close");
  run(sweep_with(slow_down(1.0, "segfault")), "crash.db", 1);
  EXPECT_EQ(records("crash.db").at(0).outcome, Outcome::planner_crashed);
  EXPECT_THAT(records("crash.db").at(0).reason, testing::HasSubstr("slow_down.so"));
}

TEST_F(FilterSweep, NoPlanOfItsOwnBrakesWhateverWasWanted) {
  run(sweep_with(slow_down(1.0, "no_plan")), "a.db", 1, true);
  const TrialRecord record = records("a.db").at(0);
  EXPECT_EQ(record.outcome, Outcome::timed_out);
  EXPECT_EQ(record.plan_calls.at(0).status, AB_NO_PLAN);
  EXPECT_LT(most_speed_mps(record), 0.1);
}

TEST_F(FilterSweep, FliesAgainAlsoByTheCopyThatTheRunKept) {
  const fs::path mine = folder_ / "src" / "mine.so";
  fs::create_directories(mine.parent_path());
  fs::copy_file(kFilter, mine);
  PluginChoice filter = slow_down(0.5);
  filter.file = filter.plugin = mine.string();
  options_.keep_planners = true;
  run(sweep_with(filter), "a.db", 1, true);
  const test::FlownAgain same = replayed("a.db");
  EXPECT_FALSE(same.flight.is_with_kept_planner);
  EXPECT_TRUE(same.flight.warnings.empty());
  EXPECT_TRUE(same.differences().empty());
  fs::remove(mine);
  const test::FlownAgain kept = replayed("a.db");
  EXPECT_TRUE(kept.flight.is_with_kept_planner);
  EXPECT_EQ(kept.flight.job.job.spec.planner.filter->file,
            folder_ / "a.planners" / (filter.file_digest + ".so"));
  EXPECT_TRUE(kept.differences().empty());
}

TEST_F(FilterSweep, TheDatabaseNamesBoth) {
  const SweepSpec sweep = sweep_with(slow_down(0.5));
  const PlannerRow row = planner_row(sweep.planners[0]);
  EXPECT_EQ(row.label, "straight_line + slow_down");
  EXPECT_EQ(row.name, "straight_line + slow_down");
  EXPECT_EQ(row.version, "1.0 + 2");
  EXPECT_EQ(row.file_digest, flown_digest(sweep.planners[0]));
  EXPECT_THAT(row.parameters_json, testing::HasSubstr("\"filter.share\":0.5"));
  EXPECT_THAT(row.parameters_json, testing::HasSubstr("\"max_speed_mps\":3"));
}

}  // namespace
}  // namespace avoidbench
