#include <iostream>

#include "command_options.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "output.hpp"
#include "report/summary.hpp"
#include "report/sweep_tables.hpp"
#include "run_flights.hpp"
#include "store/database.hpp"
#include "table/table.hpp"

namespace avoidbench {
namespace {

struct LimitCommand {
  RunCommand run;
  LimitRequest request;
  OutputOptions output;
};

void limit(const LimitCommand& command) {
  check_output(command.output.output, text(command.output.format));
  const SweepSpec sweep =
      read_limit_sweep(command.run.sweep_file, command.run.overrides, command.request);
  const std::int64_t revision = fly_sweep(command.run, sweep, {});
  const Database database = Database::open_for_reading(database_file(command.run, sweep, {}));
  const SweepResult result = database.read_sweep(sweep.name, revision, {sweep.limit.field});
  write_sections(std::vector{sweep_section(summarize(result), {}, Detail::brief)}, command.output);
}

CLI::Option* add_direction(CLI::App& command, const std::string& name, LimitRequest& request,
                           LimitDirection direction, const std::string& doc) {
  return command.add_flag_callback(
      name, [&request, direction] { request.direction = direction; }, doc);
}

}  // namespace

void add_limit_command(CLI::App& app) {
  const auto [command, options] = add_command(
      app, "limit",
      "Find how far planners go: the value of a field at which success crosses a rate", limit);
  add_sweep_options(command, options.run);
  add_typed(
      command, "--over", options.request.over, "FIELD=LOW..HIGH",
      "The number that is varied, and its range: maps.poisson_radius_m=1.5..6, latency.ms=0..500, "
      "wind.mean_world_mps[0]=0..12, max_speed_mps=1..10")
      ->required();
  add_number(command, "--success", options.request.success_rate, CLI::Range(0.05, 0.99),
             "The rate of success that is crossed there");
  add_number(command, "--reach", options.request.reach_mps, CLI::PositiveNumber,
             "A mission counts with this goal velocity (shortest path over flight time) or more, "
             "m/s: with the usual rate the limit is where v90 falls below it [any]");
  add_number(command, "--width", options.request.width, CLI::PositiveNumber,
             "Width of the 95 % interval that is narrow enough, in units of the field [a tenth of "
             "the range]");
  add_number(command, "--max-trials", options.request.most_trials, CLI::Range(18, 1000000),
             "Most trials of a planner");
  command.add_flag("--paired", options.request.is_paired,
                   "All planners fly the trials that any of them needs: which of two has the "
                   "higher limit is then told on the same missions");
  add_direction(command, "--falls", options.request, LimitDirection::falls,
                "Success falls as the number grows, as is known beforehand: no trials are spent on "
                "which way it goes")
      ->excludes(add_direction(command, "--rises", options.request, LimitDirection::rises,
                               "Success rises as it grows"));
  add_flight_options(command, options.run);
  add_output_options(command, options.output);
  command.footer(
      "Flies a few trials at values over the whole range, then more where they tell most of each "
      "planner's limit, until\n"
      "its interval is narrow enough. Which trials follows from results alone: the same ones for "
      "any number of workers,\n"
      "and the same command goes on where it was stopped. The sweep's maps and missions are used "
      "in turn; give it many\n"
      "(maps.seeds), since what is found is of maps like these.\n\n"
      "Examples:\n"
      "  avoidbench limit forest_small --over maps.poisson_radius_m=1.5..6 --reach 3\n"
      "  avoidbench limit hall_small --over latency.ms=0..400 --success 0.8 --paired\n\n"
      "Exit codes: as those of `run`");
}

}  // namespace avoidbench
