#include "database_choice.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <utility>

#include "command_options.hpp"
#include "config/sweep_file.hpp"
#include "output.hpp"
#include "process/sandbox.hpp"
#include "store/row_digest.hpp"
#include "store/stored_text.hpp"
#include "trial/contradictions.hpp"

namespace avoidbench {

namespace {

[[noreturn]] void throw_no_database(const std::string& name) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("results", error)) {
    if (entry.path().extension() == ".db") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  throw InputError(
      name + ": no such file, and no results/" + name + ".db" + did_you_mean(name, names) +
      (names.empty() ? "; results/ has no database" : "; there are: " + joined(names)));
}

}  // namespace

std::filesystem::path database_of(const std::string& given) {
  std::error_code error;
  const std::filesystem::path path = given;
  const auto of_sweep = [](const std::string& name) {
    return std::filesystem::path("results") / (name + ".db");
  };
  if (path.extension() == ".yaml" || path.extension() == ".yml") {
    const std::filesystem::path database = of_sweep(read_sweep(path).name);
    if (!std::filesystem::exists(database, error)) {
      refuse_file(database, "no such file: fly the sweep first (avoidbench run " + given +
                                "), or name the database");
    }
    return database;
  }
  const bool is_file =
      std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error);
  if (is_file) return path;
  if (std::filesystem::exists(of_sweep(given), error)) return of_sweep(given);
  const bool is_name = !path.has_extension() && !path.has_parent_path() && !given.empty();
  if (is_name && !std::filesystem::exists(path, error)) throw_no_database(given);
  return path;
}

std::filesystem::path newest_database(const std::string& purpose) {
  std::filesystem::path newest;
  std::filesystem::file_time_type newest_time{};
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("results", error)) {
    if (entry.path().extension() != ".db") continue;
    std::filesystem::file_time_type time = std::filesystem::last_write_time(entry.path(), error);
    // What a run has just committed may be in the file beside it.
    const std::filesystem::path log = entry.path().string() + "-wal";
    const bool has_log =
        std::filesystem::exists(log, error) && std::filesystem::file_size(log, error) > 0;
    if (has_log) time = std::max(time, std::filesystem::last_write_time(log, error));
    const bool is_newer =
        newest.empty() || std::pair(time, entry.path()) > std::pair(newest_time, newest);
    if (!is_newer) continue;
    newest = entry.path();
    newest_time = time;
  }
  if (newest.empty()) {
    throw InputError("no database given and none in results/: run a sweep first, or name the file");
  }
  std::cerr << purpose << " of " << newest.string() << "\n";
  return newest;
}

Database open_checked(const std::filesystem::path& path) {
  Database database = Database::open_for_reading(path);
  check_digests(database, false);
  return database;
}

std::vector<Database> opened(const std::vector<std::string>& files, const std::string& purpose) {
  std::vector<Database> databases;
  for (const std::string& file : files) databases.push_back(open_checked(database_of(file)));
  if (files.empty()) databases.push_back(open_checked(newest_database(purpose)));
  return databases;
}

StoredTrial possible_trial(const Database& database, const std::string& key) {
  StoredTrial stored = read_stored_trial(database, key);
  for (const Contradiction& found : contradictions(stored.spec)) {
    if (found.path == "latency.database") continue;  // which databases do not name
    throw_damaged(database.path(), "trials", key,
                  "spec_json: " + found.path + ": " + found.message);
  }
  return stored;
}

ReplayFiles files_beside(const std::string& given, const Database& database,
                         const FlightOptions& options) {
  const std::filesystem::path path = given;
  ReplayFiles files = options.files;
  files.folders = {".", path.parent_path(), database.path().parent_path()};
  files.database = database.path();
  const bool is_sweep = path.extension() == ".yaml" || path.extension() == ".yml";
  const std::string sweep = options.sweep.empty() && is_sweep ? given : options.sweep;
  if (!sweep.empty()) files.own_planners = read_sweep(sweep).planners;
  return files;
}

FleetOptions fleet_options(const FlightOptions& options, int jobs, const StopSignals* signals) {
  return {.worker_command = worker_words(options.plan_timeout_s, {}, jobs),
          .sandbox = options.no_sandbox ? "" : text(sandbox_support()),
          .jobs = jobs,
          .silence_s = silence_limit_s(options.plan_timeout_s),
          .stop = signals != nullptr ? &signals->stop : nullptr,
          .stop_now = signals != nullptr ? &signals->stop_now : nullptr,
          .on_granted = [said = std::make_shared<std::set<std::string>>()](const FleetJob& job) {
            if (said->insert(job.planner_label).second) {
              warn_of_granted(job.planner_label, text(job.rules));
            }
          }};
}

void add_replay_options(CLI::App& command, FlightOptions& options) {
  ReplayFiles& files = options.files;
  CLI::Option* library =
      add_typed(command, "--library", files.planner, "NAME|FILE",
                "Fly this planner's library or program (default: the file that the sweep's name "
                "for it leads to, if it is the one that was flown)");
  add_typed(command, "--sweep-file", options.sweep, "FILE",
            "Your sweep file, whose planners may be flown: a command (plugin: process) that only "
            "the database names is not started")
      ->excludes(library);
  add_typed(
      command, "--map-file", files.map, "FILE",
      "Map file (default: found by its name next to the sweep and the database, or in maps/)");
  add_typed(command, "--wind-file", files.wind, "FILE",
            "Wind field file (default: found by its name as the map's, or in configs/wind/)");
  add_number(command, "--plan-timeout", options.plan_timeout_s, CLI::PositiveNumber,
             "Wall time after which a call of the planner counts as hung, s");
  command.add_flag("--no-sandbox", options.no_sandbox,
                   "Let planners write files, start programs and use the network, as with `run "
                   "--no-sandbox` (docs/trust.md)");
}

}  // namespace avoidbench
