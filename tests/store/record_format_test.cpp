#include "store/record_format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using sample_rows::trial_row;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// All bits of the calls, NaN equal to NaN.
std::string bits_of(const std::vector<PlanCall>& calls) {
  return plan_calls_digest(calls) + plan_calls_json(calls);
}

TEST(PlanCalls, ComeBackFromTheirText) {
  const std::vector<PlanCall> calls{
      {.time_s = 0.0,
       .cpu_time_s = 1.0 / 3.0,
       .wall_time_s = 1e-300,
       .status = -3,
       .command_kind = 4'000'000'000U,
       .latency_s = kNaN},
      {.time_s = -0.0, .cpu_time_s = kNaN, .wall_time_s = 5e-324, .latency_s = 0.033},
      {.time_s = 1e22,
       .cpu_time_s = 1.7976931348623157e308,
       .wall_time_s = kNaN,
       .latency_s = kNaN}};
  const std::string text = plan_calls_json(calls);
  const std::vector<PlanCall> back = plan_calls_from_json(text);
  EXPECT_EQ(bits_of(back), bits_of(calls));
  ASSERT_EQ(back.size(), 3U);
  EXPECT_TRUE(std::signbit(back[1].time_s));
  EXPECT_EQ(back[1].latency_s, 0.033);
  EXPECT_TRUE(std::isnan(back[0].latency_s));
  EXPECT_TRUE(plan_calls_from_json("[]").empty());
}

TEST(PlanCalls, AnyWayToWriteThemAsJsonIsRead) {
  const std::string ours = "[[0.5,1,null,2,3],[1e-3,2.5,0,-1,0,0.25]]";
  for (const char* other : {"[ [0.5,1,null,2,3],[1e-3,2.5,0,-1,0,0.25] ]",
                            "[[5e-1,1.0,null,2,3],[0.1E-2,25.0e-1,0.0,-1,0,25e-2]]\n",
                            "[[0.5,1,null,2,3],[0.001,2.5,0,-1,0,0.25,\"of a later program\"]]"}) {
    EXPECT_EQ(bits_of(plan_calls_from_json(other)), bits_of(plan_calls_from_json(ours))) << other;
  }
}

TEST(PlanCalls, WhatIsNoneIsRefused) {
  for (const char* bad : {"",
                          "[",
                          "[[",
                          "[[0,0,0,0,0]",
                          "[[0,0,0,0,0],]",
                          "[,[0,0,0,0,0]]",
                          "[[0,0,0,0]]",
                          "[[0,0,0,0.5,0]]",
                          "[[0,0,0,null,0]]",
                          "[[01,0,0,0,0]]",
                          "[[1.,0,0,0,0]]",
                          "[[.5,0,0,0,0]]",
                          "[[1e,0,0,0,0]]",
                          "[[+1,0,0,0,0]]",
                          "[[inf,0,0,0,0]]",
                          "[[nan,0,0,0,0]]",
                          "[[-,0,0,0,0]]",
                          "[[1e999,0,0,0,0]]",
                          "[[0,0,0,0,0]]]",
                          "[[0 0,0,0,0]]",
                          "[[\"0\",0,0,0,0]]",
                          "[0]",
                          "[[0,0,0,0,0]]x"}) {
    EXPECT_THROW(plan_calls_from_json(bad), nlohmann::json::exception) << bad;
  }
}

/// Nothing that two flights can differ in is left out, except what a clock measured.
TEST(RecordDigest, IsAnotherOneForEachChange) {
  const TrialRecord record = trial_row("a", 0, 0, Outcome::collided).record;
  using Change = void (*)(TrialRecord&);
  const Change changes[] = {[](TrialRecord& r) { r.outcome = Outcome::timed_out; },
                            [](TrialRecord& r) { r.reason += '.'; },
                            [](TrialRecord& r) { r.end_time_s += 1e-9; },
                            [](TrialRecord& r) { r.samples.pop_back(); },
                            [](TrialRecord& r) { r.samples[3].clearance_m = 1.0; },
                            [](TrialRecord& r) { r.plan_calls.pop_back(); },
                            [](TrialRecord& r) { r.plan_calls[1].time_s += 1e-9; },
                            [](TrialRecord& r) { ++r.plan_calls[1].status; },
                            [](TrialRecord& r) { ++r.plan_calls[1].command_kind; },
                            [](TrialRecord& r) { r.collisions.clear(); },
                            [](TrialRecord& r) { r.collisions[0].time_s += 1e-9; },
                            [](TrialRecord& r) { r.collisions[0].speed_mps += 1e-9; },
                            [](TrialRecord& r) { ++r.collisions[0].obstacle; },
                            [](TrialRecord& r) { r.collisions[0].kind = "rock"; }};
  std::set<std::string> digests{record_digest(record)};
  for (const Change change : changes) {
    TrialRecord changed = record;
    change(changed);
    EXPECT_TRUE(digests.insert(record_digest(changed)).second) << digests.size();
  }
  TrialRecord slower = record;
  slower.plan_calls[0].cpu_time_s += 1.0;
  slower.plan_calls[0].wall_time_s += 1.0;
  EXPECT_EQ(record_digest(slower), record_digest(record));
}

}  // namespace
}  // namespace avoidbench
