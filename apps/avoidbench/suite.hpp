#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command_options.hpp"
#include "run_flights.hpp"
#include "suite/suite_planner.hpp"
#include "suite/suite_result.hpp"

/// The parts of `avoidbench suite`.
namespace avoidbench {

struct SuiteOptions {
  std::string track;    ///< SUITE/TRACK
  std::string planner;  ///< name, library, program, or planner.yaml
  std::string label;
  std::vector<std::string> parameters;
  std::string split = "public", sealed;
  std::string folder;
  std::string sample = "1%", salt;
  bool no_causes = false;
  RunCommand run;
  /// Called before each sweep; throws where the planner shall not fly it.
  std::function<void(const PlannerChoice&)> before_sweep = [](const PlannerChoice&) {};
};

/// The maps that options choose: --split or --sealed of a track.
struct SuiteMaps {
  SuiteTrack chosen;
  Split split = Split::open;
  std::string key;  ///< of sealed maps

  std::string title() const;  ///< avoidbench-1/depth, public
};

/// Reads the key's file once.
SuiteMaps suite_maps(const SuiteOptions& options);

/// The planner that the options name.
SuitePlanner planner_of(const SuiteOptions& options);

/// Flies these maps with the options' planner and writes the folder of the result.
SuiteResult fly_suite(const SuiteMaps& maps, const SuiteOptions& options);

/// The same with the result's scores on standard output.
void run_suite(const SuiteOptions& options);

/// Checks a result's folder and flies a sample of it again.
void verify_suite(const SuiteOptions& options);

/// Workers, sandbox, progress and limits, as options of a command that flies a suite.
void add_suite_flying(CLI::App& command, RunCommand& options);

}  // namespace avoidbench
