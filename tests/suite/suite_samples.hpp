#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/digest.hpp"
#include "base/input_file.hpp"
#include "suite/suite_result.hpp"
#include "support/temporary_folder.hpp"

namespace avoidbench::suite_samples {

/// A suite of two tracks and two cells with tiny halls, in a folder of its own. The track `far` is
/// without the sweep `open`.
class SmallSuite {
 public:
  SmallSuite() {
    for (const std::string track : {"depth", "far"}) {
      std::filesystem::create_directory(files_ / track);
      for (const std::string sweep : {"hall", "poles", "open"}) {
        files_.write(track + "/" + sweep + ".yaml",
                     "sweep: " + sweep + "\nmaps: {generator: hall, area_m: [12, 14], " +
                         "poisson_radius_m: 5}\nsensor: {width_px: 32, height_px: 24}\n" +
                         "planners: [straight_line]\n");
      }
    }
    const std::string digest = file_digest(files_ / "depth/hall.yaml"), zeros(64, '0');
    const auto sweep = [&](const std::string& name) {
      const std::string far =
          name == "open" ? "" : ", far: " + file_digest(files_ / ("far/" + name + ".yaml"));
      return "      - {sweep: " + name + ", maps: 2, file_sha256: {depth: " +
             file_digest(files_ / ("depth/" + name + ".yaml")) + far +
             "}, dev: {maps_sha256: " + zeros + ", missions_sha256: " + zeros +
             "}, public: {maps_sha256: " + zeros + ", missions_sha256: " + zeros + "}}\n";
    };
    text_ =
        "suite: small-1\ntracks: {depth: Two tiny halls, far: The same}\nsplits:\n"
        "  dev: {seed: 1, first_map_seed: 1, missions: 1}\n"
        "  public: {seed: 2, first_map_seed: 101, missions: 2}\n"
        "  sealed: {key_sha256: " +
        sha256(key()) + ", missions: 1}\ncells:\n  - cell: halls\n    sweeps:\n" + sweep("hall") +
        "  - cell: others\n    sweeps:\n" + sweep("poles") + sweep("open");
    files_.write("suite.yaml", text_);
  }

  std::filesystem::path folder() const { return files_.path(); }
  std::string key() const { return std::string(64, 'a'); }
  std::string write(const std::string& name, const std::string& text) const {
    return files_.write(name, text);
  }
  /// Replaces the first of these texts in suite.yaml.
  void replace(const std::string& from, const std::string& to) {
    text_.replace(text_.find(from), from.size(), to);
    files_.write("suite.yaml", text_);
  }
  void append(const std::string& name, const std::string& text) const {
    std::ofstream(files_ / name, std::ios::app) << text;
  }

 private:
  test::TemporaryFolder files_;
  std::string text_;
};

/// A result with one row for each mission of the public split; `speed` gives the goal velocity of
/// a cell's map and mission, 0 for a collision.
template <class Speed>
SuiteResult result_of(const SuiteSpec& suite, const std::string& label, Speed speed) {
  SuiteResult result;
  result.suite = suite.name;
  result.track = suite.tracks.front();
  result.track_sha256 = track_of(suite, result.track).sha256;
  result.label = label;
  result.planner_name = "planner";
  result.planner_version = "1";
  result.planner_digest = std::string(64, 'c');
  result.program = "1.0 (abc)";
  result.planner = suite_planner("straight_line", label, {"max_speed_mps=3"});
  result.planner.licence = "MIT";
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      for (std::int64_t map = 0; map < sweep.map_count; ++map) {
        for (std::int64_t mission = 0; mission < suite.open.missions; ++mission) {
          const double velocity_mps = speed(cell.name, map, mission);
          const bool is_there = velocity_mps > 0.0;
          result.rows.push_back(
              {.cell = cell.name,
               .sweep = sweep.name,
               .map_seed = suite.open.first_map_seed + static_cast<std::uint64_t>(map),
               .mission_index = mission,
               .trial_key = sha256(cell.name + sweep.name + std::to_string(100 * map + mission)),
               .outcome = is_there ? Outcome::reached_goal : Outcome::collided,
               .reference_length_m = 20.0,
               .end_time_s = is_there ? 20.0 / velocity_mps : 4.0,
               .goal_velocity_mps = is_there ? 20.0 / (20.0 / velocity_mps) : 0.0,
               .path_length_m = 25.0,
               .cause = is_there ? "" : "seen_too_late",
               .flight_digest = std::string(64, 'd')});
        }
      }
    }
  }
  return result;
}

/// A suite of `cell_count` cells of twelve maps with five missions, in memory alone.
inline SuiteSpec large_suite(std::size_t cell_count) {
  SuiteSpec suite;
  suite.name = "large-1";
  suite.tracks = {"depth"};
  suite.open = {.seed = 2, .first_map_seed = 101, .missions = 5};
  suite.dev = {.seed = 1, .first_map_seed = 1, .missions = 1};
  for (std::size_t i = 0; i < cell_count; ++i) {
    SuiteSweep sweep;
    sweep.name = "sweep" + std::to_string(i);
    sweep.map_count = 12;
    sweep.file_sha256 = {std::string(64, 'f')};
    suite.cells.push_back({"cell" + std::to_string(i), {sweep}});
  }
  return suite;
}

}  // namespace avoidbench::suite_samples
