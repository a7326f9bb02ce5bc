#include <iostream>

#include "base/option_error.hpp"
#include "base/output_file.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "explain.hpp"
#include "output.hpp"
#include "suite.hpp"
#include "suite/suite_maps.hpp"
#include "suite/suite_score.hpp"
#include "sweep/sweep_rows.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A sweep of the suite with its place in it.
struct PlannedSweep {
  const SuiteSweep* sweep = nullptr;
  SweepSeeds seeds;
  SweepSpec spec;
};

std::vector<PlannedSweep> planned(const SuiteTrack& chosen, Split split, const std::string& key,
                                  const SuitePlanner& planner) {
  std::vector<PlannedSweep> all;
  for (const SuiteCell& cell : chosen.suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      const SweepSeeds seeds = seeds_of(chosen.suite, cell, sweep, split, key);
      all.push_back({&sweep, seeds, suite_sweep(chosen, sweep, seeds, planner)});
      if (all.back().spec.planners.size() == 1) continue;
      throw OptionError("a suite takes one setting for all cells: give no list of values",
                        "planner");
    }
  }
  return all;
}

/// Throws where the maps of a sweep that was flown are not those that were frozen: other numbers
/// would stand for the suite's.
void require_frozen(const std::string& file, const PlannedSweep& one, Split split,
                    std::int64_t revision) {
  const Database database = Database::open_for_reading(file);
  const SweepResult result = database.read_sweep(one.sweep->name, revision);
  const std::string problem = maps_problem(*one.sweep, split, flown_maps(result, one.seeds));
  if (problem.empty()) return;
  throw InputError(
      "this program's maps differ from those that the suite froze, so its results would not be "
      "valid for the suite: " +
      problem);
}

SuiteResult result_of(const SuiteTrack& chosen, Split split, const SuitePlanner& planner,
                      const PlannerRow& flown, std::vector<SuiteRow> rows) {
  SuiteResult result;
  result.suite = chosen.suite.name;
  result.track = chosen.track;
  result.track_sha256 = chosen.sha256;
  result.split = split;
  if (split == Split::sealed) result.key_sha256 = chosen.suite.sealed_key_sha256;
  result.label = flown.label;
  result.planner_name = flown.name;
  result.planner_version = flown.version;
  result.planner_digest = flown.file_digest;
  result.is_privileged = flown.is_privileged;
  result.program = std::string(kVersion) + " " + kGitHash;
  result.planner = planner;
  result.rows = std::move(rows);
  return result;
}

void tell_causes(const fs::path& database, const fs::path& folder) {
  ExplainOptions explain;
  explain.database = database.string();
  explain.output = {.format = TableFormat::markdown, .output = (folder / "causes.md").string()};
  explain_causes(explain);
}

}  // namespace

SuitePlanner planner_of(const SuiteOptions& options) {
  if (!options.planner.ends_with(".yaml") && !options.planner.ends_with(".yml")) {
    return suite_planner(options.planner, options.label, options.parameters);
  }
  if (!options.label.empty() || !options.parameters.empty()) {
    throw OptionError(options.planner + " sets the label and the parameters itself", "planner");
  }
  return read_suite_planner(options.planner);
}

std::string SuiteMaps::title() const {
  return chosen.suite.name + "/" + chosen.track + ", " + std::string(text(split));
}

SuiteMaps suite_maps(const SuiteOptions& options) {
  SuiteMaps maps{.chosen = suite_track(options.track), .split = Split::sealed, .key = {}};
  if (options.sealed.empty()) {
    maps.split = *enum_from_text<Split>(options.split);
  } else {
    maps.key = read_suite_key(options.sealed, maps.chosen.suite);
  }
  return maps;
}

SuiteResult fly_suite(const SuiteMaps& maps, const SuiteOptions& options) {
  const SuiteSpec& suite = maps.chosen.suite;
  const SuitePlanner planner = planner_of(options);
  const std::vector<PlannedSweep> sweeps = planned(maps.chosen, maps.split, maps.key, planner);
  const PlannerChoice flown = sweeps.front().spec.planners.front();
  const fs::path folder = made_folder(
      options.folder.empty() ? "results/suites/" + suite.name + "/" + maps.chosen.track + "/" +
                                   std::string(text(maps.split)) + "/" + safe_file_name(flown.label)
                             : options.folder);
  RunCommand run = options.run;
  run.is_of_suite = true;
  run.database_file = (folder / "flights.db").string();
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    options.before_sweep(flown);
    std::cerr << maps.title() << ": sweep " << i + 1 << " of " << sweeps.size() << ", "
              << sweeps[i].sweep->name << '\n';
    run.sweep_file = sweeps[i].sweep->name;
    const std::int64_t revision = fly_sweep(run, sweeps[i].spec, {});
    require_frozen(run.database_file, sweeps[i], maps.split, revision);
  }
  if (!options.no_causes) tell_causes(run.database_file, folder);
  const Database database = Database::open_for_reading(run.database_file);
  std::vector<SuiteRow> rows = rows_of(database, suite);
  const auto missions = static_cast<std::size_t>(mission_count(suite, maps.split));
  if (rows.size() != missions) {
    throw InputError(folder.string() + ": " + counted(rows.size(), "flight") + ", expected " +
                     std::to_string(missions));
  }
  SuiteResult result =
      result_of(maps.chosen, maps.split, planner, planner_row(flown), std::move(rows));
  write_result(result, folder);
  write_report_files(run.database_file, (folder / "report.md").string(),
                     (folder / "page.html").string());
  std::cerr << "the result is in " << folder.string()
            << ": trials.csv, planner.yaml, report.md, page.html; flights.db is yours to keep\n";
  return result;
}

void run_suite(const SuiteOptions& options) {
  const SuiteMaps maps = suite_maps(options);
  const SuiteResult result = fly_suite(maps, options);
  const SuiteSpec& suite = maps.chosen.suite;
  const Section section{.name = suite.name + "/" + maps.chosen.track,
                        .title = maps.title(),
                        .tables = score_tables(suite, {score_of(suite, result)})};
  write_sections({&section, 1}, {});
}

}  // namespace avoidbench
