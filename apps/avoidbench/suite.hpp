#pragma once

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
};

/// The planner that the options name.
SuitePlanner planner_of(const SuiteOptions& options);

/// Flies a suite's track and writes the folder of the result.
void run_suite(const SuiteOptions& options);

/// Checks a result's folder and flies a sample of it again.
void verify_suite(const SuiteOptions& options);

}  // namespace avoidbench
