#include "sweep/limit_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

LimitRule speed_rule() {
  LimitRule rule;
  rule.field = "planner.max_speed_mps";
  rule.unit = "m/s";
  rule.values = {1.0, 2.5, 4.0};
  rule.width = 0.5;
  return rule;
}

TEST(LimitRule, LabelsLoseTheFieldAlone) {
  const LimitRule rule = speed_rule();
  EXPECT_EQ(label_without("ego[max_speed_mps=3]", rule), "ego");
  EXPECT_EQ(label_without("ego[max_speed_mps=3,a=1]", rule), "ego[a=1]");
  EXPECT_EQ(label_without("ego[a=1,max_speed_mps=3]", rule), "ego[a=1]");
  EXPECT_EQ(label_without("ego[a=1,max_speed_mps=3,b=2]", rule), "ego[a=1,b=2]");
  EXPECT_EQ(label_without("ego", rule), "ego");
  EXPECT_EQ(label_without("ego[my_max_speed_mps=3]", rule), "ego[my_max_speed_mps=3]");
  LimitRule radius = rule;
  radius.field = "map.poisson_radius_m";
  EXPECT_EQ(label_without("ego[max_speed_mps=3]", radius), "ego[max_speed_mps=3]");
}

TEST(LimitRule, LevelsAreTheRulesValues) {
  EXPECT_EQ(level_of(speed_rule(), 2.5), 1u);
  EXPECT_EQ(level_of(speed_rule(), std::nextafter(2.5, 3.0)), 1u);
  EXPECT_EQ(level_of(speed_rule(), 2.6), std::nullopt);
  EXPECT_DOUBLE_EQ(speed_rule().value_at(0.5), 2.5);
}

TEST(LimitRule, WithoutAWidthNoIntervalIsNarrowEnough) {
  LimitRule rule = speed_rule();
  EXPECT_DOUBLE_EQ(rule.relative_width(), 0.5 / 3.0);
  rule.width = LimitRule{}.width;
  EXPECT_EQ(rule.relative_width(), 0.0);
}

TEST(LimitRule, MapsThatDifferInTheFieldAreOnePlace) {
  LimitRule rule = speed_rule();
  rule.field = "map.poisson_radius_m";
  const auto place = [&](double radius_m, double height_m, std::uint64_t seed) {
    return map_place({{"poisson_radius_m", radius_m}, {"height_m", height_m}}, seed, rule);
  };
  EXPECT_EQ(place(2.0, 3.0, 1), place(5.0, 3.0, 1));
  EXPECT_NE(place(2.0, 3.0, 1), place(2.0, 3.0, 2));
  EXPECT_NE(place(2.0, 3.0, 1), place(2.0, 4.0, 1));
}

TEST(LimitRule, IsStoredAndReadAgain) {
  const nlohmann::json spec{{"name", "x"}, {"limit", to_json(speed_rule())}};
  const auto read = limit_rule_of(spec.dump());
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json(*read), to_json(speed_rule()));
  EXPECT_FALSE(to_json(speed_rule()).contains("direction")) << "older sweeps have none";
  LimitRule falls = speed_rule();
  falls.direction = LimitDirection::falls;
  const nlohmann::json known{{"limit", to_json(falls)}};
  EXPECT_EQ(limit_rule_of(known.dump()).value().direction, LimitDirection::falls);
  EXPECT_EQ(limit_rule_of(R"({"name": "x"})"), std::nullopt);
  EXPECT_EQ(limit_rule_of(""), std::nullopt);
}

TEST(LimitRule, DamagedOnesAreRefused) {
  const nlohmann::json good = to_json(speed_rule());
  std::vector<nlohmann::json> damaged(8, good);
  damaged[0].erase("field");
  damaged[1]["values"] = {1.0};
  damaged[2]["values"] = {3.0, 2.0};
  damaged[3]["success_rate"] = 1.0;
  damaged[4]["width"] = -1.0;
  damaged[5]["values"] = "many";
  damaged[6]["direction"] = "sideways";
  damaged[7]["direction"] = 1;
  for (const nlohmann::json& rule : damaged) {
    EXPECT_THROW(limit_rule_of(nlohmann::json{{"limit", rule}}.dump()), InputError) << rule;
  }
}

}  // namespace
}  // namespace avoidbench
