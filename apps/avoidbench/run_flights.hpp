#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sweep/shard.hpp"
#include "sweep/sweep_spec.hpp"

/// What `run` and `limit` share: the options by which a sweep is flown, and the flying.
namespace avoidbench {

inline constexpr int kExitUnflown = 1;

struct RunCommand {
  std::string sweep_file;
  std::vector<std::string> overrides;
  std::string database_file;
  int jobs = 0;
  double plan_timeout_s = 10.0, trial_timeout_s = 3600.0, grace_s = 30.0;
  std::optional<double> memory_limit_mib;
  bool dry_run = false, in_process = false, quiet = false, no_sandbox = false;
  bool no_keep = false, is_bundle = false;
  std::optional<std::string> shard;
  std::string rerun, until, progress = "line", heartbeat;
  std::string page;  ///< "": none
  /// One sweep of a suite: no hints of what a sweep file could say, or of what to do next.
  bool is_of_suite = false;
  std::function<bool(const std::string& key)> is_wanted = {};  ///< null: all trials are flown
};

/// Where the sweep's results go: --db, or results/NAME.db.
std::filesystem::path database_file(const RunCommand& command, const SweepSpec& sweep,
                                    const Shard& shard);

/// Flies what the database lacks of the sweep, and says on stderr how it goes and what came of it.
/// Returns the sweep's revision in the database. Throws CLI::RuntimeError where it was stopped or
/// trials are unflown.
std::int64_t fly_sweep(const RunCommand& command, const SweepSpec& sweep, const Shard& shard);

/// SWEEP, --set, --db, --jobs.
void add_sweep_options(CLI::App& app, RunCommand& options);
/// Times and memory beyond which a planner, or a stop, is not waited for.
void add_limit_options(CLI::App& command, RunCommand& options);
/// Progress, limits of time and memory, sandbox.
void add_flight_options(CLI::App& app, RunCommand& options);

}  // namespace avoidbench
