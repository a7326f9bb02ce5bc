// Each field of the blocks that are not maps', vehicles' or cameras', with values that it can't
// have.
#include <cmath>
#include <string>
#include <vector>

#include "config/field_tree.hpp"
#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

/// A value, where in its text the problem is, and a part of what is said.
struct BadValue {
  std::string text;
  std::size_t place = 0;
  std::string path;  ///< behind the field's: "[1]"
  std::string said;
};

/// Numbers beyond the range, and what is none.
std::vector<BadValue> bad_numbers(const FieldTree& field) {
  const std::string outside = " is outside [" + number_text(field.range.lowest) + ", " +
                              number_text(field.range.highest) + "]";
  std::vector<BadValue> bad;
  for (const double value : {field.range.lowest - 1.0, field.range.highest + 1.0}) {
    bad.push_back({number_text(value), 0, "", number_text(value) + outside});
  }
  for (const char* word : {"many", ".nan", ".inf", "1e999", "''", "0x1g", "~"}) {
    bad.push_back({word, 0, "", ""});
  }
  return bad;
}

/// Values that a field of its kind can't have.
std::vector<BadValue> bad_values(const FieldTree& field) {
  if (is_number(field)) return bad_numbers(field);
  if (field.kind == FieldKind::choice)
    return {{"no_such_word", 0, "", "is not one of"}, {"7", 0, "", "is not one of"}};
  if (field.kind == FieldKind::truth)
    return {{"maybe", 0, "", "expected"}, {"7", 0, "", "expected"}};
  if (field.kind != FieldKind::list || !is_number(field.fields.front())) return {};
  std::vector<BadValue> bad;
  const std::size_t count = field.count.value_or(2);
  // Each element in turn, the others being good.
  for (std::size_t wrong = 0; wrong < count; ++wrong) {
    for (const BadValue& number : bad_numbers(field.fields.front())) {
      std::string text = "[";
      std::size_t place = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) text += ", ";
        if (i == wrong) place = text.size();
        text += i == wrong ? number.text : number_text(field.fields.front().range.lowest);
      }
      bad.push_back({text + "]", place, "[" + std::to_string(wrong) + "]", number.said});
    }
  }
  if (field.count) {
    bad.push_back({"[]", 0, "", "expected a list of " + std::to_string(count) + " values"});
    bad.push_back({"{}", 0, "", "expected a list"});
  }
  return bad;
}

class BadValues : public SweepFiles {
 protected:
  /// The line `before` NAME: VALUE `after` has its problem at the value, by its path.
  void expect_refused(const std::string& before, const std::string& path, const FieldTree& field,
                      const std::string& after) {
    for (const BadValue& bad : bad_values(field)) {
      const std::string head = before + field.name + ": ";
      const std::string text = "sweep: a\nplanners: [tunable]\n" + head + bad.text + after + "\n";
      const std::string found = problems(text);
      const std::string place = "s.yaml:3:" + std::to_string(head.size() + bad.place + 1) + ": " +
                                path + field.name + bad.path + ": ";
      EXPECT_NE(("\n" + found).find("\n" + place), std::string::npos)
          << text << "should be wrong at " << place << "but it says: " << found;
      EXPECT_NE(found.find(bad.said), std::string::npos) << text << found;
      ++tried_;
    }
    // A slip of the pen is told from what is there.
    const std::string slip = before + field.name + "x: 1" + after + "\n";
    const std::string found = problems("sweep: a\nplanners: [tunable]\n" + slip);
    const std::string place = "s.yaml:3:" + std::to_string(before.size() + 1) + ": " + path +
                              field.name + "x: unknown key";
    EXPECT_NE(("\n" + found).find("\n" + place), std::string::npos) << slip << found;
  }

  int tried_ = 0;
};

TEST_F(BadValues, OfMoversTracksAndMissionsHaveTheirPlace) {
  for (const std::string block : {"movers", "tracks", "mission", "mission.goal_motion"}) {
    const std::size_t dot = block.find('.');
    const bool is_nested = dot != std::string::npos;
    const FieldTree* tree = sweep_tree().find(block.substr(0, dot));
    if (is_nested) tree = tree->find(block.substr(dot + 1));
    ASSERT_NE(tree, nullptr) << block;
    const std::string before =
        is_nested ? block.substr(0, dot) + ": {" + block.substr(dot + 1) + ": {" : block + ": {";
    int fields = 0;
    for (const FieldTree& field : tree->fields) {
      if (bad_values(field).empty()) continue;
      expect_refused(before, block + ".", field, is_nested ? "}}" : "}");
      ++fields;
    }
    EXPECT_GE(fields, 3) << block;
  }
  EXPECT_GT(tried_, 200);
}

/// Of lidars in a rig, of both kinds, and of the second of two.
TEST_F(BadValues, OfLidarsHaveTheirPlace) {
  const FieldTree* lidars = sweep_tree().find("sensor")->find("lidars");
  ASSERT_NE(lidars, nullptr);
  for (const std::string kind : {"lidar_spinning", "lidar_pattern"}) {
    const std::string before = "sensor: {lidars: [velodyne_16, {kind: " + kind + ", ";
    int fields = 0;
    for (const KindField& entry : all_fields(lidars->fields.front())) {
      const bool is_there = entry.kinds.empty() || entry.kinds.back().kind == kind;
      if (!is_there || bad_values(*entry.field).empty()) continue;
      expect_refused(before, "sensor.lidars[1].", *entry.field, "}]}");
      ++fields;
    }
    EXPECT_GE(fields, 12) << kind;
  }
  EXPECT_GT(tried_, 300);
}

/// A block that is no mapping, or stands twice.
TEST_F(BadValues, OfWholeBlocksHaveTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"movers: 7", "s.yaml:3:9: movers: "},
      {"movers: [{count: 3}]", "s.yaml:3:9: movers"},
      {"tracks: fast", "s.yaml:3:9: tracks: "},
      {"mission: {goal_motion: circle}", "s.yaml:3:24: mission.goal_motion: "},
      {"sensor: {lidars: velodyne_16}", "s.yaml:3:18: sensor.lidars: "},
      {"sensor: {lidars: [7]}", "s.yaml:3:19: sensor.lidars[0]: "},
      {"sensor: {lidars: [[7]]}", "s.yaml:3:20: sensor.lidars[0]: "},  // an axis
      {"sensor: {lidars: [{lidars: []}]}", "s.yaml:3:20: sensor.lidars[0].lidars: unknown key"},
      {"sensor: {lidars: [{kind: depth_ideal}]}", "s.yaml:3:26: sensor.lidars[0].kind: "},
      {"sensor: {lidars: [{preset: surround}]}", "s.yaml:3:28: sensor.lidars[0]"},
      {"tracks: {rate_hz: {a: 1}}", "s.yaml:3:20: tracks.rate_hz.a: unknown key of a range"},
      {"mission: {waypoints: {from: 0, to: 3}}", "s.yaml:3:22: mission.waypoints: "},
      {"movers: {count: [1, 2, -3]}", "s.yaml:3:24: movers.count: -3 is outside [0, 2000]"},
      {"axes: {tracks.rate_hz: [1, 0]}", "s.yaml:3:28: tracks.rate_hz: 0 is outside"},
      {"axes: {movers.cuont: [1, 0]}", "s.yaml:3:8: movers.cuont: unknown key"},
      {"axes: {mission.goal_motion.path: [circle, square]}",
       "s.yaml:3:43: mission.goal_motion.path: \"square\" is not one of"},
      {"movers: {count: 3}\nmovers: {count: 4}", "s.yaml:4:1: "},
  };
  for (const auto& [text, problem] : cases) {
    const std::string found =
        problems(std::string("sweep: a\nplanners: [tunable]\n") + text + "\n");
    EXPECT_TRUE(found.starts_with(problem)) << text << "\n" << found;
  }
}

}  // namespace
}  // namespace avoidbench
