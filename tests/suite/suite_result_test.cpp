#include "suite/suite_result.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "suite/suite_board.hpp"
#include "suite/suite_maps.hpp"
#include "suite/suite_samples.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using suite_samples::result_of;
using suite_samples::SmallSuite;
using test::has;
using test::message_of;

double three(const std::string& /*cell*/, std::int64_t map, std::int64_t /*mission*/) {
  return map == 0 ? 3.0 : 0.0;
}

TEST(SuiteResult, ReadsWhatItWrote) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  SuiteResult result = result_of(suite, "=mine, \"too\"", three);
  result.split = Split::sealed;
  result.key_sha256 = suite.sealed_key_sha256;
  result.is_privileged = true;
  result.rows[0].end_time_s = std::nan("");
  result.rows[0].goal_velocity_mps = 0.1 + 0.2;
  const test::TemporaryFolder folder;
  write_result(result, folder.path());
  const SuiteResult read = read_result(folder.path());
  ASSERT_EQ(read.rows.size(), result.rows.size());
  EXPECT_TRUE(std::isnan(read.rows[0].end_time_s));
  EXPECT_EQ(read.rows[0].goal_velocity_mps, 0.1 + 0.2);
  for (std::size_t i = 1; i < read.rows.size(); ++i) EXPECT_EQ(read.rows[i], result.rows[i]) << i;
  EXPECT_EQ(read.label, result.label);
  EXPECT_EQ(read.split, Split::sealed);
  EXPECT_EQ(read.key_sha256, result.key_sha256);
  EXPECT_TRUE(read.is_privileged);
  EXPECT_EQ(read.planner.licence, "MIT");
  EXPECT_EQ(flow_text(read.planner.entry), flow_text(result.planner.entry));
}

TEST(SuiteResult, DamagedTablesAreRefusedWithTheirLine) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  const test::TemporaryFolder folder;
  write_result(result_of(suite, "mine", three), folder.path());
  const std::string table = read_input_file(folder / "trials.csv", 100'000);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = table;
    text.replace(text.find(from), from.size(), to);
    folder.write("trials.csv", text);
    return message_of([&] { read_result(folder.path()); });
  };
  EXPECT_TRUE(has(with("# avoidbench suite result", "# another"), "trials.csv:1: expected"));
  EXPECT_TRUE(has(with("map_seed", "seed"), "trials.csv:2: expected the columns"));
  EXPECT_TRUE(has(with("halls,hall,101,0", "halls,hall,101"), "trials.csv:3: 11 fields instead"));
  EXPECT_TRUE(has(with("reached_goal", "was_there"), "outcome: 'was_there' is invalid"));
}

/// Rows of a folder are as good as flights only if all are there.
TEST(SuiteBoard, RefusesAResultThatLacksTrials) {
  SuiteResult result = result_of(suite_track("avoidbench-1/depth").suite, "mine", three);
  result.split = Split::open;
  const test::TemporaryFolder folder;
  write_result(result, folder.path());
  EXPECT_EQ(boards_of({folder.path().string()}).front().entries.size(), 1U);
  result.rows.pop_back();
  write_result(result, folder.path());
  EXPECT_TRUE(
      has(message_of([&] { boards_of({folder.path().string()}); }), "479 trials, expected 480"));
  result.track_sha256 = std::string(64, '0');
  write_result(result, folder.path());
  EXPECT_TRUE(
      has(message_of([&] { boards_of({folder.path().string()}); }), "a different avoidbench-1"));
}

/// Scores are of cells: a failure that hides in another cell, or in none, would make its own
/// better.
TEST(SuiteBoard, RefusesRowsInOtherPlaces) {
  const SuiteSpec suite = suite_track("avoidbench-1/depth").suite;
  const SuiteResult result = result_of(suite, "mine", three);
  EXPECT_EQ(rows_problem(suite, result), "");
  const auto with = [&](auto change) {
    SuiteResult changed = result;
    change(changed.rows[1]);
    return rows_problem(suite, changed);
  };
  EXPECT_TRUE(has(with([](SuiteRow& row) { row.cell = "hall_3.0"; }), "no such sweep in a cell"));
  EXPECT_TRUE(has(with([](SuiteRow& row) { row.map_seed = 999; }), "maps are not those"));
  EXPECT_TRUE(has(with([](SuiteRow& row) { row.mission_index = 5; }), "no such mission"));
  EXPECT_TRUE(has(with([](SuiteRow& row) { row.mission_index = 0; }), "it is listed twice"));
  EXPECT_TRUE(has(with([](SuiteRow& row) { row.goal_velocity_mps = 9.0; }), "goal velocity 9 m/s"));
}

TEST(SuiteBoard, SaysHowFailuresEndedAndLinksFiles) {
  const test::TemporaryFolder folder;
  const SuiteResult result = result_of(suite_track("avoidbench-1/depth").suite, "mine", three);
  std::filesystem::create_directories(folder / "results/mine");
  write_result(result, folder / "results/mine");
  const std::vector<Board> boards = boards_of({(folder / "results/mine").string()});
  const nlohmann::ordered_json page = board_page(boards, {}, folder.path());
  const auto& entry = page.at("boards").at(0).at("results").at(0);
  EXPECT_EQ(entry.at("links").at("trials"), "results/mine/trials.csv");
  EXPECT_TRUE(entry.at("links").at("flights").is_null());
  EXPECT_EQ(entry.at("failures").at(0).at(0), "seen_too_late");
  EXPECT_EQ(entry.at("curve").at(0).at(0), 0.0);
}

TEST(SuiteMaps, DigestsAreOfWorldsAndMissions) {
  MapRecord map;
  map.world_digest = std::string(64, 'e');
  map.missions.emplace_back().reference_length_m = 20.0;
  const FrozenMaps frozen = frozen_maps({map});
  MapRecord other = map;
  other.missions[0].mission.goal_world.x() = 1e-9;
  EXPECT_EQ(frozen_maps({other}).maps_sha256, frozen.maps_sha256);
  EXPECT_NE(frozen_maps({other}).missions_sha256, frozen.missions_sha256);
  other = map;
  other.world_digest[0] = 'f';
  EXPECT_NE(frozen_maps({other}).maps_sha256, frozen.maps_sha256);
  SuiteSweep sweep;
  sweep.name = "hall";
  sweep.dev = frozen;
  EXPECT_EQ(maps_problem(sweep, Split::dev, frozen), "");
  EXPECT_EQ(maps_problem(sweep, Split::sealed, frozen), "");
  EXPECT_TRUE(has(maps_problem(sweep, Split::dev, frozen_maps({other})), "hall, dev: maps have"));
}

TEST(SuitePlanner, TakesPlannersAsSweepsDo) {
  const SmallSuite files;
  const SuiteTrack track = suite_track((files.folder() / "depth").string());
  const SuiteCell& cell = track.suite.cells[0];
  const SweepSeeds seeds = seeds_of(track.suite, cell, cell.sweeps[0], Split::open, "");
  const SweepSpec sweep = suite_sweep(track, cell.sweeps[0], seeds,
                                      suite_planner("straight_line", "s", {"max_speed_mps=2.5"}));
  EXPECT_EQ(sweep.base.seed, 2U);
  EXPECT_EQ(sweep.trials, 2);
  EXPECT_EQ(sweep.axes.at(0).values.size(), 2U);
  ASSERT_EQ(sweep.planners.size(), 1U);
  EXPECT_EQ(sweep.planners[0].label, "s");
  EXPECT_EQ(sweep.planners[0].parameters.at(0).number, 2.5);
  const std::string message = message_of([&] {
    suite_sweep(track, cell.sweeps[0], seeds, suite_planner("straight_line", "", {"max_sped=2"}));
  });
  EXPECT_TRUE(has(message, "max_sped")) << message;
  EXPECT_TRUE(has(message_of([] { suite_planner("ego", "", {"fast"}); }), "NAME=VALUE"));
}

TEST(SuitePlanner, ReadsAFileBesideWhichThePlannerLies) {
  const test::TemporaryFolder folder;
  const SuitePlanner planner = read_suite_planner(
      folder.write("planner.yaml",
                   "planner: {plugin: ./mine.so, parameters: {gain: 0.5, mode: \"1\"}}\n"
                   "licence: MIT\ntuned_on: avoidbench-1/depth dev\n"));
  EXPECT_EQ(planner.tuned_on, "avoidbench-1/depth dev");
  EXPECT_EQ(flow_text(planner.entry),
            "{plugin: \"./mine.so\", parameters: {gain: 0.5, mode: \"1\"}}");
  EXPECT_TRUE(has(message_of([&] { read_suite_planner(folder.write("p.yaml", "licence: MIT\n")); }),
                  "lacks 'planner'"));
}

}  // namespace
}  // namespace avoidbench
