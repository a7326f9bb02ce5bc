#include "fuzz/read_database.hpp"

#include <sqlite3.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "base/input_error.hpp"
#include "compare/compare_formats.hpp"
#include "compare/trial_table.hpp"
#include "export/export_trials.hpp"
#include "page/page.hpp"
#include "page/page_text.hpp"
#include "replay/replay.hpp"
#include "report/summary.hpp"
#include "report/sweep_tables.hpp"
#include "store/merge.hpp"
#include "store/row_digest.hpp"
#include "support/canonical_rows.hpp"
#include "support/sample_rows.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench::fuzz {
namespace {

using namespace sample_rows;

constexpr const char* kSweepSpec =
    R"({"trials":2,"planners":[{},{}],"axes":[{"path":"map_seed","values":[1,2]},)"
    R"({"path":"map.poisson_radius_m","values":[2.5]},{"path":"movers.count","values":[0,7]},)"
    R"({"path":"sensor","values":[{"name":"mid360_like"},{"name":"depth_ideal"}]}],"base":{"latency":{"mode":"fixed"}}})";

template <class Action>
void pass_over_input_errors(Action action) {
  try {
    action();
  } catch (const InputError&) {
  }
}

void ignore(const std::string&) {}

void report(const Database& db) {
  for (const SweepInfo& sweep : db.read_sweeps()) {
    pass_over_input_errors([&] {
      ReportQuery query;
      const SweepResult result =
          db.read_sweep(sweep.name, sweep.revision,
                        {"planner", "reason", "map.poisson_radius_m", "sensor.width_px",
                         "movers.count", "tracks.range_m", "sensor.lidars"});
      const SweepSummary summary = summarize(result, query);
      const Section section = sweep_section(summary);
      for (const auto& [format, name] : EnumText<TableFormat>::entries) {
        format_sections({&section, 1}, format);
      }
    });
  }
}

void compare_and_export(const Database& db) {
  for (const SweepInfo& sweep : db.read_sweeps()) {
    pass_over_input_errors([&] {
      const TrialTable table = table_of_sweep(db, sweep, {"map_seed", "sensor.width_px"});
      CompareSettings settings;
      settings.replicate_count = 20;
      const Comparison comparison = compare_tables(table, table, settings);
      for (const auto& [format, name] : EnumText<CompareFormat>::entries) {
        format_comparison(comparison, format);
      }
      table_of_csv(csv_of_table(table), "again");
    });
  }
  pass_over_input_errors([&] { export_trials({&db, 1}, "", TrialFormat::jsonl, ignore); });
}

void replay(const Database& db) {
  for (const TrialListing& trial : db.list_trials()) {
    pass_over_input_errors([&] { read_stored_trial(db, trial.key); });
  }
}

/// A page of each sweep, as `report --page` makes it, and what `explain` has stored.
void page_and_causes(const Database& db) {
  std::map<std::string, TrialListing> listings;
  pass_over_input_errors([&] {
    for (const TrialListing& trial : db.list_trials()) listings.emplace(trial.key, trial);
  });
  for (const SweepInfo& sweep : db.read_sweeps()) {
    pass_over_input_errors([&] {
      const SweepResult result = db.read_sweep(sweep.name, sweep.revision, {"cause", "map_seed"});
      const SweepSummary summary = summarize(result, ReportQuery{});
      const std::vector<PageSweep> sweeps{{.summary = summary,
                                           .section = sweep_section(summary),
                                           .result = result,
                                           .axes = {"map_seed"},
                                           .listing_of = listings,
                                           .runs = {run_row()}}};
      const std::vector<PageDatabase> places{{.database = &db, .files = {}}};
      page_text({"<head>", "<body>", "<tail>"}, "title",
                sweeps_page(sweeps, places, PageOrigin{}, 100'000));
    });
  }
  pass_over_input_errors([&] { db.read_explanations(); });
  pass_over_input_errors([&] { db.read_what_ifs(); });
}

void merge(const std::filesystem::path& file) {
  const std::filesystem::path into = scratch_folder() / "into.db";
  static const bool is_made = [&] {
    write_sample_database(scratch_folder() / "merged.db");
    return true;
  }();
  static_cast<void>(is_made);
  for (const bool is_empty : {true, false}) {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
      std::filesystem::remove(into.string() + suffix);
    }
    if (!is_empty) std::filesystem::copy_file(scratch_folder() / "merged.db", into);
    pass_over_input_errors([&] {
      Database db = Database::open_for_run(into, kMetrics);
      merge_database(db, file);
      sweep_completeness(db);
    });
  }
}

void resume(const std::filesystem::path& file) {
  Database db = Database::open_for_run(file, kMetrics);
  db.finished_trials();
  for (int map = 0; map < 2; ++map) db.read_map(map_row(map, 0).record.key);
  db.add_run(run_row());
  db.add_sweep(sweep_row(kSweepSpec));
  db.add_planner(planner_row("a"));
  db.add_map(map_row(0, 2), "forest");
  db.add_trial(trial_row("a", 0, 1, Outcome::collided));
  db.mean_costs();
}

/// By its number a trial with movers and tracks, one with lidars, one with several goals; the last
/// collides among movers.
void add_what_moves(int place, TrialSpec& spec) {
  if (place == 0 || place == 3) {
    spec.movers.count = 7;
    spec.movers.kind = MoverKind::mixed;
    spec.movers.motion = MoverMotion::mixed;
    spec.tracks.range_m = 12.0;
    spec.tracks.false_count = 0.5;
    spec.planner.needs = AB_INPUT_TRACKS;
  }
  if (place == 1) {
    spec.sensor.lidars = lidar_presets();
    spec.sensor.lidars.back().mounting.yaw_deg = 90.0;
    spec.planner.needs = AB_INPUT_POINTS;
  }
  if (place == 2) {
    spec.mission.waypoints = 2;
    spec.mission.goal_motion.path = GoalPath::circle;
    spec.planner.needs = AB_INPUT_GOALS;
  }
}

/// Two missions, the second one of three goals.
MapRow map_with_legs(int index) {
  MapRow row = map_row(index, 2);
  MissionRecord& mission = row.record.missions[1];
  mission.mission.waypoints_world = {{0.1, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  mission.leg_lengths_m = {3.5, 4.25, 7.25};
  return row;
}

}  // namespace

std::filesystem::path scratch_folder() {
  static const auto* const folder = [] {  // never destroyed: it is asked for at the end
    std::error_code error;
    const bool has_memory = std::filesystem::is_directory("/dev/shm", error);
    const std::filesystem::path parent =
        has_memory ? "/dev/shm" : std::filesystem::temp_directory_path();
    std::string name = (parent / "database_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    std::atexit([] {
      std::error_code none;
      std::filesystem::remove_all(scratch_folder(), none);
    });
    return new std::filesystem::path(name);
  }();
  return *folder;
}

void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  for (const char* suffix : {"-wal", "-shm", "-journal"}) {
    std::filesystem::remove(file.string() + suffix);
  }
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void write_sample_database(const std::filesystem::path& file) {
  {
    Database db = Database::open_for_run(file, kMetrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row(kSweepSpec));
    for (const char* label : {"a", "b"}) db.add_planner(planner_row(label));
    for (int map = 0; map < 2; ++map) db.add_map(map_with_legs(map), "forest");
    for (const char* label : {"a", "b"}) {
      for (int place = 0; place < 4; ++place) {
        const bool collides = place == 3;
        TrialRow row = trial_row(label, place / 2, place % 2,
                                 collides ? Outcome::collided : Outcome::reached_goal);
        TrialSpec spec;
        spec.map = HallSpec{};  // pages show it, and it is soon made
        spec.mission_index = row.mission_index;
        spec.planner.label = label;
        add_what_moves(place, spec);
        row.spec_json = trial_json(spec);
        row.record.samples.resize(4);
        db.add_trial(row);
        if (!collides) continue;
        db.add_explanation({.trial_key = row.key,
                            .cause = label == std::string("a") ? "trap" : "moved_into",
                            .facts_json = R"({"braking_distance_m":1.5})",
                            .rules_version = 1,
                            .record_digest = key_of("flight")});
        db.add_what_if({.trial_key = row.key,
                        .change = "true_depth",
                        .outcome = Outcome::reached_goal,
                        .reason = "",
                        .end_time_s = 9.5,
                        .program_version = "0.1.0",
                        .planner_digest = key_of("so"),
                        .record_digest = key_of("changed flight")});
      }
    }
  }
  // Small pages: more of the bytes mean something.
  sqlite3* handle = nullptr;
  if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) std::abort();
  sqlite3_exec(handle, "PRAGMA page_size = 512; VACUUM", nullptr, nullptr, nullptr);
  sqlite3_close(handle);
}

void read_as_command_does(int command, const std::filesystem::path& file) {
  if (command == 3) {
    pass_over_input_errors([&] { merge(file); });
    pass_over_input_errors([&] { resume(file); });
    return;
  }
  pass_over_input_errors([&] {
    const Database db = Database::open_for_reading(file);
    if (command == 0) report(db);
    if (command == 1) compare_and_export(db);
    if (command == 4) page_and_causes(db);
    if (command != 2) return;
    pass_over_input_errors([&] { replay(db); });
    pass_over_input_errors([&] { check_digests(db, true); });
    pass_over_input_errors([&] { test::canonical_rows(db); });
    pass_over_input_errors([&] { sweep_completeness(db); });
    pass_over_input_errors([&] { db.mean_costs(); });
  });
}

}  // namespace avoidbench::fuzz
