#include "sweep/failure_kinds.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

TrialListing trial(std::int64_t id, const std::string& planner, Outcome outcome,
                   const std::string& reason) {
  TrialListing listing;
  listing.id = id;
  listing.planner_label = planner;
  listing.outcome = outcome;
  listing.reason = reason;
  return listing;
}

TEST(FailureKinds, AreByOutcomeTheMostFrequentFirstWithTheMostFrequentReason) {
  const std::vector<TrialListing> trials{
      trial(1, "ego", Outcome::reached_goal, "reached the goal after 3.2 s"),
      trial(2, "ego", Outcome::planner_error, "no room for 3 cells"),
      trial(3, "ego", Outcome::collided, "touched ground 0 at (1.00, -2.50, 0.10) m, 2.00 m/s"),
      trial(4, "mine", Outcome::collided, "touched trunk 12 at (1.00, 2.50, 3.00) m, 2.31 m/s"),
      trial(5, "mine", Outcome::collided, "touched trunk 7 at (-4.00, 2.50, 3.00) m, 0.50 m/s")};
  const std::vector<FailureKind> kinds = failure_kinds(trials);
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0].outcome, Outcome::collided);
  EXPECT_EQ(kinds[0].count, 3);
  EXPECT_EQ(kinds[0].alike_count, 2);
  EXPECT_EQ(kinds[0].example.id, 4);
  EXPECT_EQ(failure_text(kinds[0]),
            "3 collided (mine 2, ego 1), 2 as trial 4: touched trunk 12 at (1.00, 2.50, 3.00) m, "
            "2.31 m/s");
  EXPECT_EQ(failure_text(kinds[1]), "1 planner_error (ego 1): no room for 3 cells");
}

TEST(FailureKinds, AreNoneWhereAllReachedTheGoal) {
  const std::vector<TrialListing> trials{trial(1, "ego", Outcome::reached_goal, "")};
  EXPECT_TRUE(failure_kinds(trials).empty());
}

TEST(FailureKinds, SayAllWhereTheReasonIsEveryTrialsAndStayOneLine) {
  std::string reason = "first\nsecond ";
  for (int i = 0; i < 100; ++i) reason += "äö";
  const std::vector<TrialListing> trials{trial(1, "a", Outcome::planner_error, reason),
                                         trial(2, "a", Outcome::planner_error, reason)};
  const std::string text = failure_text(failure_kinds(trials).front());
  EXPECT_EQ(text.rfind("2 planner_error (a 2), all as trial 1: first\\nsecond ä", 0), 0U) << text;
  EXPECT_TRUE(text.ends_with("…")) << text;
  EXPECT_LT(text.size(), 220U);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  // No letter is cut in half: what is shown is all there.
  EXPECT_NE(text.find("äö"), std::string::npos);
  EXPECT_TRUE(text.ends_with("ä…") || text.ends_with("ö…")) << text;
}

}  // namespace
}  // namespace avoidbench
