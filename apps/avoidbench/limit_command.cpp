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
      "Find planners' limits: the value of a field at which the success rate crosses a threshold",
      limit);
  add_sweep_options(command, options.run);
  add_typed(
      command, "--over", options.request.over, "FIELD=LOW..HIGH",
      "The number that is varied, and its range: maps.poisson_radius_m=1.5..6, latency.ms=0..500, "
      "wind.mean_world_mps[0]=0..12, max_speed_mps=1..10")
      ->required();
  add_number(command, "--success", options.request.success_rate, CLI::Range(0.05, 0.99),
             "The success rate at the limit");
  add_number(
      command, "--reach", options.request.reach_mps, CLI::PositiveNumber,
      "A mission counts as a success only with this goal velocity (shortest path over flight time) "
      "or more, m/s: with the default rate, the limit is where v90 falls below it [any]");
  add_number(
      command, "--width", options.request.width, CLI::PositiveNumber,
      "Stop once the 95 % interval is this narrow, in units of the field [a tenth of the range]");
  add_number(command, "--max-trials", options.request.most_trials, CLI::Range(18, 1000000),
             "Maximum number of trials per planner");
  command.add_flag("--paired", options.request.is_paired,
                   "All planners fly the trials that any of them needs, so that limits are "
                   "compared on the same missions");
  add_direction(
      command, "--falls", options.request, LimitDirection::falls,
      "Assume that success falls as the number grows: no trials are spent on finding the direction")
      ->excludes(add_direction(command, "--rises", options.request, LimitDirection::rises,
                               "Assume that success rises as the number grows"));
  add_flight_options(command, options.run);
  add_output_options(command, options.output);
  command.footer(
      "Flies a few trials across the range, then more where they are most informative about each "
      "planner's limit, until its\n"
      "interval is narrow enough. The choice depends on results alone: it is the same for any "
      "number of workers, and the\n"
      "same command resumes where it was stopped. The sweep's maps and missions are used in turn; "
      "give it many\n"
      "(maps.seeds), since the limit holds for maps like these.\n\n"
      "Examples:\n"
      "  avoidbench limit forest_small --over maps.poisson_radius_m=1.5..6 --reach 3\n"
      "  avoidbench limit hall_small --over latency.ms=0..400 --success 0.8 --paired\n\n"
      "Exit codes: as those of `run`");
}

}  // namespace avoidbench
