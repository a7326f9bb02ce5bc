#include "plugin/pilot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "plugin/bad_planners.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

PlannerSetup setup() {
  PlannerSetup made;
  made.plan_period_s = 0.1;
  return made;
}

PlannerInstance instance_of(const std::string& name) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner(name));
  return PlannerInstance(library, setup(), resolve_parameters(library.description(), {}));
}

PlannerMission mission() {
  PlannerMission made;
  made.goal_world = {10.0, 0.0, 0.0};
  return made;
}

PlannerView view() {
  PlannerView made;
  made.position_world = made.velocity_world = made.rates_body = Eigen::Vector3d::Zero();
  made.q_world_body.setIdentity();
  return made;
}

TEST(Pilot, OfAPlannerAloneIsThatPlanner) {
  PlannerInstance planner = instance_of("honest");
  const Pilot pilot = planner;
  EXPECT_EQ(needs(pilot), planner.needs());
  ASSERT_EQ(reset(pilot, mission()), "");
  EXPECT_EQ(plan(pilot, view()).command.velocity_world_mps[0], 1.0);
}

TEST(Pilot, GivesTheFiltersAnswerAndTheTimesOfBoth) {
  PlannerInstance planner = instance_of("honest"), filter = instance_of("honest_filter");
  const Pilot pilot(planner, &filter);
  EXPECT_EQ(needs(pilot), planner.needs() | filter.needs());
  ASSERT_EQ(reset(pilot, mission()), "");
  const PlanResult result = plan(pilot, view());
  EXPECT_EQ(result.status, PlanStatus::command);
  EXPECT_EQ(result.command.kind, AB_COMMAND_VELOCITY);
  EXPECT_EQ(result.command.velocity_world_mps[0], 1.0);
  EXPECT_GT(result.wall_time_s, 0.0);
}

TEST(Pilot, PassesTrajectoriesOnWithAllTheirPoints) {
  PlannerInstance planner = instance_of("long_trajectories"), filter = instance_of("honest_filter");
  ASSERT_EQ(reset(planner, mission()), "");
  const PlanResult wanted = plan(planner, view());
  ASSERT_GT(wanted.points.size(), 1U);
  const Pilot pilot(planner, &filter);
  ASSERT_EQ(reset(pilot, mission()), "");
  const PlanResult result = plan(pilot, view());
  ASSERT_EQ(result.points.size(), wanted.points.size());
  EXPECT_EQ(std::memcmp(result.points.data(), wanted.points.data(),
                        wanted.points.size() * sizeof(ab_point)),
            0);
}

TEST(Pilot, SaysWhoseAnErrorIs) {
  PlannerInstance honest = instance_of("honest"), fails = instance_of("nan_command"),
                  filter = instance_of("honest_filter"), strict = instance_of("needs_wanted");
  const Pilot of_planner(fails, &filter);
  ASSERT_EQ(reset(of_planner, mission()), "");
  const PlanResult of_planners = plan(of_planner, view());
  EXPECT_EQ(of_planners.status, PlanStatus::error);
  EXPECT_THAT(of_planners.reason, testing::StartsWith("planner honest: velocity_world_mps"));
  // A planner that no sweep would put there: it sees no command and gives one that the filter's
  // table does not declare.
  ASSERT_EQ(strict.reset(mission()), "");
  EXPECT_EQ(strict.plan(view(), nullptr).status, PlanStatus::error);
}

TEST(Pilot, ShowsAFilterNoCommandWhereThePlannerHasNone) {
  PlannerInstance filter = instance_of("honest_filter");
  ASSERT_EQ(filter.reset(mission()), "");
  PlanResult nothing;
  nothing.status = PlanStatus::no_plan;
  EXPECT_EQ(filter.plan(view(), &nothing).status, PlanStatus::no_plan);
  EXPECT_EQ(filter.plan(view()).status, PlanStatus::no_plan);
}

TEST(Filter, IsRefusedWhereItCanNotFly) {
  const auto described = [](const std::string& name) {
    return PlannerLibrary::load(bad_planner(name)).description();
  };
  const PlannerDescription honest = described("honest"), filter = described("honest_filter");
  EXPECT_EQ(filter_alone_problem(honest), "");
  EXPECT_EQ(filter_alone_problem(filter),
            "honest_filter is a filter and flies above a planner only: write {plugin: PLANNER, "
            "filter: honest_filter}");
  EXPECT_EQ(filter_problem(filter, honest), "");
  EXPECT_EQ(filter_problem(honest, honest),
            "honest is no filter: it does not declare AB_INPUT_COMMAND");
  PlannerDescription narrow = filter;
  narrow.commands = AB_COMMAND_TRAJECTORY;
  EXPECT_EQ(filter_problem(narrow, honest),
            "filter honest_filter does not take all commands of honest: velocity (of a filter, "
            "`commands` are the kinds that it takes and gives)");
}

}  // namespace
}  // namespace avoidbench
