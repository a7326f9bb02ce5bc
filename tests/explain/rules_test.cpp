// The documented bounds of the rules: facts on both sides of each, and at it.
#include <gtest/gtest.h>

#include <cmath>

#include "explain/causes.hpp"
#include "scripted.hpp"

namespace avoidbench {
namespace {

/// Of a collision with what was seen, sensed and mapped in time, by a planner that had plans.
Facts seen_in_time() {
  Facts facts;
  facts.last_chance_s = 5.0;
  facts.in_cone_s = 1.0;
  facts.unoccluded_s = 2.0;
  facts.in_range_s = 3.0;
  facts.sensed_s = 4.0;
  facts.sensed_lately_count = 7.0;
  facts.mapped_share = 0.6;
  facts.no_plan_share = 0.2;
  facts.tracking_error_m = 0.04;
  facts.commanded_clearance_m = 0.0;
  return facts;
}

/// The cause with one fact changed.
Cause with(double Facts::*fact, double value, Facts facts = seen_in_time()) {
  facts.*fact = value;
  return collision_cause(facts, true);
}

TEST(Rules, OfACollisionWithWhatWasKnown) {
  EXPECT_EQ(collision_cause(seen_in_time(), true), Cause::mapped_not_avoided);
  EXPECT_EQ(collision_cause(seen_in_time(), false), Cause::unexplained) << "nobody looked on";
  EXPECT_EQ(with(&Facts::mapped_share, Facts::kNone), Cause::sensed_not_avoided);
}

TEST(Rules, MovedIntoBeyondTwoCentimetresOfRoom) {
  Facts facts = seen_in_time();
  facts.obstacle_way_m = 0.01;
  EXPECT_EQ(with(&Facts::still_clearance_m, 0.02, facts), Cause::mapped_not_avoided);
  EXPECT_EQ(with(&Facts::still_clearance_m, 0.021, facts), Cause::moved_into);
  facts.obstacle_way_m = 0.0;
  EXPECT_EQ(with(&Facts::still_clearance_m, 0.3, facts), Cause::mapped_not_avoided);
}

TEST(Rules, TrackingBeyondFiveCentimetresOfClearPathAndAGreaterError) {
  Facts facts = seen_in_time();
  facts.tracking_error_m = 0.3;
  EXPECT_EQ(with(&Facts::commanded_clearance_m, 0.05, facts), Cause::mapped_not_avoided);
  EXPECT_EQ(with(&Facts::commanded_clearance_m, 0.051, facts), Cause::tracking);
  EXPECT_EQ(with(&Facts::commanded_clearance_m, 0.3, facts), Cause::mapped_not_avoided);
  EXPECT_EQ(with(&Facts::commanded_clearance_m, 0.299, facts), Cause::tracking);
}

TEST(Rules, LateIsAfterTheLastChanceOrNever) {
  const std::pair<double Facts::*, Cause> late[] = {
      {&Facts::in_cone_s, Cause::out_of_view},
      {&Facts::unoccluded_s, Cause::occluded},
      {&Facts::in_range_s, Cause::too_late_for_speed}};
  for (const auto& [fact, cause] : late) {
    EXPECT_EQ(with(fact, 5.0), Cause::mapped_not_avoided) << text(cause);
    EXPECT_EQ(with(fact, 5.001), cause);
    EXPECT_EQ(with(fact, Facts::kNone), cause);
  }
}

TEST(Rules, SensedByThreeImagesLatelyAndInTime) {
  Facts silent = seen_in_time();
  silent.mapped_share = Facts::kNone;
  EXPECT_EQ(with(&Facts::sensed_lately_count, 2.0, silent), Cause::not_sensed);
  EXPECT_EQ(with(&Facts::sensed_lately_count, 3.0, silent), Cause::sensed_not_avoided);
  EXPECT_EQ(with(&Facts::sensed_s, 5.0, silent), Cause::sensed_not_avoided);
  EXPECT_EQ(with(&Facts::sensed_s, 5.001, silent), Cause::not_sensed);
  EXPECT_EQ(with(&Facts::sensed_s, Facts::kNone, silent), Cause::not_sensed);
}

TEST(Rules, MappedFromATenthOn) {
  EXPECT_EQ(with(&Facts::mapped_share, 0.09), Cause::sensed_not_mapped);
  EXPECT_EQ(with(&Facts::mapped_share, 0.1), Cause::mapped_not_avoided);
  // Who has it in its map has sensed it, whatever images showed.
  Facts unsensed = seen_in_time();
  unsensed.sensed_s = Facts::kNone;
  EXPECT_EQ(with(&Facts::mapped_share, 0.09, unsensed), Cause::not_sensed);
  EXPECT_EQ(with(&Facts::mapped_share, 0.1, unsensed), Cause::mapped_not_avoided);
}

TEST(Rules, NoPlanFoundFromHalfOfTheCallsOn) {
  EXPECT_EQ(with(&Facts::no_plan_share, 0.49), Cause::mapped_not_avoided);
  EXPECT_EQ(with(&Facts::no_plan_share, 0.5), Cause::no_plan_found);
}

TEST(Rules, TheFirstThatHoldsIsTheCause) {
  // From the last to the first.
  Facts facts = seen_in_time();
  const auto then = [&facts](double Facts::*fact, double value, Cause cause) {
    facts.*fact = value;
    EXPECT_EQ(collision_cause(facts, true), cause);
  };
  then(&Facts::no_plan_share, 0.8, Cause::no_plan_found);
  then(&Facts::mapped_share, 0.0, Cause::sensed_not_mapped);
  then(&Facts::sensed_s, 6.0, Cause::not_sensed);
  then(&Facts::in_range_s, 6.0, Cause::too_late_for_speed);
  then(&Facts::unoccluded_s, 6.0, Cause::occluded);
  then(&Facts::in_cone_s, 6.0, Cause::out_of_view);
  then(&Facts::sight_input_count, 1.0, Cause::out_of_view);
  then(&Facts::sight_input_count, 0.0, Cause::blind);
  facts.tracking_error_m = 0.4;
  then(&Facts::commanded_clearance_m, 0.2, Cause::tracking);
  facts.obstacle_way_m = 0.3;
  then(&Facts::still_clearance_m, 0.1, Cause::moved_into);
}

/// Of a time-out after 40 s with none of the causes that come before the length of the path.
Facts roaming() {
  Facts facts;
  facts.goal_clearance_m = 0.3;
  facts.hover_share = 0.1;
  facts.late_no_plan_share = 0.2;
  facts.progress_s = 35.0;
  facts.return_count = 0.0;
  facts.flown_m = 20.0;
  facts.reference_length_m = 30.0;
  return facts;
}

Cause out_of_time(double Facts::*fact, double value, Facts facts = roaming()) {
  facts.*fact = value;
  return timeout_cause(facts, 40.0, 0.5);
}

TEST(Rules, BlockedGoalBelowHalfTheBodysWidth) {
  EXPECT_EQ(out_of_time(&Facts::goal_clearance_m, 0.249), Cause::blocked_goal);
  EXPECT_EQ(out_of_time(&Facts::goal_clearance_m, 0.25), Cause::slow);
}

TEST(Rules, HoverFromHalfOfTheSecondHalfOnByWhetherThereWasAPlan) {
  EXPECT_EQ(out_of_time(&Facts::hover_share, 0.49), Cause::slow);
  EXPECT_EQ(out_of_time(&Facts::hover_share, 0.5), Cause::commanded_hover);
  Facts facts = roaming();
  facts.hover_share = 0.5;
  EXPECT_EQ(out_of_time(&Facts::late_no_plan_share, 0.49, facts), Cause::commanded_hover);
  EXPECT_EQ(out_of_time(&Facts::late_no_plan_share, 0.5, facts), Cause::hover_without_plan);
}

TEST(Rules, TrapBeforeThreeQuartersOfTheTimeAndWithAReturn) {
  Facts facts = roaming();
  facts.return_count = 1.0;
  EXPECT_EQ(out_of_time(&Facts::progress_s, 29.9, facts), Cause::trap);
  EXPECT_EQ(out_of_time(&Facts::progress_s, 30.0, facts), Cause::slow);
  facts.progress_s = 10.0;
  EXPECT_EQ(out_of_time(&Facts::return_count, 0.0, facts), Cause::slow);
}

TEST(Rules, DetourFromTheShortestPathsLengthOn) {
  EXPECT_EQ(out_of_time(&Facts::flown_m, 29.9), Cause::slow);
  EXPECT_EQ(out_of_time(&Facts::flown_m, 30.0), Cause::detour);
  EXPECT_EQ(out_of_time(&Facts::reference_length_m, Facts::kNone), Cause::unexplained);
}

TEST(Rules, FlewOutWhereItWasCommandedToWithinThirtyCentimetresOfTheBorder) {
  Facts facts;
  EXPECT_EQ(leaving_cause(facts), Cause::flew_out) << "by rates";
  facts.commanded_outside_m = -0.3;
  EXPECT_EQ(leaving_cause(facts), Cause::tracking);
  facts.commanded_outside_m = -0.29;
  EXPECT_EQ(leaving_cause(facts), Cause::flew_out);
  facts.commanded_outside_m = 0.5;
  EXPECT_EQ(leaving_cause(facts), Cause::flew_out);
}

}  // namespace
}  // namespace avoidbench
