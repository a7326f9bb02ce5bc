#include <gtest/gtest.h>

#include <utility>

#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"

namespace avoidbench {
namespace {

using kinematic::Course;
using kinematic::Ending;
using kinematic::Result;

TEST(StoppingDistance, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

/// By a vehicle of a long lag, of which the filter is told.
Result flown(const std::string& planner_file, const Course& course, double time_limit_s = 60.0,
             ParameterValues parameters = {}) {
  parameters["lag_s"] = {.number = 0.6, .text = ""};
  PlannerInstance planner = kinematic::instance_of(planner_file);
  PlannerInstance filter = kinematic::instance_of(PLANNER_FILE, parameters);
  return kinematic::fly(Pilot(planner, &filter), course, time_limit_s);
}

TEST(StoppingDistance, ChangesNothingWhereNothingIsInTheWay) {
  PlannerInstance planner = kinematic::instance_of(STRAIGHT_LINE_FILE);
  const Course course = kinematic::meadow();
  const Result alone = kinematic::fly(planner, course), with = flown(STRAIGHT_LINE_FILE, course);
  EXPECT_EQ(with.ending, Ending::reached_goal);
  EXPECT_EQ(with.positions, alone.positions);
}

/// However thick the tree is and where it would be struck.
TEST(StoppingDistance, StopsBeforeWhatIsInTheWay) {
  for (const auto& [radius_m, aside_m] : {std::pair(0.15, 0.0), {0.3, 0.3}, {1.0, 0.5}}) {
    Course course = kinematic::meadow();
    course.cylinders.push_back({{aside_m, 12.0}, radius_m});
    const Result flight = flown(STRAIGHT_LINE_FILE, course, 9.0);
    EXPECT_EQ(flight.ending, Ending::timed_out) << radius_m << " m, " << aside_m << " m aside";
    // Near it: it does not stop for nothing.
    EXPECT_LT(kinematic::clearance_m(course, flight.positions.back()), 0.9);
    EXPECT_GT(flight.positions.back().y(), 9.0);
  }
}

TEST(StoppingDistance, KeepsTheMarginThatItIsTold) {
  Course course = kinematic::meadow();
  course.cylinders.push_back({{0.0, 12.0}, 0.3});
  const auto clearance_m = [&](double margin_m) {
    const Result flight =
        flown(STRAIGHT_LINE_FILE, course, 9.0, {{"margin_m", {.number = margin_m, .text = ""}}});
    return kinematic::clearance_m(course, flight.positions.back());
  };
  const double near_m = clearance_m(0.1), far_m = clearance_m(1.1);
  EXPECT_NEAR(far_m - near_m, 1.0, 0.2);
}

TEST(StoppingDistance, FliesPastWhatIsBesideTheWay) {
  Course course = kinematic::meadow();
  course.cylinders.push_back({{1.2, 20.0}, 0.3});
  course.cylinders.push_back({{-1.2, 25.0}, 0.3});
  EXPECT_EQ(flown(STRAIGHT_LINE_FILE, course).ending, Ending::reached_goal);
}

TEST(StoppingDistance, StopsInForestsInsteadOfStriking) {
  constexpr std::uint64_t kCount = 4;
  int struck_alone = 0, struck = 0;
  for (std::uint64_t seed = 0; seed < kCount; ++seed) {
    const Course course = kinematic::forest(5.0, seed);
    PlannerInstance planner = kinematic::instance_of(STRAIGHT_LINE_FILE);
    struck_alone += kinematic::fly(planner, course, 15.0).ending == Ending::collided ? 1 : 0;
    struck += flown(STRAIGHT_LINE_FILE, course, 15.0).ending == Ending::collided ? 1 : 0;
  }
  EXPECT_GE(struck_alone, 2);
  EXPECT_EQ(struck, 0);
}

TEST(StoppingDistance, LeavesAPlannerThatAvoidsItsSuccess) {
  int reached = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Result flight = flown(REACTIVE_FILE, kinematic::forest(5.0, seed));
    EXPECT_NE(flight.ending, Ending::failed) << flight.reason;
    reached += flight.ending == Ending::reached_goal ? 1 : 0;
  }
  EXPECT_EQ(reached, 2);
}

}  // namespace
}  // namespace avoidbench
