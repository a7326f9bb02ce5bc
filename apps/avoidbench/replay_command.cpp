#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>

#include "base/option_error.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_commands.hpp"
#include "export/export_trajectory.hpp"
#include "export/trial_list.hpp"
#include "output.hpp"
#include "replay/replay.hpp"
#include "replay/sample.hpp"
#include "text/number_text.hpp"
#include "text/visible_text.hpp"
#include "view/replay_sheet.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

constexpr int kExitDiffers = 1;

struct ReplayOptions {
  std::string database;
  TrialChoice choice;
  bool is_list = false, is_verify = false;
  std::string sample = "100%";
  OutputOptions output;
  std::string planner_file, map_file, wind_file;
  std::string png, csv, commands;
  std::vector<double> at_s;
  double every_s = 0.0;
  std::size_t log_lines = 30;
};

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
  if (!std::isnan(record.end_time_s)) line += " at " + fixed_digits(record.end_time_s, 3) + " s";
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
  const double mean_s = sum_s / static_cast<double>(calls.size());
  return std::to_string(calls.size()) + ", of them " + std::to_string(commands) + " commands and " +
         std::to_string(no_plans) + " without a plan; CPU " + fixed_digits(1000.0 * mean_s, 2) +
         " ms, most " + fixed_digits(1000.0 * most_s, 2) + " ms";
}

void print_log(const std::vector<LogLine>& log, std::size_t most) {
  if (log.empty()) return;
  const std::size_t skipped = most > 0 && log.size() > most ? log.size() - most : 0;
  std::cout << "\nlog of the planner";
  if (skipped > 0) std::cout << ", without its first " << skipped << " lines (--log 0 for all)";
  std::cout << "\n";
  for (std::size_t i = skipped; i < log.size(); ++i) {
    const std::string time = std::isnan(log[i].time_s) ? "" : fixed_digits(log[i].time_s, 3) + " s";
    std::cout << std::setw(10) << time << "  " << visible_line(log[i].text) << "\n";
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
  std::string number = std::to_string(index);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  return path.parent_path() / (path.stem().string() + "_" + number +
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
    std::cerr << "wrote " << file.string() << " (t = " << fixed_digits(flown.moments[i].time_s, 3)
              << " s)" << '\n';
  }
}

/// Whether the end was a worker's, which a flight in this process can't have.
bool ended_worker(const TrialListing& trial) {
  return trial.outcome == Outcome::planner_crashed || trial.outcome == Outcome::planner_hung;
}

/// Flies it again; whether it is the same.
bool is_repeated(const Database& database, const TrialListing& trial, const ReplayFiles& files) {
  const Replay replay(possible_trial(database, trial.key), files);
  std::vector<std::string> log;
  const TrialRecord flown = replay.fly({}, log);
  const std::vector<std::string> found = differences(replay.stored().row.record, flown);
  if (found.empty()) return true;
  std::cout << "trial " << trial.id << " (" << trial.key.substr(0, 8) << ", "
            << visible_line(trial.planner_label) << ") differs:\n";
  for (const std::string& line : found) std::cout << "  " << visible_line(line) << '\n';
  for (const std::string& line : replay.warnings()) std::cout << "  note: " << line << '\n';
  return false;
}

/// Flies a share of these trials again and prints where they differ from what is stored.
void verify_trials(const Database& database, const std::vector<TrialListing>& trials, double share,
                   const ReplayFiles& files) {
  const bool has_several = std::any_of(trials.begin(), trials.end(), [&](const TrialListing& one) {
    return one.planner_label != trials.front().planner_label;
  });
  if (!files.planner.empty() && has_several) {
    throw OptionError(
        files.planner + ": the trials are of several planners: choose one by --planner", "library");
  }
  std::int64_t flown = 0, different = 0, passed_over = 0;
  for (const TrialListing& trial : trials) {
    if (!is_sampled(trial.key, share)) continue;
    if (ended_worker(trial)) {
      ++passed_over;
      continue;
    }
    ++flown;
    different += is_repeated(database, trial, files) ? 0 : 1;
  }
  std::cout << flown << " trials flown again, " << different << " different\n";
  if (passed_over > 0) {
    std::cout << passed_over << " crashed or hung and were not flown: see avoidbench run --rerun\n";
  }
  if (flown == 0 && passed_over == 0) std::cerr << "the sample has no trial: make it larger\n";
  if (different > 0) throw CLI::RuntimeError(kExitDiffers);
}

void replay(const ReplayOptions& options) {
  const Database database = Database::open_for_reading(database_of(options.database));
  const std::vector<TrialListing> all = database.list_trials();
  if (all.empty()) {
    throw InputError({.file = database.path().string(), .message = "holds no finished trial"});
  }
  if (options.is_list) {
    return write_table(
        trial_table(chosen_trials(all, options.choice), options.output.is_for_people()),
        options.output);
  }
  const std::filesystem::path given = options.database;
  const ReplayFiles files{.planner = options.planner_file,
                          .map = options.map_file,
                          .wind = options.wind_file,
                          .folders = {".", given.parent_path(), database.path().parent_path()}};
  if (options.is_verify) {
    const double share = share_from(options.sample);
    enter_worker_environment();
    return verify_trials(database, chosen_trials(all, options.choice), share, files);
  }
  const TrialListing listing = the_trial(all, options.choice);
  enter_worker_environment();
  const StoredTrial stored = possible_trial(database, listing.key);
  if (ended_worker(listing)) {
    std::cerr << "warning: this trial ended with " << text(listing.outcome)
              << ": here that ends, or stops, this program\n";
  }
  const Replay replay(stored, files);
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
  if (!is_explained) throw CLI::RuntimeError(kExitDiffers);
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
      "replay",
      "Fly stored trials again: one to see it (pictures, path, commands, log), or many to compare");
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
      "  avoidbench replay quick 12 --csv path.csv --commands commands.csv\n"
      "  avoidbench replay quick --verify --sample 10%");
  command
      ->add_option("DB", options->database,
                   "Database, or a sweep's file or name for results/NAME.db")
      ->required();
  add_choice_options(*command, options->choice);
  CLI::Option* list =
      command->add_flag("--list", options->is_list, "List these trials and fly none");
  CLI::Option* verify =
      command
          ->add_flag(
              "--verify", options->is_verify,
              "Fly all of these trials again and compare them bit for bit; exit code 1 where "
              "one differs")
          ->excludes(list);
  command
      ->add_option("--sample", options->sample,
                   "Share of them to verify, such as 10%, chosen by their keys")
      ->capture_default_str()
      ->needs(verify);
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
  add_output_options(*command, options->output);
  command->callback([options] { replay(*options); });
}

}  // namespace avoidbench
