#include <optional>

#include "base/option_error.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "compare/power_table.hpp"
#include "database_choice.hpp"
#include "output.hpp"

namespace avoidbench {
namespace {

struct PowerOptions {
  PowerQuestion question;
  std::optional<double> detect_v90_mps;
  std::string pilot, sweep;
  OutputOptions output;
};

/// The one sweep of the pilot that is asked for.
SweepSummary pilot_of(const PowerOptions& asked) {
  const std::vector<Database> databases = opened({asked.pilot}, "the pilot sweep");
  const auto sweeps = chosen_sweeps(databases, asked.sweep);
  if (sweeps.front().size() != 1) {
    throw OptionError("the pilot has several sweeps: choose one", "sweep");
  }
  const SweepInfo& sweep = sweeps.front().front();
  return summarize(databases.front().read_sweep(sweep.name, sweep.revision, {}));
}

void print_power(const PowerOptions& asked) {
  const PowerQuestion& question = asked.question;
  const Section section = asked.detect_v90_mps
                              ? speed_power_section(pilot_of(asked), *asked.detect_v90_mps,
                                                    question.power, question.alpha)
                              : power_section(question);
  write_sections({&section, 1}, asked.output);
}

}  // namespace

void add_power_command(CLI::App& app) {
  const auto [command, options] = add_command<PowerOptions>(
      app, "power",
      "Find how many trials tell two success rates apart, or how many maps tell two v90 apart",
      print_power);
  PowerQuestion& question = options.question;
  command.add_option("--sr", question.success_rate, "Success rate of the better planner");
  command.add_option("--detect", question.detect, "Loss of success rate to find");
  command.add_option("--power", question.power, "Probability of finding it");
  command.add_option("--alpha", question.alpha, "Level of the two-sided test");
  command.add_option("--discordance", question.discordance,
                     "Share of missions on which two planners end differently, for paired tests "
                     "[that of independent planners]");
  command.add_option("--trials", question.trials,
                     "Trials per planner: shows what can be found with them");
  CLI::Option* pilot =
      add_typed(command, "--pilot", options.pilot, "DB",
                "Database of a pilot sweep, which shows how much v90 differs from map to map");
  add_typed(command, "--sweep", options.sweep, "NAME", "Sweep of the pilot")->needs(pilot);
  add_number(command, "--detect-v90", options.detect_v90_mps, CLI::PositiveNumber,
             "Difference of v90 to find, m/s: counts maps instead of trials, for the pilot's pairs "
             "of planners")
      ->needs(pilot);
  add_output_options(command, options.output);
  command.footer(
      "Example: how many trials tell a planner with a success rate of 90 % from one with 85 %?\n"
      "  avoidbench power --sr 0.9 --detect 0.05\n"
      "How many maps tell two planners apart whose v90 differ by 0.2 m/s?\n"
      "  avoidbench power --detect-v90 0.2 --pilot results/forest_small.db");
}

}  // namespace avoidbench
