#include "plugin/planner_instance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <locale.h>

#include <array>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <locale>

#include "conformance/conformance_flight.hpp"
#include "plugin/bad_planners.hpp"
#include "plugin/command_check.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using testing::HasSubstr;

PlannerInstance instance_of(const std::string& name, const ParameterValues& given = {}) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner(name));
  return {library, conformance_setup(), resolve_parameters(library.description(), given)};
}

PlannerView view() {
  PlannerView view;
  view.position_world = {1.0, 2.0, 3.0};
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  return view;
}

PlannerMission mission() {
  PlannerMission mission;
  mission.goal_world = {10.0, 0.0, 2.0};
  return mission;
}

PlanResult planned(const std::string& name, const ParameterValues& given = {}) {
  PlannerInstance instance = instance_of(name, given);
  EXPECT_EQ(instance.reset(mission()), "");
  return instance.plan(view());
}

ParameterValues how(const std::string& value) { return {{"how", {0.0, value}}}; }

/// The planner compares what its members and the names give, and throws where they differ.
TEST(Instance, FillsTheMembersOfParametersAndProfilesBehindWhatIsGiven) {
  const PlannerLibrary library = PlannerLibrary::load(CPP17_PLANNER);
  const auto speed_mps = [&](const ParameterValues& given) {
    const auto values = resolve_parameters(library.description(), given);
    EXPECT_NO_THROW(PlannerInstance(library, conformance_setup(), values));
    return values.front().number;
  };
  EXPECT_EQ(speed_mps({}), 2.0);
  EXPECT_EQ(speed_mps({{"mode", {0.0, "fast"}}, {"label", {0.0, "x"}}}), 4.0);
  EXPECT_EQ(speed_mps({{"mode", {0.0, "fast"}}, {"speed_mps", {2.0, ""}}}), 2.0);
  EXPECT_EQ(speed_mps({{"mode", {0.0, "safe"}}, {"ray_count", {9.0, ""}}}), 2.0);
}

TEST(Instance, GivesACommandAndItsTimes) {
  const PlanResult result = planned("honest");
  ASSERT_EQ(result.status, PlanStatus::command) << result.reason;
  EXPECT_EQ(result.command.kind, AB_COMMAND_VELOCITY);
  EXPECT_EQ(result.command.velocity_world_mps[0], 1.0);
  EXPECT_GT(result.wall_time_s, 0.0);
  EXPECT_GT(result.cpu_time_s, 0.0);
  EXPECT_LT(result.cpu_time_s, 0.1);
}

TEST(Instance, CopiesATrajectoryOut) {
  PlannerInstance instance = instance_of("fails_inside", how("trajectory"));
  instance.reset(mission());
  const PlanResult first = instance.plan(view());
  instance.plan(view());
  ASSERT_EQ(first.status, PlanStatus::command) << first.reason;
  EXPECT_EQ(first.command.points, nullptr);
  ASSERT_EQ(first.points.size(), 3U);
  EXPECT_EQ(first.points[2].time_s, 1.0);
  EXPECT_EQ(first.points[2].position_world_m[0], 2.0);
}

TEST(Instance, NoPlanAndGivingUpAreNoErrors) {
  EXPECT_EQ(planned("fails_inside", how("no_plan")).status, PlanStatus::no_plan);
  const PlanResult gave_up = planned("fails_inside", how("give_up"));
  EXPECT_EQ(gave_up.status, PlanStatus::gave_up);
  EXPECT_EQ(gave_up.reason, "walled in");
}

TEST(Instance, SaysWhyCreateAndResetFail) {
  const auto create_error = [](const std::string& way) -> std::string {
    return test::message_of([&] { instance_of("fails_inside", how(way)); });
  };
  EXPECT_EQ(create_error("create"), "planner fails_inside: no engine");
  EXPECT_THAT(create_error("unknown_name"), HasSubstr("no parameter speed_mps is declared"));
  EXPECT_THAT(create_error("wrong_kind"), HasSubstr("parameter how is of another kind"));
  EXPECT_EQ(instance_of("fails_inside", how("reset")).reset(mission()), "no way");
}

TEST(Instance, TurnsWhatAPlannerThrowsIntoAnError) {
  EXPECT_EQ(planned("fails_inside", how("plan")).reason, "no idea");
  EXPECT_THAT(planned("fails_inside", how("odd")).reason, HasSubstr("no std::exception"));
  EXPECT_THAT(planned("throws_across").reason, HasSubstr("crossed the interface: thrown in plan"));
  PlannerInstance in_reset = instance_of("throws_across", {{"where", {0.0, "reset"}}});
  EXPECT_THAT(in_reset.reset(mission()), HasSubstr("crossed the interface: thrown in reset"));
  EXPECT_THROW(instance_of("throws_across", {{"where", {0.0, "create"}}}), InputError);
}

TEST(Instance, RefusesCommandsThatCannotBeFlown) {
  const auto reason = [](const PlanResult& result) {
    EXPECT_EQ(result.status, PlanStatus::error);
    return result.reason;
  };
  EXPECT_THAT(reason(planned("nan_command")), HasSubstr("velocity_world_mps is not finite"));
  EXPECT_THAT(reason(planned("undeclared_kind")), HasSubstr("does not declare"));
  EXPECT_THAT(reason(planned("strange_status")), HasSubstr("is no status"));
  EXPECT_THAT(reason(planned("error_without_text")), HasSubstr("without saying why"));
  EXPECT_THAT(reason(planned("fails_inside", how("one_point"))), HasSubstr("at least 2"));
  EXPECT_THAT(reason(planned("fails_inside", how("too_many"))), HasSubstr("at most 10000"));
  EXPECT_THAT(reason(planned("fails_inside", how("late_start"))), HasSubstr("first time is not 0"));
  EXPECT_THAT(reason(planned("fails_inside", how("falling_times"))), HasSubstr("do not rise"));
  EXPECT_THAT(reason(planned("fails_inside", how("nan_point"))),
              HasSubstr("point 2: jerk_world_mps3 is not finite"));
}

TEST(Instance, KeepsTheLog) {
  PlannerInstance instance = instance_of("fails_inside");
  EXPECT_THAT(instance.take_log(), testing::ElementsAre("warning: how no_plan"));
  EXPECT_TRUE(instance.take_log().empty());
}

TEST(CommandCheck, AbsurdNumbersAreNoCommands) {
  const auto problem = [](std::uint32_t kind, double(ab_command::*field)[3], double value) {
    ab_command command{};
    command.kind = kind;
    (command.*field)[1] = value;
    return command_problem(command, kind);
  };
  EXPECT_EQ(problem(AB_COMMAND_VELOCITY, &ab_command::velocity_world_mps, 1e300),
            "velocity_world_mps is 1e+300, beyond ±1e+06: no such command is meant");
  EXPECT_THAT(problem(AB_COMMAND_POSITION, &ab_command::position_world_m, -2e6),
              HasSubstr("position_world_m is -2e+06"));
  EXPECT_THAT(problem(AB_COMMAND_RATES, &ab_command::rates_body_radps, 1e9),
              HasSubstr("rates_body_radps is 1e+09"));
  EXPECT_EQ(problem(AB_COMMAND_ACCELERATION, &ab_command::acceleration_world_mps2, 1e6), "");
  ab_point points[2] = {};
  points[1].time_s = 1.0;
  points[1].velocity_world_mps[0] = 1e12;
  ab_command trajectory{};
  trajectory.kind = AB_COMMAND_TRAJECTORY;
  trajectory.points = points;
  trajectory.point_count = 2;
  EXPECT_THAT(command_problem(trajectory, AB_COMMAND_TRAJECTORY),
              HasSubstr("trajectory point 1: velocity_world_mps is 1e+12"));
  points[1].velocity_world_mps[0] = 0.0;
  EXPECT_EQ(command_problem(trajectory, AB_COMMAND_TRAJECTORY), "");
  // Each number may be meant; together they turn by more than sine and cosine can tell.
  points[0].yaw_rate_radps = 5e4;
  points[1].time_s = 10.0;
  EXPECT_EQ(command_problem(trajectory, AB_COMMAND_TRAJECTORY),
            "trajectory point 1: yaw_rate_radps times the time between the points is 5e+05, beyond "
            "±1e+05: no such command is meant");
  points[0].yaw_rate_radps = 0.0;
  points[1].time_s = 1e200;
  EXPECT_THAT(command_problem(trajectory, AB_COMMAND_TRAJECTORY), HasSubstr("time_s is 1e+200"));
}

TEST(CommandCheck, EveryKindMustBeFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto problem = [&](std::uint32_t kind, double ab_command::*field) {
    ab_command command{};
    command.kind = kind;
    EXPECT_EQ(command_problem(command, kind), "");
    command.*field = nan;
    return command_problem(command, kind);
  };
  EXPECT_EQ(problem(AB_COMMAND_POSITION, &ab_command::yaw_rad), "yaw_rad is not finite");
  EXPECT_EQ(problem(AB_COMMAND_ACCELERATION, &ab_command::horizon_s),
            "horizon_s is negative or not finite");
  EXPECT_EQ(problem(AB_COMMAND_RATES, &ab_command::thrust_mps2), "thrust_mps2 is not finite");
  ab_command turning{};
  turning.kind = AB_COMMAND_VELOCITY;
  turning.flags = AB_YAW_IS_RATE;
  turning.yaw_rad = nan;  // not used
  EXPECT_EQ(command_problem(turning, AB_COMMAND_VELOCITY), "");
  turning.yaw_rate_radps = nan;
  EXPECT_EQ(command_problem(turning, AB_COMMAND_VELOCITY), "yaw_rate_radps is not finite");
  turning.flags = 4;
  EXPECT_THAT(command_problem(turning, AB_COMMAND_VELOCITY), HasSubstr("unknown flags"));
}

/// The locale of a planner is its own: the host writes numbers with a point before, between and
/// after its calls, also where a thread of the planner sets the locale again and again.
TEST(Instance, KeepsItsLocaleToItself) {
  ::setenv("LOCPATH", LOCALES, 1);
  ::uselocale(LC_GLOBAL_LOCALE);  // as in a thread that has called no planner yet
  const auto host_text = [] {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", 0.5);
    return std::string(text.data());
  };
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr) << "no German locale in " << LOCALES;
  EXPECT_EQ(std::string(std::localeconv()->decimal_point), ",");
  std::setlocale(LC_ALL, "C");
  for (const std::string how : {"setlocale", "uselocale", "global", "thread"}) {
    PlannerInstance instance = instance_of("sets_locale", {{"how", {0.0, how}}});
    EXPECT_EQ(host_text(), "0.5") << how;
    EXPECT_EQ(instance.reset(mission()), "");
    for (int call = 0; call < (how == "thread" ? 2000 : 3); ++call) {
      const PlanResult result = instance.plan(view());
      ASSERT_EQ(result.status, PlanStatus::command) << how << ": " << result.reason;
      ASSERT_EQ(host_text(), "0.5") << how;
    }
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
  }
  ::unsetenv("LOCPATH");
}

}  // namespace
}  // namespace avoidbench
