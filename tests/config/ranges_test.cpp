// The ranges of fields, as schemas and help tell them.
#include <nlohmann/json.hpp>
#include <string>

#include "config/json_schema.hpp"
#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"

namespace avoidbench {
namespace {

/// One that ends where it begins, or before, has its ends wrong.
TEST(Ranges, OfEveryNumberHoldMoreThanOne) {
  int count = 0;
  for (const FieldTree* tree : {&sweep_tree(), &vehicle_tree(), &sensor_tree()}) {
    for (const KindField& entry : all_fields(*tree)) {
      for (const FieldTree* field = entry.field; field != nullptr;
           field = field->kind == FieldKind::list ? &field->fields.front() : nullptr) {
        if (!is_number(*field)) continue;
        ++count;
        EXPECT_LT(field->range.lowest, field->range.highest) << entry.path;
      }
    }
  }
  EXPECT_GT(count, 100);
}

/// What the key of a listed mission may be is told apart from what reads it.
TEST_F(SweepFiles, AListedMissionsRangesAreThoseThatItIsReadBy) {
  const auto fields = fields_at(sweep_tree(), "mission.list");
  ASSERT_EQ(fields.size(), 1U);
  const FieldTree& mission = fields.front().field->fields.front();
  const auto problems_of_mission = [&](double yaw_deg, double goal_m) {
    return problems(
        "sweep: a\nplanners: [tunable]\nmission: {list: [{start: [0, 0, 1], goal: [0, " +
        std::to_string(goal_m) + ", 1], yaw_deg: " + std::to_string(yaw_deg) + "}]}\n");
  };
  const FieldTree* yaw = mission.find("yaw_deg");
  const FieldTree* goal = mission.find("goal");
  ASSERT_TRUE(yaw != nullptr && goal != nullptr);
  const Range yaw_deg = yaw->range, goal_m = goal->fields.front().range;
  EXPECT_EQ(problems_of_mission(yaw_deg.lowest, goal_m.lowest), "");
  EXPECT_EQ(problems_of_mission(yaw_deg.highest, goal_m.highest), "");
  EXPECT_NE(problems_of_mission(yaw_deg.lowest - 1.0, 5.0), "");
  EXPECT_NE(problems_of_mission(yaw_deg.highest + 1.0, 5.0), "");
  EXPECT_NE(problems_of_mission(0.0, goal_m.lowest - 1.0), "");
  EXPECT_NE(problems_of_mission(0.0, goal_m.highest + 1.0), "");
}

/// Where neither kind nor preset is said, the kind of a whole file is the default's; one that is
/// laid over another does not know it, and may have the fields of any.
TEST(Schemas, OfASensorLaidOverAnotherLetThroughTheFieldsOfEveryKind) {
  const nlohmann::ordered_json definitions = sensor_schema().at("$defs");
  const auto without_a_kind = [&](const std::string& definition) {
    for (const auto& rule : definitions.at(definition).at("allOf")) {
      if (rule.at("if").contains("not")) return rule.at("then");
    }
    return nlohmann::ordered_json();
  };
  EXPECT_TRUE(without_a_kind("sensor_file").contains("else"));
  EXPECT_EQ(without_a_kind("over.sensor_file"),
            (nlohmann::ordered_json{{"$ref", "#/$defs/over.sensor.any_kind"}}));
}

}  // namespace
}  // namespace avoidbench
