#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_trajectory.hpp"
#include "export/replay_files.hpp"
#include "text/visible_text.hpp"
#include "trial_list.hpp"
#include "view/replay_sheet.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

struct ReplayOptions {
  std::string database;
  TrialChoice choice;
  bool is_list = false;
  TableOptions table;
  std::string planner_file, map_file, wind_file;
  std::string png, csv, commands;
  std::vector<double> at_s;
  double every_s = 0.0;
  std::size_t log_lines = 30;
};

__attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  return line;
}

/// A line that the planner logged.
struct LogLine {
  double time_s;  ///< NaN: before or after the calls
  std::string text;
};

/// All that is known of a flight that was flown again.
struct Flown {
  TrialRecord record;
  std::vector<LogLine> log;
  std::vector<CommandLine> calls;
  std::vector<Moment> moments;
};

Flown fly(const Replay& replay, const StoredTrial& stored, const ReplayOptions& options) {
  Flown flown;
  MomentRecorder recorder(options.at_s, options.every_s, stored.spec);
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) {
    for (const std::string& line : step.log) flown.log.push_back({step.time_s, line});
    flown.calls.push_back(command_line(step));
    if (!options.png.empty()) recorder.planned(step);
  };
  std::vector<std::string> other_lines;
  flown.record = replay.fly(observer, other_lines);
  for (const std::string& line : other_lines) flown.log.push_back({std::nan(""), line});
  if (!options.png.empty()) flown.moments = recorder.finish(flown.record.end_time_s);
  return flown;
}

std::string outcome_line(const TrialRecord& record) {
  std::string line = std::string(text(record.outcome));
  if (!std::isnan(record.end_time_s)) line += formatted(" at %.3f s", record.end_time_s);
  return record.reason.empty() ? line : line + ": " + visible_line(record.reason);
}

std::string calls_line(const std::vector<CommandLine>& calls) {
  std::size_t commands = 0, no_plans = 0;
  double sum_s = 0.0, most_s = 0.0;
  for (const CommandLine& call : calls) {
    commands += call.status == PlanStatus::command ? 1 : 0;
    no_plans += call.status == PlanStatus::no_plan ? 1 : 0;
    sum_s += call.cpu_time_s;
    most_s = std::max(most_s, call.cpu_time_s);
  }
  if (calls.empty()) return "none";
  return formatted("%zu, of them %zu commands and %zu without a plan; CPU %.2f ms, most %.2f ms",
                   calls.size(), commands, no_plans,
                   1000.0 * sum_s / static_cast<double>(calls.size()), 1000.0 * most_s);
}

void print_log(const std::vector<LogLine>& log, std::size_t most) {
  if (log.empty()) return;
  const std::size_t skipped = most > 0 && log.size() > most ? log.size() - most : 0;
  std::cout << "\nlog of the planner";
  if (skipped > 0) std::cout << ", without its first " << skipped << " lines (--log 0 for all)";
  std::cout << "\n";
  for (std::size_t i = skipped; i < log.size(); ++i) {
    const std::string time =
        std::isnan(log[i].time_s) ? std::string(9, ' ') : formatted("%8.3f s", log[i].time_s);
    std::cout << time << "  " << visible_line(log[i].text) << "\n";
  }
}

/// Prints how the flight compares with the stored one. True where it is the same, or may differ.
bool print_comparison(const StoredTrial& stored, const Replay& replay, const TrialRecord& record) {
  const std::vector<std::string> found = differences(stored.row.record, record);
  if (found.empty()) {
    std::cout << "replay    equal to the stored trial, bit for bit\n";
    return true;
  }
  std::cout << "replay    differs from the stored trial\n" << std::flush;
  for (const std::string& line : found) std::cerr << "warning: " << visible_line(line) << '\n';
  return !replay.warnings().empty();
}

/// FILE, or FILE with a number before its extension.
std::filesystem::path picture_file(const std::string& png, std::size_t index, std::size_t count) {
  if (count == 1) return png;
  const std::filesystem::path path = png;
  return path.parent_path() / (path.stem().string() + formatted("_%04zu", index) +
                               (path.has_extension() ? path.extension().string() : ".png"));
}

void write_pictures(const Flown& flown, const StoredTrial& stored, const Replay& replay,
                    const std::string& title, const std::string& png) {
  if (flown.record.samples.empty()) {
    std::cerr << "nothing was flown: no picture\n";
    return;
  }
  ReplaySheets sheets(stored, replay.world(), flown.record, title);
  for (std::size_t i = 0; i < flown.moments.size(); ++i) {
    const std::filesystem::path file = picture_file(png, i, flown.moments.size());
    write_png(sheets.sheet(flown.moments[i]), file);
    std::cerr << "wrote " << file.string() << formatted(" (t = %.3f s)", flown.moments[i].time_s)
              << '\n';
  }
}

void replay(const ReplayOptions& options) {
  const Database database = Database::open_for_reading(database_of(options.database));
  const std::vector<TrialListing> all = database.list_trials();
  if (all.empty()) {
    throw InputError({.file = database.path().string(), .message = "holds no finished trial"});
  }
  if (options.is_list) {
    return write_table(trial_table(chosen_trials(all, options.choice), options.table.format),
                       options.table);
  }
  const TrialListing listing = the_trial(all, options.choice);
  enter_worker_environment();
  const StoredTrial stored = possible_trial(database, listing.key);
  const bool may_crash =
      listing.outcome == Outcome::planner_crashed || listing.outcome == Outcome::planner_hung;
  if (may_crash) {
    std::cerr << "warning: this trial ended with " << text(listing.outcome)
              << ": here that ends, or stops, this program\n";
  }
  const std::filesystem::path given = options.database;
  const Replay replay(stored,
                      {.planner = options.planner_file,
                       .map = options.map_file,
                       .wind = options.wind_file,
                       .folders = {".", given.parent_path(), database.path().parent_path()}});
  for (const std::string& warning : replay.warnings()) std::cerr << "warning: " << warning << '\n';
  const std::string title = "trial " + std::to_string(listing.id) + " (" +
                            listing.key.substr(0, 8) + "): " + trial_text(listing);
  std::cout << title << "\nstored    " << outcome_line(stored.row.record) << "\n" << std::flush;
  const Flown flown = fly(replay, stored, options);
  std::cout << "now       " << outcome_line(flown.record) << "\ncalls     "
            << calls_line(flown.calls) << "\n";
  const bool is_explained = print_comparison(stored, replay, flown.record);
  print_log(flown.log, options.log_lines);
  std::cout << std::flush;
  if (!options.csv.empty()) write_text(trajectory_csv(flown.record.samples), options.csv);
  if (!options.commands.empty()) write_text(commands_csv(flown.calls), options.commands);
  if (!options.png.empty()) write_pictures(flown, stored, replay, title, options.png);
  if (!is_explained) throw CLI::RuntimeError(1);
}

void add_choice_options(CLI::App& command, TrialChoice& choice) {
  command.add_option("TRIAL", choice.trial,
                     "Id of the trial, or the beginning of its key (default: the one that the "
                     "options below leave)");
  command.add_option("--planner", choice.planner, "Only trials of this planner, by its label");
  command.add_option("--map-seed", choice.map_seed, "Only trials of maps with this seed");
  command.add_option("--radius", choice.radius_m,
                     "Only trials of maps with this Poisson radius, m");
  command.add_option("--mission", choice.mission, "Only trials of this mission");
  command.add_option("--outcome", choice.outcome,
                     "Only trials that ended so: collided, timed_out, …");
}

}  // namespace

void add_replay_command(CLI::App& app) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "Fly one stored trial again and show it: pictures, path, commands, log");
  command->footer(
      "The planner may draw what it thinks (avoidbench::Canvas of planner.hpp): pictures show it. "
      "Exit code 1 where\nthe flight differs from the stored one though planner and program are "
      "the same.\n\n"
      "Examples:\n"
      "  avoidbench replay results/quick.db --list --outcome collided\n"
      "  avoidbench replay results/quick.db 12 --png trial.png\n"
      "  avoidbench replay results/quick.db --planner reactive --map-seed 1 --radius 3.5 "
      "--mission 2 \\\n"
      "    --png t.png --at 3.2 --at 4\n"
      "  avoidbench replay quick 12 --csv path.csv --commands commands.csv");
  command
      ->add_option("DB", options->database,
                   "Database, or a sweep's file or name for results/NAME.db")
      ->required();
  add_choice_options(*command, options->choice);
  command->add_flag("--list", options->is_list, "List these trials and fly none");
  CLI::Option* png =
      command->add_option("--png", options->png, "Picture to write; of several, numbered ones")
          ->type_name("FILE");
  command
      ->add_option("--at", options->at_s,
                   "Moment to show, s; repeatable (default: the end of the flight)")
      ->check(CLI::NonNegativeNumber)
      ->needs(png)
      ->allow_extra_args(false);
  command->add_option("--every", options->every_s, "Show a moment each so many seconds, too")
      ->check(CLI::PositiveNumber)
      ->needs(png);
  command->add_option("--csv", options->csv, "Path to write as CSV")->type_name("FILE");
  command->add_option("--commands", options->commands, "The planner's calls to write as CSV")
      ->type_name("FILE");
  command->add_option("--log", options->log_lines, "Most lines of the planner's log; 0: all")
      ->capture_default_str();
  command
      ->add_option("--library", options->planner_file,
                   "Fly this planner library (default: what the sweep's name of it leads to, if "
                   "that is the file that was flown)")
      ->type_name("NAME|FILE");
  command
      ->add_option("--map-file", options->map_file,
                   "File of the map (default: by its name beside sweep and database, or in maps/)")
      ->type_name("FILE");
  command
      ->add_option(
          "--wind-file", options->wind_file,
          "File of the wind field (default: by its name, as the map's, or in configs/wind/)")
      ->type_name("FILE");
  add_table_options(*command, options->table);
  command->callback([options] { replay(*options); });
}

}  // namespace avoidbench
