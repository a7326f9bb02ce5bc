#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "replay/provenance.hpp"
#include "replay/sample.hpp"
#include "support/sample_rows.hpp"
#include "support/small_sweep.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/run_estimate.hpp"
#include "sweep/shard.hpp"

namespace avoidbench {
namespace {

/// Environment variables of an array task, gone when the test ends.
class ArrayTask {
 public:
  void set(const char* name, const char* value) {
    names_.push_back(name);
    ::setenv(name, value, 1);
  }
  ~ArrayTask() {
    for (const char* name : names_) ::unsetenv(name);
  }

 private:
  std::vector<const char*> names_;
};

std::string shard(const std::string& given) { return text(shard_from(given)); }

TEST(Shard, IsReadAndWritten) {
  EXPECT_EQ(shard("2/3"), "2/3");
  EXPECT_EQ(shard("1/1"), "");
  for (const char* wrong : {"", "0/3", "4/3", "2", "2/0", "x/3", "1/3x", "auto/x", "-1/3"}) {
    EXPECT_THROW(shard(wrong), InputError) << wrong;
  }
}

TEST(Shard, AutoIsTheTaskOfAnArray) {
  {
    ArrayTask slurm;
    slurm.set("SLURM_ARRAY_TASK_ID", "11");
    slurm.set("SLURM_ARRAY_TASK_MIN", "10");
    slurm.set("SLURM_ARRAY_TASK_COUNT", "4");
    EXPECT_EQ(shard("auto"), "2/4");
    EXPECT_EQ(shard("auto/4"), "2/4");
    EXPECT_EQ(shard("auto/20"), "11/20");  // tasks of a larger array, flown again
  }
  {
    ArrayTask kubernetes;
    kubernetes.set("JOB_COMPLETION_INDEX", "0");
    EXPECT_EQ(shard("auto/3"), "1/3");
    EXPECT_THROW(shard("auto"), InputError);  // how many there are is not said
  }
  EXPECT_THROW(shard("auto/3"), InputError);  // no array at all
}

TEST(Sample, SharesAreReadInBothWays) {
  EXPECT_EQ(share_from("1%"), 0.01);
  EXPECT_EQ(share_from("0.25"), 0.25);
  EXPECT_EQ(share_from("1"), 1.0);
  for (const char* wrong : {"", "%", "0", "0%", "101%", "1.5", "x", "5 %", "nan", "-1%"}) {
    EXPECT_THROW(share_from(wrong), InputError) << wrong;
  }
}

TEST(Sample, ALargerOneHasAllOfASmallerOne) {
  int tenth = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string key = Digest().add(std::to_string(i)).hex();
    tenth += is_sampled(key, 0.1) ? 1 : 0;
    EXPECT_LE(is_sampled(key, 0.1), is_sampled(key, 0.2));
    EXPECT_TRUE(is_sampled(key, 1.0));
  }
  EXPECT_GT(tenth, 140);
  EXPECT_LT(tenth, 260);
}

TEST(RunEstimate, CountsWhatIsMissingByWhatWasFlown) {
  const sample_rows::TemporaryFolder folder;
  Database database = sample_rows::begun(folder / "r.db");  // of planners a and b
  database.add_trial(sample_rows::trial_row("a", 0, 0, Outcome::reached_goal));
  const TrialCost cost = database.mean_costs().at("a");
  SweepSpec sweep = test::small_sweep();
  sweep.planners.resize(2);
  sweep.planners[0].label = "a";
  sweep.planners[1].label = "new";
  const std::vector<PlannedTrial> trials = expand(sweep);
  ASSERT_EQ(trials.size(), 8U);
  const RunEstimate estimate = estimate_run(trials, database);
  EXPECT_EQ(estimate.missing, 8U);
  EXPECT_EQ(estimate.unknown, 4U);
  EXPECT_EQ(estimate.worker_time_s, 4.0 * cost.wall_time_s);
  EXPECT_EQ(estimate.bytes, 4.0 * cost.bytes);
  EXPECT_GT(estimate.bytes, 0.0);
}

TEST(RunEstimate, WhatIsStoredIsNotFlownAgain) {
  const sample_rows::TemporaryFolder folder;
  Database database = sample_rows::begun(folder / "r.db");
  const std::vector<PlannedTrial> trials = expand(test::small_sweep());
  TrialRow row = sample_rows::trial_row("a", 0, 0, Outcome::reached_goal);
  KeyMaker keys;
  row.key = keys.trial_key(trials.front());
  database.add_trial(row);
  EXPECT_EQ(estimate_run(trials, database).missing, trials.size() - 1);
}

TEST(Provenance, SaysWhenWhereAndHow) {
  const RunRow run = run_on_this_host();
  EXPECT_EQ(run.started_at.size(), std::string("2024-02-03T04:05:06Z").size());
  EXPECT_EQ(run.started_at.back(), 'Z');
  EXPECT_NE(run.command_line.find("sweep_tests"), std::string::npos) << run.command_line;
  EXPECT_FALSE(run.host.empty());
  EXPECT_FALSE(run.cpu.empty());
  EXPECT_TRUE(run.program_version.empty());  // the program's own
}

TEST(MeasuresLatency, OfTheBaseOrAnyValueOfTheAxis) {
  SweepSpec sweep = test::small_sweep();
  EXPECT_FALSE(measures_latency(sweep));
  sweep.base.latency.mode = LatencyMode::measured;
  EXPECT_TRUE(measures_latency(sweep));
  sweep.axes.push_back({.path = "latency.mode", .values = {"fixed", "zero"}});
  EXPECT_FALSE(measures_latency(sweep));  // the axis says it of every setting
  sweep.axes.back().values.emplace_back("measured");
  EXPECT_TRUE(measures_latency(sweep));
}

}  // namespace
}  // namespace avoidbench
