#include <iostream>

#include "base/option_error.hpp"
#include "base/output_file.hpp"
#include "commands.hpp"
#include "explain.hpp"
#include "output.hpp"
#include "page_program.hpp"
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
      "this program makes other maps than the suite froze, so that its results are none of the "
      "suite's: " +
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
    throw OptionError(options.planner + " says the label and the parameters itself", "planner");
  }
  return read_suite_planner(options.planner);
}

void run_suite(const SuiteOptions& options) {
  const SuiteTrack chosen = suite_track(options.track);
  const bool is_sealed = !options.sealed.empty();
  const Split split = is_sealed ? Split::sealed : *enum_from_text<Split>(options.split);
  const std::string key = is_sealed ? read_suite_key(options.sealed, chosen.suite) : "";
  const SuitePlanner planner = planner_of(options);
  const std::vector<PlannedSweep> sweeps = planned(chosen, split, key, planner);
  const PlannerChoice flown = sweeps.front().spec.planners.front();
  const fs::path folder = made_folder(
      options.folder.empty() ? "results/suites/" + chosen.suite.name + "/" + chosen.track + "/" +
                                   std::string(text(split)) + "/" + safe_file_name(flown.label)
                             : options.folder);
  RunCommand run = options.run;
  run.is_of_suite = true;
  run.database_file = (folder / "flights.db").string();
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    std::cerr << chosen.suite.name << "/" << chosen.track << ", " << text(split) << ": sweep "
              << i + 1 << " of " << sweeps.size() << ", " << sweeps[i].sweep->name << '\n';
    run.sweep_file = sweeps[i].sweep->name;
    const std::int64_t revision = fly_sweep(run, sweeps[i].spec, {});
    require_frozen(run.database_file, sweeps[i], split, revision);
  }
  if (!options.no_causes) tell_causes(run.database_file, folder);
  const Database database = Database::open_for_reading(run.database_file);
  std::vector<SuiteRow> rows = rows_of(database, chosen.suite);
  const auto missions = static_cast<std::size_t>(mission_count(chosen.suite, split));
  if (rows.size() != missions) {
    throw InputError(folder.string() + ": " + std::to_string(rows.size()) + " flights, expected " +
                     std::to_string(missions));
  }
  const SuiteResult result = result_of(chosen, split, planner, planner_row(flown), std::move(rows));
  write_result(result, folder);
  write_report_files(run.database_file, (folder / "report.md").string(),
                     (folder / "page.html").string());
  const Section section{
      .name = chosen.suite.name + "/" + chosen.track,
      .title = chosen.suite.name + "/" + chosen.track + ", " + std::string(text(split)),
      .tables = score_tables(chosen.suite, {score_of(chosen.suite, result)})};
  write_sections({&section, 1}, {});
  std::cerr << "the result is in " << folder.string() << ": trials.csv, planner.yaml, report.md"
            << (page_program().missing.empty() ? ", page.html" : "")
            << "; flights.db is yours to keep\n";
}

}  // namespace avoidbench
