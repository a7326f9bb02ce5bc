#include "plugin/pilot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "conformance/conformance_flight.hpp"
#include "plugin/bad_planners.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

PlannerInstance pilot_instance(const std::string& name) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner(name));
  return PlannerInstance(library, conformance_setup(),
                         resolve_parameters(library.description(), {}));
}

PlannerMission pilot_mission() {
  PlannerMission made;
  made.goal_world = {10.0, 0.0, 0.0};
  return made;
}

PlannerView pilot_view() {
  PlannerView made;
  made.position_world = made.velocity_world = made.rates_body = Eigen::Vector3d::Zero();
  made.q_world_body.setIdentity();
  return made;
}

TEST(Pilot, OfAPlannerAloneIsThatPlanner) {
  PlannerInstance planner = pilot_instance("honest");
  const Pilot pilot = planner;
  EXPECT_EQ(needs(pilot), planner.needs());
  ASSERT_EQ(reset(pilot, pilot_mission()), "");
  EXPECT_EQ(plan(pilot, pilot_view()).command.velocity_world_mps[0], 1.0);
}

TEST(Pilot, GivesTheFiltersAnswerAndTheTimesOfBoth) {
  PlannerInstance planner = pilot_instance("honest"), filter = pilot_instance("honest_filter");
  const Pilot pilot(planner, &filter);
  EXPECT_EQ(needs(pilot), planner.needs() | filter.needs());
  ASSERT_EQ(reset(pilot, pilot_mission()), "");
  const PlanResult result = plan(pilot, pilot_view());
  EXPECT_EQ(result.status, PlanStatus::command);
  EXPECT_EQ(result.command.kind, AB_COMMAND_VELOCITY);
  EXPECT_EQ(result.command.velocity_world_mps[0], 1.0);
  EXPECT_GT(result.wall_time_s, 0.0);
}

TEST(Pilot, PassesTrajectoriesOnWithAllTheirPoints) {
  PlannerInstance planner = pilot_instance("long_trajectories"),
                  filter = pilot_instance("honest_filter");
  ASSERT_EQ(reset(planner, pilot_mission()), "");
  const PlanResult wanted = plan(planner, pilot_view());
  ASSERT_GT(wanted.points.size(), 1U);
  const Pilot pilot(planner, &filter);
  ASSERT_EQ(reset(pilot, pilot_mission()), "");
  const PlanResult result = plan(pilot, pilot_view());
  ASSERT_EQ(result.points.size(), wanted.points.size());
  EXPECT_EQ(std::memcmp(result.points.data(), wanted.points.data(),
                        wanted.points.size() * sizeof(ab_point)),
            0);
}

TEST(Pilot, SaysWhoseAnErrorIs) {
  PlannerInstance honest = pilot_instance("honest"), fails = pilot_instance("nan_command"),
                  filter = pilot_instance("honest_filter"), strict = pilot_instance("needs_wanted");
  const Pilot of_planner(fails, &filter);
  ASSERT_EQ(reset(of_planner, pilot_mission()), "");
  const PlanResult of_planners = plan(of_planner, pilot_view());
  EXPECT_EQ(of_planners.status, PlanStatus::error);
  EXPECT_THAT(of_planners.reason, testing::StartsWith("planner honest: velocity_world_mps"));
  // It fails where the planner has no plan; this one always has one.
  const Pilot of_filter(honest, &strict);
  ASSERT_EQ(reset(of_filter, pilot_mission()), "");
  EXPECT_EQ(plan(of_filter, pilot_view()).status, PlanStatus::command);
  ASSERT_EQ(strict.reset(pilot_mission()), "");
  EXPECT_EQ(strict.plan(pilot_view()).reason, "no command to pass on");
}

TEST(Pilot, ShowsAFilterNoCommandWhereThePlannerHasNone) {
  PlannerInstance filter = pilot_instance("honest_filter");
  ASSERT_EQ(filter.reset(pilot_mission()), "");
  PlanResult nothing;
  nothing.status = PlanStatus::no_plan;
  EXPECT_EQ(filter.plan(pilot_view(), &nothing).status, PlanStatus::no_plan);
  EXPECT_EQ(filter.plan(pilot_view()).status, PlanStatus::no_plan);
}

TEST(Filter, IsRefusedWhereItCanNotFly) {
  const auto described = [](const std::string& name) {
    return PlannerLibrary::load(bad_planner(name)).description();
  };
  const PlannerDescription honest = described("honest"), filter = described("honest_filter");
  EXPECT_EQ(filter_alone_problem(honest), "");
  EXPECT_EQ(filter_alone_problem(filter),
            "honest_filter is a filter and flies only on top of a planner: write {plugin: PLANNER, "
            "filter: honest_filter}");
  EXPECT_EQ(filter_problem(filter, honest), "");
  EXPECT_EQ(filter_problem(honest, honest),
            "honest is not a filter: it does not declare AB_INPUT_COMMAND");
  PlannerDescription narrow = filter;
  narrow.commands = AB_COMMAND_TRAJECTORY;
  EXPECT_EQ(filter_problem(narrow, honest),
            "filter honest_filter does not take all commands of honest: velocity (of a filter, "
            "`commands` are the kinds that it takes and gives)");
}

}  // namespace
}  // namespace avoidbench
