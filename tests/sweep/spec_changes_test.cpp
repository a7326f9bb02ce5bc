#include "sweep/spec_changes.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

using Changes = std::vector<std::string>;

constexpr const char* kFormer =
    R"({"name":"s","trials":5,"base":{"seed":1,"rates":{"plan_hz":30.0}},
        "axes":[{"path":"map.poisson_radius_m","values":[2.5,3.0]}],
        "planners":[{"label":"a","plugin":"a","file_digest":"00","parameters":[
                       {"name":"horizon_m","number":5.0,"text":"","is_text":false}]},
                    {"label":"b","plugin":"b","file_digest":"11","parameters":[]}]})";

TEST(SpecChanges, NameEachDifferenceOnce) {
  const Changes changes =
      spec_changes(kFormer,
                   R"({"name":"s","trials":10,"base":{"seed":1,"rates":{"plan_hz":20.0}},
          "axes":[{"path":"map.poisson_radius_m","values":[2.5]}],"until":"success_rate ci<0.1",
          "planners":[{"label":"c","plugin":"c","file_digest":"22","parameters":[]},
                      {"label":"a","plugin":"a","file_digest":"33","parameters":[
                         {"name":"horizon_m","number":6.0,"text":"","is_text":false}]}]})");
  EXPECT_EQ(changes, (Changes{"map.poisson_radius_m [2.5,3.0] → [2.5]", "rates.plan_hz 30.0 → 20.0",
                              "trials 5 → 10", "until none → \"success_rate ci<0.1\"",
                              "planner a: another file", "planner a: horizon_m 5.0 → 6.0",
                              "planner c is new", "planner b is gone"}));
}

TEST(SpecChanges, NameTheLimitsRule) {
  EXPECT_EQ(spec_changes(R"({"limit":{"field":"wind.x","values":[1,2],"most_trials":18}})",
                         R"({"limit":{"field":"wind.x","values":[1,3],"most_trials":40,
                                      "direction":"falls"}})"),
            (Changes{"limit.direction none → \"falls\"", "limit.most_trials 18 → 40"}));
}

TEST(SpecChanges, AreNoneBetweenEqualSweepsAndDoNotThrow) {
  EXPECT_EQ(spec_changes(kFormer, kFormer), Changes{});
  EXPECT_EQ(spec_changes("no json", "[]"), Changes{});
}

}  // namespace
}  // namespace avoidbench
