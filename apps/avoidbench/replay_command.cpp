#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_flight.hpp"
#include "output.hpp"
#include "page/flight_page.hpp"
#include "page/flight_recording.hpp"
#include "page_output.hpp"
#include "replay/sample.hpp"
#include "replay/stored_flight.hpp"
#include "replay_verify.hpp"
#include "trial/flown_world.hpp"
#include "view_output.hpp"
#include "worker/source_lines.hpp"
#include "worker/worker_death.hpp"

namespace avoidbench {
namespace {

struct ReplayOptions {
  std::string database;
  TrialChoice choice;
  std::vector<std::string> where;
  TrialOrder order;
  bool is_list = false, is_verify = false;
  std::string sample = "100%";
  OutputOptions output;
  FlightOptions flights;
  std::string png, csv, commands, page, video;
  std::vector<double> at_s;
  std::optional<double> every_s;
  std::size_t log_lines = 30;
};

/// A trial that is flown again, and how.
struct Task {
  const Database& database;
  const TrialListing& listing;
  const StoredFlight& flight;
  const FleetOptions& fleet;
  const ReplayOptions& options;
};

/// All that is known of a flight that was flown again.
struct Flown {
  TrialRecord record;
  bool has_died = false;           ///< its worker
  bool has_begun = false;          ///< then: the planner was called; else the record has no path
  std::vector<std::string> stack;  ///< where
  std::string printed;             ///< by the planner
  FlightRecording recording;
};

std::string outcome_line(const TrialRecord& record) {
  std::string line = std::string(text(record.outcome));
  if (!std::isnan(record.end_time_s)) line += " at " + fixed_digits(record.end_time_s, 3) + " s";
  return record.reason.empty() ? line : line + ": " + visible_line(record.reason);
}

std::string calls_line(const Flown& flown) {
  const std::vector<PlanCall>& calls = flown.record.plan_calls;
  if (flown.has_died) {
    return std::to_string(calls.size()) +
           (flown.has_begun ? " that came back, and one that did not" : "");
  }
  std::size_t commands = 0, no_plans = 0;
  double sum_s = 0.0, most_s = 0.0;
  for (const PlanCall& call : calls) {
    commands += call.status == AB_OK ? 1 : 0;
    no_plans += call.status == AB_NO_PLAN ? 1 : 0;
    sum_s += call.cpu_time_s;
    most_s = std::max(most_s, call.cpu_time_s);
  }
  if (calls.empty()) return "none";
  const double mean_s = sum_s / static_cast<double>(calls.size());
  return std::to_string(calls.size()) + ", of them " + std::to_string(commands) + " commands and " +
         std::to_string(no_plans) + " without a plan; CPU " + fixed_digits(1000.0 * mean_s, 2) +
         " ms, most " + fixed_digits(1000.0 * most_s, 2) + " ms";
}

/// "(1.00, -2.50, 2.00) m, 1.20 m/s, 0.35 m from the nearest surface, at 3.200 s"
std::string place_line(const Sample& sample) {
  const Eigen::Vector3d& place = sample.position_world;
  return "(" + fixed_digits(place.x(), 2) + ", " + fixed_digits(place.y(), 2) + ", " +
         fixed_digits(place.z(), 2) + ") m, " + fixed_digits(sample.velocity_world.norm(), 2) +
         " m/s, " + fixed_digits(sample.clearance_m, 2) + " m from the nearest surface, at " +
         fixed_digits(sample.time_s, 3) + " s";
}

/// What is to be noted of it.
RecordingWanted wanted_of(const ReplayOptions& options) {
  const bool is_film = !options.video.empty();
  return {.has_calls = !options.commands.empty(),
          .has_moments = is_film || !options.png.empty(),
          .has_page = !options.page.empty(),
          .at_s = options.at_s,
          .every_s = is_film ? 1.0 / kFilmMoments_hz : options.every_s.value_or(0.0)};
}

JobEnd fly_recorded(const Task& task, const RecordingWanted& wanted) {
  FleetJob job = task.flight.job;
  job.job.lookout = recording_job(wanted, job.job.spec);
  return fly_one(job, task.fleet);
}

/// Its places with their lines of source, "mine.so  plan(void*)+0x1b  mine.cpp:42", where the
/// library has them; on a machine that can't read them with the command that prints them elsewhere.
std::vector<std::string> stack_text(const CrashStack& stack, const PlannerChoice& planner) {
  std::vector<std::uint64_t> addresses;
  for (const StackPlace& place : stack.places) {
    if (place.address != 0) addresses.push_back(place.address);
  }
  const std::vector<std::string> lines = source_lines(stack.library_file, addresses);
  std::vector<std::string> text;
  std::size_t i = 0;
  for (const StackPlace& place : stack.places) {
    const std::string line = place.address != 0 && i < lines.size() ? lines[i++] : "";
    text.push_back(under_flown_name(place.text, planner) + (line.empty() ? "" : "  " + line));
  }
  if (lines.empty() && !addresses.empty()) {
    text.push_back("lines of source, with the package binutils: " +
                   joined(source_lines_command(stack.library_file, addresses), " "));
  }
  return text;
}

/// Flies it. Where its worker dies, what that has noted is lost: it is flown once more, up to the
/// call that did not come back.
Flown fly(const Task& task) {
  RecordingWanted wanted = wanted_of(task.options);
  JobEnd end = fly_recorded(task, wanted);
  const PlannerChoice& planner = task.flight.job.job.spec.planner;
  Flown flown{.record = record_of(end, planner),
              .has_died = end.death.has_value(),
              .has_begun = end.death && end.death->flown,
              .stack = {},
              .printed = std::move(end.printed),
              .recording = {}};
  flown.stack = stack_text(end.stack, planner);
  if (const std::string map = other_map_warning(task.flight.stored, end); !map.empty()) {
    std::cerr << "warning: " << map << '\n';
  }
  if (flown.has_begun) {
    wanted.most_calls = flown.record.plan_calls.size();
    end = fly_recorded(task, wanted);
    if (end.death) {
      std::cerr << "warning: flown once more for its log and pictures, it ended before the call "
                   "that did not return ("
                << visible_line(end.death->reason) << "): there are none\n";
    }
  }
  if (end.answer) flown.recording = recording_from(*end.answer->reported);
  return flown;
}

/// The lines under a title; the first are left out where there are more than `most` (0: none are).
template <class Lines, class Print>
void print_last(const std::string& title, const Lines& lines, std::size_t most, Print&& print) {
  if (lines.empty()) return;
  const std::size_t skipped = most > 0 && lines.size() > most ? lines.size() - most : 0;
  std::cout << '\n' << title;
  if (skipped > 0)
    std::cout << ", without its first " << counted(skipped, "line") << " (--log 0 for all)";
  std::cout << '\n';
  for (std::size_t i = skipped; i < lines.size(); ++i) print(lines[i]);
}

void print_log(const std::vector<LogLine>& log, std::size_t most) {
  print_last("log of the planner", log, most, [](const LogLine& line) {
    const std::string time = std::isnan(line.time_s) ? "" : fixed_digits(line.time_s, 3) + " s";
    std::cout << std::setw(10) << time << "  " << visible_line(line.text) << "\n";
  });
}

/// What the planner printed itself, to standard output or error.
void print_prints(const std::string& printed, std::size_t most) {
  std::vector<std::string> lines;
  std::istringstream stream(printed);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  print_last("printed by the planner", lines, most,
             [](const std::string& line) { std::cout << "  " << visible_line(line) << "\n"; });
}

/// The files that show what was seen: pictures, a video, a page.
void write_views(const Flown& flown, const Task& task) {
  const auto& [database, listing, flight, fleet, options] = task;
  if (options.png.empty() && options.video.empty() && options.page.empty()) return;
  const StoredTrial& stored = flight.stored;
  const FlightRecording& recording = flown.recording;
  const World world = flown_world(stored.spec, stored.mission);
  if (!options.png.empty()) {
    write_sheets(stored, world, flown.record, recording.moments, title_line(listing), options.png);
  }
  if (!options.video.empty()) {
    write_film(stored, world, flown.record, recording.moments, options.video);
  }
  if (!options.page.empty()) {
    write_page(flight_page(database, stored, world, flown.record, recording.seen, listing,
                           trial_text(listing), page_origin()),
               options.page);
  }
}

/// Not where a machine's time decided at which call the flight ended.
bool is_repeatable(const TrialRecord& record) {
  return record.outcome == Outcome::planner_crashed || record.reason == kCallTimeout;
}

/// Prints how the flight compares with the stored one. True where it is the same, or may differ.
bool print_comparison(const StoredFlight& flight, const TrialRecord& flown) {
  const TrialRecord& stored = flight.stored.row.record;
  // A worker that died before the first sample leaves no path.
  const bool is_comparable =
      !is_of_worker(stored.outcome) || !stored.samples.empty() || flown.samples.empty();
  if (!is_comparable) return true;
  const std::vector<std::string> found = differences(stored, flown);
  if (found.empty()) {
    std::cout << "replay    equal to the stored trial, bit for bit\n";
    return true;
  }
  std::cout << "replay    differs from the stored trial\n" << std::flush;
  for (const std::string& line : found) std::cerr << "warning: " << visible_line(line) << '\n';
  return !flight.warnings.empty() || (is_of_worker(stored.outcome) && !is_repeatable(stored));
}

/// Before the flight, which may take long.
void check_outputs(const ReplayOptions& options, const TrialListing& trial) {
  if (!options.png.empty()) check_output(options.png, "png");
  if (!options.page.empty()) check_page(options.page);
  if (!options.video.empty()) check_film(options.video);
  if (!options.csv.empty()) check_output(options.csv, "csv");
  if (!options.commands.empty()) check_output(options.commands, "csv");
  for (const double at_s : options.at_s) {
    if (!(at_s > trial.end_time_s)) continue;
    std::cerr << "warning: --at " << shortest(at_s) << " is after the end of the flight, "
              << fixed_digits(trial.end_time_s, 3) << " s: the end is shown\n";
  }
}

void replay_one(const Task& task) {
  const auto& [database, listing, flight, fleet, options] = task;
  for (const std::string& warning : flight.warnings) std::cerr << "warning: " << warning << '\n';
  if (flight.is_with_kept_planner) {
    std::cerr
        << "the planner's file is gone or has changed: flown with the copy that the run kept, "
        << flight.job.job.spec.planner.file << '\n';
  }
  std::cout << title_line(listing) << "\nstored    " << outcome_line(flight.stored.row.record)
            << "\n"
            << std::flush;
  const Flown flown = fly(task);
  const TrialRecord& record = flown.record;
  std::cout << "now       " << outcome_line(record) << "\ncalls     " << calls_line(flown) << "\n";
  if (flown.has_died && !record.samples.empty()) {
    std::cout << "place     " << place_line(record.samples.back()) << "\n";
  }
  const bool is_explained = print_comparison(flight, record);
  print_last("stack, innermost first", flown.stack, 0,
             [](const std::string& line) { std::cout << "  " << visible_line(line) << "\n"; });
  // What it printed last is next to where it died.
  if (flown.has_died) print_prints(flown.printed, options.log_lines);
  print_log(flown.recording.log, options.log_lines);
  if (!flown.has_died) print_prints(flown.printed, options.log_lines);
  std::cout << std::flush;
  if (!options.csv.empty()) write_text(trajectory_csv(record.samples), options.csv);
  if (!options.commands.empty()) {
    write_text(commands_csv(flown.recording.calls), options.commands);
  }
  write_views(flown, task);
  if (!is_explained) throw CLI::RuntimeError(kExitDiffers);
}

void replay(const ReplayOptions& options) {
  const Database database = Database::open_for_reading(database_of(options.database));
  TrialChoice choice = options.choice;
  for (const std::string& condition : options.where) {
    choice.where.push_back(parse_condition(condition));
  }
  const std::vector<std::string> fields = listed_fields(database, options.order, choice.where);
  const std::vector<TrialListing> all = listed_trials(database, fields, choice.where);
  if (all.empty()) refuse_file(database.path(), "holds no finished trial");
  const std::vector<TrialListing> chosen =
      in_order(chosen_trials(all, choice, fields), options.order, fields, database.metrics());
  if (options.is_list) {
    return write_table(trial_table(chosen, fields, options.output.is_for_people()), options.output);
  }
  ReplayPlanners planners(files_beside(options.database, database, options.flights));
  if (options.is_verify) {
    const double share = share_from(options.sample);
    const StopSignals& signals = watch_stop_signals();
    const FleetOptions fleet =
        fleet_options(options.flights, options.flights.job_count(), &signals);
    return verify_trials({database, chosen, share}, planners, fleet, signals);
  }
  const TrialListing listing = the_one_of(chosen);
  check_outputs(options, listing);
  const StoredFlight flight = stored_flight(possible_trial(database, listing.key), planners);
  // A signal ends it at once: there is nothing to lose.
  const FleetOptions fleet = fleet_options(options.flights, 1, nullptr);
  replay_one({database, listing, flight, fleet, options});
}

void add_choice_options(CLI::App& command, TrialChoice& choice) {
  command.add_option("TRIAL", choice.trial,
                     "Id of the trial, or the beginning of its key (default: the only one that the "
                     "options below match)");
  command.add_option("--planner", choice.planner, "Only trials of this planner, by its label");
  command.add_option("--map-seed", choice.map_seed, "Only trials of maps with this seed");
  command.add_option("--mission", choice.mission, "Only trials of this mission");
  command.add_option("--outcome", choice.outcome,
                     "Only trials with this outcome: collided, timed_out, …");
}

void add_view_options(CLI::App& command, ReplayOptions& options) {
  CLI::Option* png =
      add_typed(command, "--png", options.png, "FILE", "Picture to write; several are numbered");
  add_repeatable(command, "--at", options.at_s, "S",
                 "Moment to show, s; repeatable (default: the end of the flight)")
      ->check(CLI::NonNegativeNumber)
      ->needs(png);
  add_number(command, "--every", options.every_s, CLI::PositiveNumber,
             "Also show moments at this interval, s")
      ->needs(png);
  add_typed(command, "--video", options.video, "FILE",
            "Film to write, .mp4, .webm or .gif: from behind, what the planner saw, from "
            "above; needs the program ffmpeg")
      ->excludes(png);
  add_typed(command, "--page", options.page, "FILE",
            "Page to write: one HTML file with the flight in 3-D, what the planner saw, "
            "drew and commanded (docs/page.md)");
}

}  // namespace

void add_replay_command(CLI::App& app) {
  const auto [command, options] = add_command(
      app, "replay",
      "Fly stored trials again: one to see it (pictures, path, commands, log), or many to compare",
      replay);
  command.footer(
      "Pictures show what the planner draws (avoidbench::Canvas of planner.hpp). Exit code 1 if "
      "the flight differs from the\n"
      "stored one although planner and program are the same.\n\n"
      "Examples:\n"
      "  avoidbench replay results/quick.db --list --outcome collided\n"
      "  avoidbench replay results/quick.db --list --sort min_clearance_m --limit 5\n"
      "  avoidbench replay results/quick.db 12 --png trial.png\n"
      "  avoidbench replay results/quick.db --planner reactive --map-seed 1 "
      "--mission 2 \\\n"
      "    --where 'map.poisson_radius_m = 3.5' --png t.png --at 3.2 --at 4\n"
      "  avoidbench replay quick 12 --csv path.csv --commands commands.csv\n"
      "  avoidbench replay quick 12 --page flight.html --video flight.mp4\n"
      "  avoidbench replay quick --verify --sample 10%");
  command
      .add_option("DB", options.database, "Database, or a sweep's file or name for results/NAME.db")
      ->required();
  add_choice_options(command, options.choice);
  add_where(command, options.where);
  add_order_options(command, options.order);
  CLI::Option* list = command.add_flag(
      "--list", options.is_list,
      "List these trials and fly none; as csv or json with keys, starts and goals");
  CLI::Option* verify = command
                            .add_flag("--verify", options.is_verify,
                                      "Fly all of these trials again and compare them bit for bit; "
                                      "exit code 1 if one differs")
                            ->excludes(list);
  command
      .add_option("--sample", options.sample,
                  "Share of them to verify, such as 10%, chosen by their keys")
      ->needs(verify);
  add_number(command, "-j,--jobs", options.flights.jobs, CLI::Range(0, 1024),
             "Worker processes that verify; 0: one per allowed CPU")
      ->needs(verify);
  add_view_options(command, options);
  add_typed(command, "--csv", options.csv, "FILE", "Path to write as CSV");
  add_typed(command, "--commands", options.commands, "FILE", "The planner's calls to write as CSV");
  command.add_option(
      "--log", options.log_lines,
      "Maximum number of lines of the planner's log, and of what it printed; 0: all");
  add_replay_options(command, options.flights);
  add_output_options(command, options.output);
}

}  // namespace avoidbench
