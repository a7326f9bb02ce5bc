#include "explain/paragraph.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

TEST(Facts, ComeBackFromTheirText) {
  Facts facts;
  facts.contact_s = 3.25;
  facts.mapped_share = 0.1 + 0.2;  // all digits
  const std::string text = facts_json(facts);
  EXPECT_EQ(text, R"({"contact_s":3.25,"mapped_share":0.30000000000000004})");
  const Facts back = facts_from_json(text);
  EXPECT_EQ(back.contact_s, facts.contact_s);
  EXPECT_EQ(back.mapped_share, facts.mapped_share);
  EXPECT_TRUE(std::isnan(back.flown_m)) << "what has no value is left out";
  EXPECT_ANY_THROW(facts_from_json("[1"));
  EXPECT_ANY_THROW(facts_from_json(R"({"contact_s":"soon"})"));
}

TEST(Paragraph, SaysWhatWasMeasuredAndNothingElse) {
  CauseFound found{.cause = Cause::occluded, .facts = {}};
  found.facts.contact_s = 4.0;
  found.facts.last_chance_s = 3.2;
  found.facts.last_chance_way_m = 2.0;
  found.facts.last_chance_speed_mps = 3.0;
  found.facts.last_chance_need_m = 1.9;
  found.facts.reaction_s = 0.1;
  found.facts.in_cone_s = 1.0;
  found.facts.no_plan_share = 0.0;
  const std::string text = paragraph(found, Outcome::collided, "touched tree 3");
  EXPECT_EQ(text.substr(0, text.find(". ") + 1), "collided: touched tree 3.");
  EXPECT_NE(text.find("last chance to stop was at 3.20 s: 2.00 m before"), std::string::npos)
      << text;
  EXPECT_NE(text.find("field of view from 1.00 s on, unoccluded never"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_EQ(text.find("no plan"), std::string::npos) << "of none it says nothing";
  EXPECT_EQ(text.back(), '.');
  EXPECT_EQ(decisive_s(found, 4.0), 3.2);
  EXPECT_EQ(cause_text(Cause::occluded), "occluded: something hid it until too late");
  EXPECT_EQ(decisive_s({.cause = Cause::gave_up, .facts = {}}, 4.0), 4.0);
}

TEST(Paragraph, NamesWhatThePlannerWasShown) {
  CauseFound found{.cause = Cause::sensed_not_avoided, .facts = {}};
  found.facts.contact_s = 4.0;
  found.facts.depth_image_count = 30.0;
  found.facts.sensed_image_count = 9.0;
  for (const auto& [sweeps, words] : {std::pair(0.0, "Of 30 depth images 9 showed it"),
                                      std::pair(30.0, "Of 30 sweeps 9 showed it"),
                                      std::pair(10.0, "Of 30 depth images and sweeps 9")}) {
    found.facts.sweep_count = sweeps;
    const std::string text = paragraph(found, Outcome::collided, "touched tree 3");
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

TEST(Paragraph, OfATimeOutSaysHowItWent) {
  CauseFound found{.cause = Cause::trap, .facts = {}};
  found.facts.flown_m = 30.0;
  found.facts.reference_length_m = 20.0;
  found.facts.mean_speed_mps = 1.5;
  found.facts.closest_m = 7.0;
  found.facts.closest_s = 9.5;
  found.facts.progress_s = 6.0;
  found.facts.hover_share = 0.25;
  found.facts.late_no_plan_share = 0.5;
  found.facts.return_count = 2.0;
  found.facts.goal_clearance_m = 1.5;
  const std::string text = paragraph(found, Outcome::timed_out, "7.1 m from the goal");
  EXPECT_NE(text.find("stood still for 25 % of the time, and 50 % of the calls gave no plan"),
            std::string::npos)
      << text;
  EXPECT_NE(
      text.find("nearest to the goal, 7.00 m, at 9.50 s, and was first within 0.5 m of that at "
                "6.00 s"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("came back 2 times"), std::string::npos) << text;
  EXPECT_EQ(decisive_s(found, 20.0), 6.0);
}

}  // namespace
}  // namespace avoidbench
