#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/option_error.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_flight.hpp"
#include "output.hpp"
#include "page/flight_page.hpp"
#include "page_output.hpp"
#include "process/isolated_run.hpp"
#include "process/print_capture.hpp"
#include "program_planner/program_prints.hpp"
#include "replay/apart.hpp"
#include "replay/replay.hpp"
#include "replay/sample.hpp"
#include "text/number_text.hpp"
#include "text/visible_text.hpp"
#include "view_output.hpp"
#include "worker/worker_death.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

constexpr int kExitDiffers = 1;

struct ReplayOptions {
  std::string database;
  TrialChoice choice;
  TrialOrder order;
  bool is_list = false, is_verify = false;
  std::string sample = "100%";
  OutputOptions output;
  ReplayFiles files;
  std::string png, csv, commands, page, video;
  std::vector<double> at_s;
  std::optional<double> every_s;
  std::size_t log_lines = 30;
  double plan_timeout_s = 10.0;
};

/// A line that the planner logged.
struct LogLine {
  double time_s;  ///< NaN: before or after the calls
  std::string text;
};

/// A trial that is to be flown again.
struct Task {
  const Database& database;
  const TrialListing& listing;
  const StoredTrial& stored;
  const ReplayFiles& files;
  const ReplayOptions& options;
};

/// All that is known of a flight that was flown again.
struct Flown {
  TrialRecord record;
  std::vector<LogLine> log;
  std::vector<CommandLine> calls;
  std::vector<Moment> moments;
  std::optional<SeenRecorder> seen;  ///< for a page
};

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

/// "(1.00, -2.50, 2.00) m, 1.20 m/s, 0.35 m from the nearest surface, at 3.200 s"
std::string place_line(const Sample& sample) {
  const Eigen::Vector3d& place = sample.position_world;
  return "(" + fixed_digits(place.x(), 2) + ", " + fixed_digits(place.y(), 2) + ", " +
         fixed_digits(place.z(), 2) + ") m, " + fixed_digits(sample.velocity_world.norm(), 2) +
         " m/s, " + fixed_digits(sample.clearance_m, 2) + " m from the nearest surface, at " +
         fixed_digits(sample.time_s, 3) + " s";
}

/// Flies it, or, where `most_calls` is given, up to the call of the planner after so many.
Flown fly(const Replay& replay, const Task& task, std::optional<std::size_t> most_calls = {}) {
  const ReplayOptions& options = task.options;
  Flown flown;
  const bool is_film = !options.video.empty(), has_moments = is_film || !options.png.empty();
  const double every_s = is_film ? 1.0 / kFilmMoments_hz : options.every_s.value_or(0.0);
  MomentRecorder recorder(options.at_s, every_s, task.stored.spec);
  if (!options.page.empty()) flown.seen.emplace(task.stored.spec);
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) {
    for (const std::string& line : step.log) flown.log.push_back({step.time_s, line});
    flown.calls.push_back(command_line(step));
    if (has_moments) recorder.planned(step);
    if (flown.seen) flown.seen->planned(step);
  };
  PrintTrimmer trimmer(STDOUT_FILENO);
  observer.planning = [&](const PlanCallAhead& call) {
    trimmer.trim();
    if (!most_calls || flown.calls.size() < *most_calls) return true;
    if (has_moments) recorder.planning(call);
    return false;
  };
  std::vector<std::string> other_lines;
  flown.record = replay.fly(observer, other_lines);
  for (const std::string& line : other_lines) flown.log.push_back({std::nan(""), line});
  if (has_moments) flown.moments = recorder.finish(flown.record.end_time_s);
  return flown;
}

/// The lines under a title; the first are left out where there are more than `most` (0: none are).
template <class Lines, class Print>
void print_last(const std::string& title, const Lines& lines, std::size_t most, Print&& print) {
  if (lines.empty()) return;
  const std::size_t skipped = most > 0 && lines.size() > most ? lines.size() - most : 0;
  std::cout << '\n' << title;
  if (skipped > 0) std::cout << ", without its first " << skipped << " lines (--log 0 for all)";
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

/// Prints how the flight compares with the stored one. True where it is the same, or may differ.
bool print_comparison(const StoredTrial& stored, bool must_be_equal, const TrialRecord& record) {
  const std::vector<std::string> found = differences(stored.row.record, record);
  if (found.empty()) {
    std::cout << "replay    equal to the stored trial, bit for bit\n";
    return true;
  }
  std::cout << "replay    differs from the stored trial\n" << std::flush;
  for (const std::string& line : found) std::cerr << "warning: " << visible_line(line) << '\n';
  return !must_be_equal;
}

/// The files that show what was seen: pictures, a video, a page.
void write_views(const Flown& flown, const Replay& replay, const Task& task) {
  const auto& [database, listing, stored, files, options] = task;
  const World& world = replay.world();
  if (!options.png.empty()) {
    write_sheets(stored, world, flown.record, flown.moments, title_line(listing), options.png);
  }
  if (!options.video.empty()) {
    write_film(stored, world, flown.record, flown.moments, options.video);
  }
  if (flown.seen) {
    // A child of a process must not read by its parent's handle.
    const Database own = Database::open_for_reading(database.path());
    write_page(flight_page(own, stored, world, flown.record, *flown.seen, listing,
                           trial_text(listing), page_origin()),
               options.page);
  }
}

/// Whether the end was a worker's, which a flight in this process can't have.
bool is_of_worker(Outcome outcome) {
  return outcome == Outcome::planner_crashed || outcome == Outcome::planner_hung;
}

/// Not where a machine's time decided at which call the flight ended.
bool is_repeatable(const TrialRecord& record) {
  return record.outcome == Outcome::planner_crashed || record.reason == kCallTimeout;
}

/// What a child says of a flight that it flew again.
constexpr char kFlownCopy = 'c', kFlownFile = 'f', kNotFlown = 'e';

/// Flies it again: one of the marks above, and lines about what differs, or why it can't be flown.
std::string repeat_text(const StoredTrial& stored, const ReplayFiles& files) {
  try {
    const Replay replay(stored, files);
    std::vector<std::string> log;
    const TrialRecord flown = replay.fly({}, log);
    std::string text(1, replay.kept_planner_file().empty() ? kFlownFile : kFlownCopy);
    const std::vector<std::string> found = differences(replay.stored().row.record, flown);
    for (const std::string& line : found) text += "  " + visible_line(line) + '\n';
    if (found.empty()) return text;
    for (const std::string& line : replay.warnings()) text += "  note: " + line + '\n';
    return text;
  } catch (const OptionError& error) {
    return kNotFlown + error.hint() + '\n' + error.what();
  } catch (const InputError& error) {
    return kNotFlown + std::string("\n") + error.what();
  }
}

/// The error that a child could not fly for.
[[noreturn]] void throw_not_flown(const std::string& text) {
  const std::size_t line_end = text.find('\n');
  const std::string hint = text.substr(1, line_end - 1);
  if (!hint.empty()) throw OptionError(text.substr(line_end + 1), "", hint);
  std::vector<InputProblem> problems;
  std::istringstream lines(text.substr(line_end + 1));
  for (std::string line; std::getline(lines, line);)
    problems.push_back({.file = {}, .message = line});
  throw InputError(std::move(problems));
}

/// Flies it again in a process of its own, so that no planner knows of another trial; whether it is
/// the same. Counts a flight with a kept copy of the planner.
bool is_repeated(const Database& database, const TrialListing& trial, const ReplayFiles& files,
                 std::int64_t& with_copy) {
  constexpr double kMostTime_s = 3600.0;  // as a trial of a run
  const StoredTrial stored = possible_trial(database, trial.key);
  const IsolatedEnd end = run_isolated(
      [&](IsolatedOutput& output) { output.write(repeat_text(stored, files)); }, kMostTime_s);
  std::string lines;
  if (!end.problem.empty() || end.output.empty()) {
    lines = "  flown again it " + (end.problem.empty() ? "says nothing" : end.problem) + '\n';
  } else if (end.output.front() == kNotFlown) {
    throw_not_flown(end.output);
  } else {
    with_copy += end.output.front() == kFlownCopy ? 1 : 0;
    lines = end.output.substr(1);
  }
  if (lines.empty()) return true;
  std::cout << "trial " << trial.id << " (" << trial.key.substr(0, 8) << ", "
            << visible_line(trial.planner_label) << ") differs:\n"
            << lines;
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
  std::int64_t flown = 0, different = 0, passed_over = 0, with_copy = 0;
  for (const TrialListing& trial : trials) {
    if (!is_sampled(trial.key, share)) continue;
    if (is_of_worker(trial.outcome)) {
      ++passed_over;
      continue;
    }
    ++flown;
    different += is_repeated(database, trial, files, with_copy) ? 0 : 1;
  }
  std::cout << flown << " trials flown again, " << different << " different\n";
  if (passed_over > 0) {
    std::cout << passed_over << " crashed or hung and were not flown: see avoidbench run --rerun\n";
  }
  if (with_copy > 0) {
    std::cerr << with_copy
              << " of them with copies of planners that the run kept: their files are gone or "
                 "others now\n";
  }
  if (flown == 0 && passed_over == 0) std::cerr << "the sample has no trial: make it larger\n";
  if (different > 0) throw CLI::RuntimeError(kExitDiffers);
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

/// What a child does with a flight whose planner does not come back from its last call of
/// `apart`'s: it flies up to there, writes the files that are wanted and tells its lines, those for
/// stderr with a mark.
constexpr char kToStderr = '!';
std::string look_up_to(const TrialRecord& apart, const Task& task) {
  const Replay replay(task.stored, task.files);
  Flown flown = fly(replay, task, apart.plan_calls.size());
  flown.record.outcome = apart.outcome;
  flown.record.reason = apart.reason;
  std::ostringstream out, errors;  // from here on only: what the planner prints is shown already
  std::streambuf* const cout_before = std::cout.rdbuf(out.rdbuf());
  std::streambuf* const cerr_before = std::cerr.rdbuf(errors.rdbuf());
  try {
    print_log(flown.log, task.options.log_lines);
    if (!task.options.commands.empty()) {
      write_text(commands_csv(flown.calls), task.options.commands);
    }
    write_views(flown, replay, task);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
  }
  std::cout.rdbuf(cout_before);
  std::cerr.rdbuf(cerr_before);
  std::string lines = out.str();
  std::istringstream of_errors(errors.str());
  for (std::string line; std::getline(of_errors, line);) lines += kToStderr + line + '\n';
  return lines;
}

/// Runs look_up_to() in a child, since the planner may end a process earlier this time.
void look_apart(const TrialRecord& apart, const Task& task, double most_s) {
  const IsolatedEnd end =
      run_isolated([&](IsolatedOutput& output) { output.write(look_up_to(apart, task)); }, most_s);
  std::istringstream lines(end.output);
  for (std::string line; std::getline(lines, line);) {
    const bool is_error = line.starts_with(kToStderr);
    (is_error ? std::cerr : std::cout) << line.substr(is_error ? 1 : 0) << '\n';
  }
  if (!end.problem.empty()) {
    std::cerr << "warning: flown once more for its log and pictures, it " << end.problem
              << " before the call that it did not come back from: there are none\n";
  }
}

/// A trial whose planner crashed or hung, flown in a process of its own, with the time limit.
void replay_apart(const Task& task) {
  const auto& [database, listing, stored, files, options] = task;
  std::cout << title_line(listing) << "\nstored    " << outcome_line(stored.row.record) << "\n"
            << std::flush;
  const auto began = std::chrono::steady_clock::now();
  const ApartFlight flown =
      fly_apart(stored, files, apart_options(database, {listing.key}, options.plan_timeout_s, 1));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  for (const std::string& warning : flown.warnings) std::cerr << "warning: " << warning << '\n';
  const TrialRecord& record = flown.record;
  std::cout << "now       " << outcome_line(record) << "\ncalls     " << record.plan_calls.size()
            << (flown.has_begun && is_of_worker(record.outcome)
                    ? " that came back, and one that did not"
                    : "")
            << "\n";
  if (!record.samples.empty()) {
    std::cout << "place     " << place_line(record.samples.back()) << "\n";
  }
  bool is_explained = true;
  // An older program stored no path of such flights.
  if (!stored.row.record.samples.empty() || record.samples.empty()) {
    const bool must_be_equal = flown.warnings.empty() && is_repeatable(stored.row.record);
    is_explained = print_comparison(stored, must_be_equal, record);
  }
  print_last("stack, innermost first", flown.stack, 0,
             [](const std::string& line) { std::cout << "  " << visible_line(line) << "\n"; });
  print_prints(flown.printed, options.log_lines);
  std::cout << std::flush;
  if (!options.csv.empty()) write_text(trajectory_csv(record.samples), options.csv);
  // Its way there takes no longer than that; pictures take some time, too.
  const double most_s = 60.0 + 3.0 * took.count();
  if (flown.has_begun) look_apart(record, task, most_s);
  std::cout << std::flush;
  if (!is_explained) throw CLI::RuntimeError(kExitDiffers);
}

void replay(const ReplayOptions& options) {
  const Database database = Database::open_for_reading(database_of(options.database));
  const std::vector<std::string> fields = listed_fields(database, options.order);
  std::vector<TrialListing> all = database.list_trials(fields);
  if (all.empty()) refuse_file(database.path(), "holds no finished trial");
  if (!options.order.field.empty() || options.order.limit) {
    all = in_order(chosen_trials(all, options.choice), options.order, fields, database.metrics());
  }
  if (options.is_list) {
    return write_table(
        trial_table(chosen_trials(all, options.choice), fields, options.output.is_for_people()),
        options.output);
  }
  const ReplayFiles files = files_beside(options.database, database, options.files);
  if (options.is_verify) {
    const double share = share_from(options.sample);
    enter_worker_environment();
    return verify_trials(database, chosen_trials(all, options.choice), share, files);
  }
  const TrialListing listing = the_trial(all, options.choice);
  enter_worker_environment();  // which may begin the program again
  check_outputs(options, listing);
  const StoredTrial stored = possible_trial(database, listing.key);
  const Task task{database, listing, stored, files, options};
  if (is_of_worker(listing.outcome)) return replay_apart(task);
  const PrintCapture prints;
  std::optional<PrintsCaptured> captured(prints);
  pass_prints_on(STDOUT_FILENO);  // planners that are programs are captured there as libraries are
  const Replay replay(stored, files);
  captured.reset();
  for (const std::string& warning : replay.warnings()) std::cerr << "warning: " << warning << '\n';
  if (!replay.kept_planner_file().empty()) {
    std::cerr << "the planner's file is gone or another one now: flown with the copy that the run "
                 "kept, "
              << replay.kept_planner_file().string() << '\n';
  }
  std::cout << title_line(listing) << "\nstored    " << outcome_line(stored.row.record) << "\n"
            << std::flush;
  captured.emplace(prints);
  const Flown flown = fly(replay, task);
  captured.reset();
  std::cout << "now       " << outcome_line(flown.record) << "\ncalls     "
            << calls_line(flown.calls) << "\n";
  const bool is_explained = print_comparison(stored, replay.warnings().empty(), flown.record);
  print_log(flown.log, options.log_lines);
  print_prints(prints.text(), options.log_lines);
  std::cout << std::flush;
  if (!options.csv.empty()) write_text(trajectory_csv(flown.record.samples), options.csv);
  if (!options.commands.empty()) write_text(commands_csv(flown.calls), options.commands);
  write_views(flown, replay, task);
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

void add_view_options(CLI::App& command, ReplayOptions& options) {
  CLI::Option* png = add_typed(command, "--png", options.png, "FILE",
                               "Picture to write; of several, numbered ones");
  add_repeatable(command, "--at", options.at_s, "S",
                 "Moment to show, s; repeatable (default: the end of the flight)")
      ->check(CLI::NonNegativeNumber)
      ->needs(png);
  add_number(command, "--every", options.every_s, CLI::PositiveNumber,
             "Show a moment each so many seconds, too")
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
      "The planner may draw what it thinks (avoidbench::Canvas of planner.hpp): pictures show it. "
      "Exit code 1 where\nthe flight differs from the stored one though planner and program are "
      "the same.\n\n"
      "Examples:\n"
      "  avoidbench replay results/quick.db --list --outcome collided\n"
      "  avoidbench replay results/quick.db --list --sort min_clearance_m --limit 5\n"
      "  avoidbench replay results/quick.db 12 --png trial.png\n"
      "  avoidbench replay results/quick.db --planner reactive --map-seed 1 --radius 3.5 "
      "--mission 2 \\\n"
      "    --png t.png --at 3.2 --at 4\n"
      "  avoidbench replay quick 12 --csv path.csv --commands commands.csv\n"
      "  avoidbench replay quick 12 --page flight.html --video flight.mp4\n"
      "  avoidbench replay quick --verify --sample 10%");
  command
      .add_option("DB", options.database, "Database, or a sweep's file or name for results/NAME.db")
      ->required();
  add_choice_options(command, options.choice);
  add_order_options(command, options.order);
  CLI::Option* list = command.add_flag(
      "--list", options.is_list,
      "List these trials and fly none; as csv or json with keys, starts and goals");
  CLI::Option* verify =
      command
          .add_flag("--verify", options.is_verify,
                    "Fly all of these trials again and compare them bit for bit; exit code 1 where "
                    "one differs")
          ->excludes(list);
  command
      .add_option("--sample", options.sample,
                  "Share of them to verify, such as 10%, chosen by their keys")
      ->needs(verify);
  add_view_options(command, options);
  add_typed(command, "--csv", options.csv, "FILE", "Path to write as CSV");
  add_typed(command, "--commands", options.commands, "FILE", "The planner's calls to write as CSV");
  command.add_option("--log", options.log_lines,
                     "Most lines of the planner's log, and of what it printed; 0: all");
  add_number(command, "--plan-timeout", options.plan_timeout_s, CLI::PositiveNumber,
             "Wall time after which a call of the planner counts as hung, s; of a trial that "
             "crashed or hung, which is flown in a process of its own");
  add_file_options(command, options.files);
  add_output_options(command, options.output);
}

}  // namespace avoidbench
