#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command_options.hpp"
#include "database_choice.hpp"
#include "export/trial_list.hpp"
#include "replay/replay.hpp"
#include "store/database.hpp"

namespace avoidbench {

/// What `avoidbench explain` was told.
struct ExplainOptions {
  std::string database;
  TrialChoice choice;
  OutputOptions output;
  FileChoice files;
  std::string png;
  int jobs = 0;
  double plan_timeout_s = 10.0;
  std::vector<std::string> what_if;     ///< names of changes
  std::optional<std::int64_t> control;  ///< successes a planner
  std::string minimal;                  ///< folder
  std::int64_t most_flights = 300;
};

/// Where the files of the database's trials are looked for.
ReplayFiles explain_files(const ExplainOptions& options, const Database& database);

}  // namespace avoidbench
