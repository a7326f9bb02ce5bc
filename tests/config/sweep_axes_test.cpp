// Every field of a trial can be swept by its path.
#include "config/sweep_axes.hpp"

#include <algorithm>

#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"
#include "trial/map_fields.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;

struct SweepPath {
  std::string path;  ///< as in a sweep file
  std::string kind;  ///< what else must be said for it: "maps: {generator: hall}\n"
  const FieldTree* field = nullptr;
};

void add_paths(const FieldTree& key, std::vector<SweepPath>& paths) {
  for (const KindField& entry : all_fields(key)) {
    const FieldKind kind = entry.field->kind;
    if (kind == FieldKind::block || kind == FieldKind::variant || kind == FieldKind::other)
      continue;
    std::string words;
    for (const SaidKind& word : entry.kinds) {
      words += (words.empty() ? "" : ", ") + word.path + ": " + word.kind;
    }
    const std::string said = words.empty() ? "" : key.name + ": {" + words + "}";
    paths.push_back({key.name + "." + entry.path, said, entry.field});
  }
}

std::vector<SweepPath> sweep_paths(const FieldTree& sweep) {
  std::vector<SweepPath> paths;
  for (const FieldTree& key : sweep.fields) {
    if (key.kind == FieldKind::block) add_paths(key, paths);
  }
  return paths;
}

/// Maps from files need one.
std::string with_file(std::string kind) {
  if (kind.ends_with("mesh}")) kind.insert(kind.size() - 1, ", file: a.obj");
  if (kind.ends_with("point_cloud}")) kind.insert(kind.size() - 1, ", file: a.ply");
  return kind;
}

TEST_F(SweepFiles, EveryFieldCanBeAnAxisByItsPath) {
  write("a.obj", "v 0 0 0\n");
  write("a.ply", "ply\n");
  const FieldTree tree = sweep_tree();
  const std::vector<SweepPath> paths = sweep_paths(tree);
  EXPECT_GT(paths.size(), 200U);
  for (const SweepPath& path : paths) {
    Json value = path.field->preset;
    const bool is_map_file = path.field->name == "file" && path.path.starts_with("maps.");
    if (is_map_file) value = path.kind.ends_with("mesh}") ? "a.obj" : "a.ply";
    const std::string text = "sweep: a\nplanners: [tunable]\n" + with_file(path.kind) +
                             "\naxes: {" + path.path + ": " + Json::array({value}).dump() + "}\n";
    SCOPED_TRACE(text);
    ASSERT_EQ(problems(text), "");
    const SweepSpec sweep = read(text);
    ASSERT_EQ(sweep.axes.size(), 1U);
    EXPECT_EQ(sweep.axes[0].path, trial_path(path.path));
    if (is_map_file) value = (folder_ / value.get<std::string>()).string();
    EXPECT_EQ(sweep.axes[0].values, std::vector<Json>{value});
    if (path.field->name.starts_with("file")) continue;  // the maps are none
    const std::vector<PlannedTrial> trials = expand(sweep);
    ASSERT_EQ(trials.size(), 10U);
    TrialSpec expected = sweep.base;
    expected.planner = sweep.planners.front();
    EXPECT_EQ(spec_to_json(trials.front().spec()), spec_to_json(expected));
  }
}

TEST_F(SweepFiles, EveryFieldCanBeAnAxisInItsPlace) {
  write("a.obj", "v 0 0 0\n");
  write("a.ply", "ply\n");
  const FieldTree tree = sweep_tree();
  const std::vector<SweepPath> paths = sweep_paths(tree);
  EXPECT_GT(paths.size(), 150U);
  for (const SweepPath& path : paths) {
    if (path.field->name == "file" || path.field->name == "seeds") continue;
    // A list of one value is no axis, but read as one: a list of lists for a list.
    const std::string value = Json::array({path.field->preset}).dump();
    const std::string head = "sweep: a\nplanners: [tunable]\n" + with_file(path.kind) + "\n";
    SCOPED_TRACE(head + path.path + "=" + value);
    EXPECT_EQ(problems(head, {path.path + "=" + value}), "");
  }
}

/// What counts a sweep's missions by the names of its axes has to agree with the keys of maps.
TEST(MapKey, DependsOnTheFieldsThatMakeMaps) {
  const Json base = spec_to_json(TrialSpec{}), fields = base.flatten();
  const std::string key = map_key(TrialSpec{});
  int making = 0;
  for (const auto& [pointer, value] : fields.items()) {
    if (!value.is_number() && !value.is_boolean()) continue;
    Json changed = base;
    Json& field = changed.at(Json::json_pointer(pointer));
    if (value.is_boolean()) {
      field = !value.get<bool>();
    } else if (value.is_number_float()) {
      field = value.get<double>() + 0.125;
    } else {
      field = value.get<std::int64_t>() + 1;
    }
    std::string path = pointer.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    // An axis has whole lists.
    while (path.find_last_not_of("0123456789") == path.rfind('.')) path.erase(path.rfind('.'));
    EXPECT_EQ(map_key(spec_from_json<TrialSpec>(changed)) != key, makes_maps(path)) << path;
    making += makes_maps(path) ? 1 : 0;
  }
  EXPECT_GT(making, 10);
  EXPECT_TRUE(makes_maps("map.file"));  // by its digest
}

TEST_F(SweepFiles, SeedsOfMissionsCanBeAnAxis) {
  const std::string head = "sweep: a\nplanners: [tunable]\n";
  for (const std::string text : {"seed: [1, 2]\n", "axes: {seed: [1, 2]}\n"}) {
    const SweepSpec sweep = read(head + text);
    ASSERT_EQ(sweep.axes.size(), 1U);
    EXPECT_EQ(sweep.axes[0].path, "seed");
    EXPECT_EQ(Json(sweep.axes[0].values).dump(), "[1,2]");
    EXPECT_EQ(expand(sweep).back().spec().seed, 2U);
  }
}

TEST_F(SweepFiles, WhatIsNoSettingIsNoAxis) {
  const std::string head = "sweep: a\nplanners: [tunable]\naxes: {";
  const std::pair<const char*, const char*> cases[] = {
      {"mission_index: [1]", "'trials' says how many missions there are"},
      {"trials: [1]", "'trials' says how many missions there are"},
      {"maps.generator: [hall]", "a generator can't be an axis; write one sweep for each"},
      {"sensor.kind: [depth_noisy]", "a kind can't be an axis; write one sweep for each"},
      {"sensor: [depth_noisy]", "is a group of fields, not one"},
      {"maps.bounds: [1]", "unknown key"},
      {"planners.label: [a]", "write a planner's parameters as lists in its entry of 'planners'"},
      {"\"wind.mean_world_mps[0]\": [1]", "elements of lists can't be axes; give complete lists"},
  };
  for (const auto& [axis, expected] : cases) {
    const std::string found = problems(head + axis + "}\n");
    EXPECT_NE(found.find(expected), std::string::npos) << axis << "\n" << found;
    EXPECT_TRUE(found.starts_with("s.yaml:3:8: ")) << axis << "\n" << found;
  }
}

TEST_F(SweepFiles, EveryKindOfPlannerParameterCanBeAnAxis) {
  const SweepSpec sweep = read(
      "sweep: a\nplanners:\n  - {plugin: tunable, label: mine, max_speed_mps: [2, 4], parameters: {"
      "horizon_m: {from: 5, to: 7.5, count: 2}, steps_count: [1, 2], mode: [safe, fast], "
      "note: [x, y]}}\n");
  ASSERT_EQ(sweep.planners.size(), 32U);
  std::set<std::string> labels, parameters;
  for (const PlannerChoice& planner : sweep.planners) {
    labels.insert(planner.label);
    parameters.insert(spec_to_json(planner).at("parameters").dump());
  }
  EXPECT_EQ(labels.size(), 32U);
  EXPECT_EQ(parameters.size(), 32U);
  EXPECT_EQ(sweep.planners.front().label,
            "mine[horizon_m=5,steps_count=1,mode=safe,note=x,max_speed_mps=2]");
  // Every trial of theirs is another one.
  std::set<std::string> keys;
  for (const PlannedTrial& trial : expand(sweep)) keys.insert(trial_key(trial.spec()));
  EXPECT_EQ(keys.size(), 320U);
}

TEST_F(SweepFiles, ValuesGivenTwiceAreRefusedInListsOfListsToo) {
  const std::string head = "sweep: a\nplanners: [tunable]\n";
  EXPECT_EQ(problems(head + "maps: {area_m: [[40, 40], [40.0, 4e1]]}\n"),
            "s.yaml:3:27: maps.area_m: a list is given twice");
  EXPECT_EQ(problems(head + "axes: {wind.mean_world_mps: [[0, 0, 1], [0, 1, 0]]}\n"), "");
}

}  // namespace
}  // namespace avoidbench
