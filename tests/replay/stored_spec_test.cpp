#include "replay/stored_spec.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "store/stored_text.hpp"
#include "sweep/sweep_rows.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

json canonical(const TrialSpec& spec) { return json::parse(trial_json(spec)); }

/// What is wrong with the default spec after this element was set.
std::string fault_after(const std::string& place, const json& value) {
  json spec = canonical({});
  spec[json::json_pointer(place)] = value;
  try {
    stored_spec(spec.dump());
  } catch (const BadText& bad) {
    return bad.what();
  }
  return "";
}

TEST(StoredSpec, WhatTheProgramStoresIsTaken) {
  TrialSpec spec;
  EXPECT_EQ(trial_json(stored_spec(trial_json(spec))), trial_json(spec));
  for (const MapSpec& map :
       {MapSpec{ForestSpec{}}, MapSpec{HallSpec{}}, MapSpec{AvoidbenchForestSpec{}},
        MapSpec{AvoidbenchIndoorSpec{}}, MapSpec{MazeSpec{}}, MapSpec{GapWallsSpec{}},
        MapSpec{DeadEndsSpec{}}, MapSpec{PolesSpec{}}, MapSpec{OverhangsSpec{}}}) {
    spec.map = map;
    spec.latency.mode = LatencyMode::measured;
    EXPECT_EQ(trial_key(stored_spec(trial_json(spec))), trial_key(spec)) << kind(map);
  }
}

TEST(StoredSpec, OtherTypesAndValuesAreRefused) {
  for (const auto& [place, value] : {std::pair<std::string, json>{"/map/generator", "castle"},
                                     {"/map/generator", 3},
                                     {"/map/poisson_radius_m", 1e-9},
                                     {"/map/poisson_radius_m", "3"},
                                     {"/map/poisson_radius_m", nullptr},
                                     {"/map/area_m", json::array({40.0})},
                                     {"/map/area_m", json::array({1e9, 1e9})},
                                     {"/map", json::array()},
                                     {"/map_seed", -1},
                                     {"/map_seed", 1.5},
                                     {"/seed", "1"},
                                     {"/mission_index", -1},
                                     {"/mission_index", 1e18},
                                     {"/mission", 7},
                                     {"/mission/time_limit_s", 1e9},
                                     {"/mission/max_collisions", 0.5},
                                     {"/rates/physics_hz", 7.7},
                                     {"/rates/physics_hz", 1e6},
                                     {"/sensor/width_px", 1'000'000'000},
                                     {"/sensor/width_px", 1e300},
                                     {"/latency/mode", "never"},
                                     {"/latency", json::array()},
                                     {"/planner", "x"},
                                     {"/planner/parameters", json::object()},
                                     {"/planner/parameters", json::array({3})},
                                     {"/planner/label", 5},
                                     {"/wind", nullptr},
                                     {"/vehicle", 3}}) {
    EXPECT_NE(fault_after(place, value), "") << place << " = " << value;
  }
}

TEST(StoredSpec, WhatIsNoSpecIsRefused) {
  std::string deep(100000, '[');
  for (const std::string& text : {std::string(), std::string("{}"), std::string("[1"),
                                  std::string("7"), deep, "{\"planner\":" + deep}) {
    EXPECT_THROW(stored_spec(text), BadText) << text.substr(0, 20);
  }
  for (const char* block : {"map", "planner"}) {
    json spec = canonical({});
    spec.erase(block);
    EXPECT_THROW(stored_spec(spec.dump()), BadText) << block;
  }
}

TEST(StoredSpec, AFieldThatIsNotThereIsAtItsDefault) {
  // As where a later program has a new one.
  TrialSpec calm;
  calm.mission.goal_radius_m = 2.0;
  json spec = json::parse(trial_json(calm));
  spec.erase("wind");
  spec["mission"].erase("time_limit_s");
  const TrialSpec read = stored_spec(spec.dump());
  EXPECT_EQ(trial_key(read), trial_key(calm));
  EXPECT_EQ(read.mission.goal_radius_m, 2.0);
}

}  // namespace
}  // namespace avoidbench
