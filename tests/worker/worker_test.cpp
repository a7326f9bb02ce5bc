#include "worker/worker.hpp"

#include <gtest/gtest.h>

#include "maps/map_spec.hpp"
#include "support/planner_files.hpp"

namespace avoidbench {
namespace {

/// A hall, and what one lookout was asked and saw.
struct InAHall : testing::Test {
  InAHall() {
    job.token = "one";
    job.spec.map = HallSpec{.area_m = {12.0, 12.0}, .poisson_radius_m = 4.0};
    job.spec.map_seed = 2;
    job.spec.planner = test::preset_choice("straight_line");
    job.spec.mission.time_limit_s = 0.5;
  }
  LookoutMakers lookouts() {
    return {{"counts", [this](const Job&, const World& world) {
               seen_digest = world.digest;
               Lookout lookout;
               lookout.observer.planning = [this](const PlanCallAhead&) { return ++calls > 0; };
               lookout.report = [this](const TrialRecord* record) {
                 return Message{.json = {{"calls", calls}, {"has_record", record != nullptr}},
                                .bytes = {}};
               };
               return lookout;
             }}};
  }
  void ask_for_lookout(bool has_flight) {
    job.lookout = LookoutJob{.kind = "counts", .wanted = {}, .most_bytes = 100};
    job.lookout->has_flight = has_flight;
  }

  Job job;
  std::string seen_digest;
  int calls = 0;
};

TEST_F(InAHall, AJobWithoutAMissionIsAMap) {
  job.mission_count = 2;
  Worker worker;
  const JobResult map = worker.work(job);
  EXPECT_EQ(map.error, "");
  EXPECT_EQ(map.token, "one");
  ASSERT_TRUE(map.map);
  EXPECT_EQ(map.map->missions.size(), 2U);
  EXPECT_FALSE(map.trial || map.reported);
  // One of its missions is a trial, whose metrics go with it.
  job.mission = map.map->missions.front();
  const JobResult trial = worker.work(job);
  EXPECT_EQ(trial.error, "");
  ASSERT_TRUE(trial.trial);
  EXPECT_EQ(trial.trial->outcome, Outcome::timed_out) << trial.trial->reason;
  EXPECT_FALSE(trial.metrics.empty());
  EXPECT_EQ(trial.world_digest, map.world_digest);
  EXPECT_FALSE(trial.map || trial.reported);
}

TEST_F(InAHall, ALookoutSeesTheFlightAndTheRecord) {
  job.mission_count = 1;
  Worker worker(lookouts());
  job.mission = worker.work(job).map->missions.front();
  ask_for_lookout(true);
  const JobResult result = worker.work(job);
  ASSERT_TRUE(result.trial && result.reported) << result.error;
  EXPECT_EQ(seen_digest, result.world_digest);
  EXPECT_EQ(result.reported->json.at("calls"), result.trial->plan_calls.size());
  EXPECT_GT(calls, 5);
  EXPECT_TRUE(result.reported->json.at("has_record"));
  // One that needs no flight gets none.
  calls = 0;
  ask_for_lookout(false);
  const JobResult looked = worker.work(job);
  EXPECT_FALSE(looked.trial);
  ASSERT_TRUE(looked.reported) << looked.error;
  EXPECT_EQ(looked.reported->json.at("calls"), 0);
  EXPECT_FALSE(looked.reported->json.at("has_record"));
}

TEST_F(InAHall, WhatIsWrongIsTheJobsError) {
  job.spec.planner.file = "/nowhere/planner.so";
  job.mission = MissionRecord{};
  Worker worker;
  const JobResult result = worker.work(job);
  EXPECT_NE(result.error.find("/nowhere/planner.so"), std::string::npos) << result.error;
  EXPECT_FALSE(result.trial || result.is_out_of_memory);
}

}  // namespace
}  // namespace avoidbench
