#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "plugin/bad_planners.hpp"
#include "support/conformance.hpp"

namespace avoidbench {
namespace {

using test::check_conformance;
using testing::HasSubstr;

TEST(Conformance, HonestPlannersPassEveryRule) {
  for (const std::filesystem::path& file :
       {bad_planner("honest"), bad_planner("sees_all"), bad_planner("sees_movers"),
        bad_planner("globals"), bad_planner("long_trajectories"), bad_planner("honest_filter"),
        std::filesystem::path(C_PLANNER)}) {
    const auto results = check_conformance(file);
    EXPECT_GE(results.size(), 15U);
    for (const ConformanceResult& result : results) {
      EXPECT_TRUE(result.passed) << file << " " << result.name << ": " << result.finding;
      EXPECT_FALSE(result.doc.empty());
    }
  }
}

struct BadCase {
  std::string planner, rule, finding;
};

/// What test lists call it: without this the bytes of its pointers.
void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.planner << ' ' << bad.rule; }

class BadPlanner : public testing::TestWithParam<BadCase> {};

TEST_P(BadPlanner, IsFoundOutByItsRule) {
  const auto results = check_conformance(bad_planner(GetParam().planner));
  EXPECT_THAT(finding(results, GetParam().rule), HasSubstr(GetParam().finding));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadPlanner,
    testing::Values(
        BadCase{"wrong_abi", "loads", "is of ABI 7"},
        BadCase{"throws_across", "flies_toward_a_wall",
                "an exception crossed the interface: thrown in plan"},
        BadCase{"throws_across", "creates_over_its_ranges",
                "an exception crossed create: thrown in create"},
        BadCase{"nan_command", "flies_toward_a_wall", "call 1: velocity_world_mps is not finite"},
        BadCase{"undeclared_kind", "flies_toward_a_wall",
                "kind position, which the planner does not declare"},
        BadCase{"no_kind", "flies_toward_a_wall", "unknown kind 0"},
        BadCase{"strange_status", "flies_toward_a_wall", "returned 5, which is no status"},
        BadCase{"error_without_text", "flies_toward_a_wall", "without a text"},
        BadCase{"error_without_text", "errors_have_a_text", "without a text"},
        BadCase{"writes_image", "flies_toward_a_wall", "it wrote into a depth image"},
        BadCase{"writes_past_image", "flies_toward_a_wall", "it wrote past the ends"},
        BadCase{"clock_guard", "repeats",
                "where each look at a clock finds it one second later: it depends on time, and it "
                "reads steady_clock::now (clock_guard.so)"},
        BadCase{"random_seed", "repeats", "in a second process: it depends on chance, "},
        BadCase{"works_behind", "repeats", "gives another answer"},
        BadCase{"stateful", "reset_forgets", "it remembers"},
        BadCase{"shared_state", "a_new_instance_is_like_a_reset_one", "instances share something"},
        BadCase{"shared_state", "instances_are_apart", "instances share something"},
        BadCase{"untold_globals", "a_new_instance_is_like_a_reset_one",
                "instances share something"},
        BadCase{"globals_segfault", "flies_toward_a_wall", "crashed by signal 11"},
        BadCase{"globals_segfault", "errors_have_a_text", "crashed by signal 11"},
        BadCase{"keeps_pointer", "keeps_no_input", "keeps a pointer"},
        BadCase{"draws_differently", "drawing_changes_nothing", "when its drawings are shown"},
        BadCase{"asked_differently", "being_asked_changes_nothing", "when it is asked"},
        BadCase{"newest_of_any", "tells_cameras_apart", "no longer depend on what the first"},
        BadCase{"forgets_goals", "flies_to_the_next_goal", "the same with the next goal to the"},
        BadCase{"needs_sweeps", "survives_odd_sweeps",
                "a sweep each third call, call 2: AB_ERROR: there is no sweep"},
        BadCase{"needs_tracks", "survives_odd_tracks",
                "no tracks, call 1: velocity_world_mps is not finite"},
        BadCase{"writes_tracks", "flies_toward_a_wall", "it wrote into the tracks"},
        BadCase{"needs_wanted", "survives_odd_commands",
                "no wanted command, call 1: AB_ERROR: no command to pass on"},
        BadCase{"writes_wanted", "flies_toward_a_wall", "it wrote into the wanted command"},
        BadCase{"writes_misses", "flies_toward_a_wall", "it wrote into a lidar's sweep"},
        BadCase{"fears_moving_goals", "survives_odd_goals",
                "a goal that moves, call 1: AB_ERROR: the goal has moved"},
        BadCase{"odd_map", "being_asked_changes_nothing", "no AB_PLACE_"},
        BadCase{"needs_debug", "drawing_changes_nothing", "has no extension avoidbench.debug/1"},
        BadCase{"extra_symbol", "exports_one_avoidbench_symbol", "avoidbench_secret"},
        BadCase{"serves_all", "refuses_unknown_hosts", "ABI 0"},
        BadCase{"fails_inside", "describes_itself", "summary is empty"},
        BadCase{"fails_inside", "creates_over_its_ranges",
                "how = create: create failed: no engine"},
        BadCase{"fails_inside", "flies_toward_a_wall", "not one command"}),
    [](const auto& bad) { return bad.param.planner + "_" + bad.param.rule; });

TEST(Conformance, OneBrokenRuleDoesNotTripTheOthers) {
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("extra_symbol"))),
              testing::ElementsAre("exports_one_avoidbench_symbol"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("stateful"))),
              testing::ElementsAre("reset_forgets"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("keeps_pointer"))),
              testing::ElementsAre("keeps_no_input"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("draws_differently"))),
              testing::ElementsAre("drawing_changes_nothing"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("newest_of_any"))),
              testing::ElementsAre("tells_cameras_apart"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("forgets_goals"))),
              testing::ElementsAre("flies_to_the_next_goal"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("needs_sweeps"))),
              testing::ElementsAre("survives_odd_sweeps"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("needs_tracks"))),
              testing::ElementsAre("survives_odd_tracks"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("needs_wanted"))),
              testing::ElementsAre("survives_odd_commands"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("fears_moving_goals"))),
              testing::ElementsAre("survives_odd_goals"));
  EXPECT_THAT(failed_rules(check_conformance(bad_planner("one_wide_camera"))), testing::IsEmpty());
}

TEST(Conformance, WhereFlightsDoNotRepeatNoRuleThatComparesThemIsBlamed) {
  for (const char* name : {"clock_guard", "random_seed", "works_behind"}) {
    const auto results = check_conformance(bad_planner(name));
    EXPECT_THAT(failed_rules(results), testing::ElementsAre("repeats")) << name;
    EXPECT_THAT(finding(results, "drawing_changes_nothing"), HasSubstr("not tried"));
    EXPECT_EQ(finding(results, "survives_odd_images"), "") << name;
  }
}

TEST(ImportNotes, NameClocksChanceAndThreads) {
  EXPECT_THAT(import_notes(bad_planner("clock_guard")),
              testing::ElementsAre(HasSubstr("clock_guard.so imports steady_clock::now: ")));
  EXPECT_THAT(import_notes(bad_planner("random_seed")),
              testing::ElementsAre(HasSubstr("random_seed.so imports std::random_device: ")));
  EXPECT_THAT(import_notes(bad_planner("works_behind")),
              testing::ElementsAre(HasSubstr("imports std::thread: ")));
  EXPECT_THAT(import_notes(bad_planner("honest")), testing::IsEmpty());
  EXPECT_THAT(import_notes("/nowhere.so"), testing::IsEmpty());
}

TEST(ImportNotes, LookIntoLibrariesThatLieBesideIt) {
  const auto folder = scratch_folder("beside_planner");
  std::filesystem::copy_file(NEEDS_A_SOLVER, folder / "planner.so");
  EXPECT_THAT(import_notes(folder / "planner.so"), testing::IsEmpty());
  std::filesystem::copy_file(A_SOLVER, folder / "libclock_solver.so");
  EXPECT_THAT(import_notes(folder / "planner.so"),
              testing::ElementsAre(HasSubstr("libclock_solver.so imports clock_gettime: ")));
}

TEST(Conformance, ClocksOfLibrariesThatItNeedsAreShifted) {
  EXPECT_THAT(finding(check_conformance(NEEDS_A_SOLVER), "repeats"),
              HasSubstr("reads clock_gettime (libclock_solver.so)"));
}

TEST(IsolatedConformance, GivesTheSameAsInProcess) {
  const auto here = check_conformance(bad_planner("clock_guard"));
  const auto there = check_conformance_isolated(bad_planner("clock_guard"));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here[i].name, there[i].name);
    EXPECT_EQ(here[i].doc, there[i].doc);
    EXPECT_EQ(here[i].passed, there[i].passed);
    EXPECT_EQ(here[i].was_tried, there[i].was_tried);
    EXPECT_EQ(here[i].finding, there[i].finding);
  }
}

TEST(IsolatedConformance, ACrashFailsTheRuleThatWasTried) {
  const auto results = check_conformance_isolated(bad_planner("segfault"));
  ASSERT_FALSE(results.empty());
  EXPECT_EQ(results.back().name, "flies_toward_a_wall");
  EXPECT_FALSE(results.back().passed);
  // A sanitizer catches the signal and ends the process by itself.
  EXPECT_THAT(results.back().finding,
              testing::AnyOf(HasSubstr("crashed by signal 11"), HasSubstr("ended the process")));
}

TEST(IsolatedConformance, AHangEndsWithTheTime) {
  const auto results = check_conformance_isolated(bad_planner("infinite_loop"), 1.0);
  ASSERT_FALSE(results.empty());
  EXPECT_EQ(results.back().name, "flies_toward_a_wall");
  EXPECT_THAT(results.back().finding, HasSubstr("did not return within 1 s"));
}

}  // namespace
}  // namespace avoidbench
