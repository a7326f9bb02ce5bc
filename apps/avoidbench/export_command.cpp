#include <iostream>
#include <optional>

#include "base/option_error.hpp"
#include "base/output_file.hpp"
#include "commands.hpp"
#include "database_choice.hpp"
#include "export/export_flight.hpp"
#include "export/export_legs.hpp"
#include "export/export_trials.hpp"
#include "export/trial_list.hpp"
#include "export_choice.hpp"
#include "output.hpp"
#include "report/selection.hpp"

namespace avoidbench {
namespace {

struct ExportOptions {
  std::vector<std::string> words;  // databases, or a database and trials
  std::string sweep, output = "-";
  TrialFormat trial_format = TrialFormat::csv;
  TrajectoryFormat trajectory_format = TrajectoryFormat::csv;
  TrialOrder trial_order;
};

void write_trials(const ExportOptions& options) {
  check_output(options.output, text(options.trial_format));
  const std::vector<Database> databases = opened(options.words, "trials");
  std::optional<Output> output;  // made with the first line: bad options leave a former file alone
  export_trials(
      databases, options.sweep, options.trial_format,
      [&](const std::string& line) {
        if (!output) output.emplace(options.output);
        output->write(line);
      },
      options.trial_order);
  if (output) output->close();
}

/// Writes `text_of` each chosen trial: one to the output, several as files of a folder.
template <class TextOf>
void write_each(const ExportOptions& options, const std::string& extension, TextOf text_of) {
  const auto chosen = chosen_of(options.words);
  const Database& database = chosen.first;
  write_files(chosen.second, options.output, extension,
              [&](const TrialListing& trial, const std::string& file) {
                const std::optional<TrialRow> row = database.read_trial(trial.key);
                if (!row) throw InputError("trial " + trial.key + " is gone");
                warn_of_no_path(trial, row->record);
                write_text(text_of(row->record), file);
              });
}

void write_trajectories(const ExportOptions& options) {
  write_each(options, std::string(text(options.trajectory_format)), [&](const TrialRecord& record) {
    return trajectory_text(record.samples, options.trajectory_format);
  });
}

void write_calls(const ExportOptions& options) {
  write_each(options, "csv",
             [](const TrialRecord& record) { return plan_calls_csv(record.plan_calls); });
}

void write_legs(const ExportOptions& options) {
  check_output(options.output, "csv");
  const bool has_trials =
      !options.words.empty() && (options.words.size() > 1 || !is_database(options.words.front()));
  std::optional<Database> database;
  std::vector<TrialListing> trials;
  if (has_trials) {
    auto [opened, listed] = chosen_of(options.words);
    database.emplace(std::move(opened));
    trials = std::move(listed);
  } else {
    database.emplace(Database::open_for_reading(
        options.words.empty() ? newest_database("trials") : database_of(options.words.front())));
    trials = database->list_trials();
  }
  StoredTrialReader reader(*database);
  Output output(options.output);
  output.write(legs_csv_header());
  for (const TrialListing& trial : trials) output.write(legs_csv(reader.read(trial.key)));
  output.close();
}

void add_trials(CLI::App& app) {
  const auto [command, options] = add_command(
      app, "trials", "Every trial with its map, mission and metrics: one flat table", write_trials);
  command.add_option(
      "DB", options.words,
      "Databases; a trial that several contain is written once (default: the newest results/*.db)");
  add_sweep_choice(command, options.sweep);
  add_choice(command, "--format", options.trial_format, "csv (RFC 4180) or jsonl (JSON lines)");
  add_output_file(command, options.output);
  add_order_options(command, options.trial_order);
  command.footer(
      "The columns are those of the view trial_table; what the sweep varies is named by its path. "
      "Names include the unit,\n"
      "numbers have all digits.\n\n"
      "Example:\n"
      "  avoidbench export trials results/quick.db --output quick.csv\n"
      "  avoidbench export trials quick --sort min_clearance_m --limit 10");
}

std::pair<CLI::App&, ExportOptions&> add_of_trials(CLI::App& app, const std::string& name,
                                                   const std::string& doc,
                                                   void (*work)(const ExportOptions&)) {
  const auto [command, options] = add_command(app, name, doc, work);
  command
      .add_option("TRIAL", options.words,
                  "Ids of trials or the beginnings of their keys, after an optional database "
                  "(default: the newest results/*.db)")
      ->required();
  add_output_file(command, options.output)
      ->description(
          "File to write, - for standard output; for several trials a folder with one file each");
  return {command, options};
}

void add_trajectory(CLI::App& app) {
  const auto [command, options] =
      add_of_trials(app, "trajectory", "The flown path of trials", write_trajectories);
  add_choice(command, "--format", options.trajectory_format,
             "csv (all that is stored), or tum (timestamp tx ty tz qx qy qz qw: for evo)");
  command.footer(
      "Example:\n"
      "  avoidbench export trajectory results/quick.db 3 7 --format tum --output paths");
}

void add_calls(CLI::App& app) {
  add_of_trials(app, "calls", "The planner's calls in trials, as CSV", write_calls)
      .first.footer("Example:\n  avoidbench export calls results/quick.db 3 --output calls.csv");
}

void add_legs(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "legs", "The legs of trials, one per goal, as CSV", write_legs);
  command.add_option("TRIAL", options.words,
                     "Ids of trials or the beginnings of their keys (default: all), after an "
                     "optional database (default: the newest results/*.db)");
  add_output_file(command, options.output);
  command.footer(
      "One row per leg that was begun: its goal, when it began and ended, the lengths of the flown "
      "and the shortest path.\n"
      "d_min of a mission is the sum over its legs.\n\n"
      "Example:\n"
      "  avoidbench export legs results/waypoints.db --output legs.csv");
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "export", "Results for other programs: flat tables, flown paths, planner calls, legs, MCAP");
  command->require_subcommand(0, 1);
  add_trials(*command);
  add_trajectory(*command);
  add_calls(*command);
  add_legs(*command);
  add_export_mcap_command(*command);
}

}  // namespace avoidbench
