#include "commands.hpp"
#include "compare/power_table.hpp"
#include "output.hpp"

namespace avoidbench {

void add_power_command(CLI::App& app) {
  struct PowerOptions {
    PowerQuestion question;
    OutputOptions output;
  };
  const auto [command, options] = add_command<PowerOptions>(
      app, "power", "How many trials tell two success rates apart", [](const PowerOptions& asked) {
        const Section section = power_section(asked.question);
        write_sections({&section, 1}, asked.output);
      });
  PowerQuestion& question = options.question;
  command.add_option("--sr", question.success_rate, "Success rate of the better planner");
  command.add_option("--detect", question.detect, "Loss of success rate to find");
  command.add_option("--power", question.power, "Probability of finding it");
  command.add_option("--alpha", question.alpha, "Level of the two-sided test");
  command.add_option("--discordance", question.discordance,
                     "Share of missions on which two planners end differently, for paired tests "
                     "[that of independent planners]");
  command.add_option("--trials", question.trials,
                     "Trials per planner: what can be found with them");
  add_output_options(command, options.output);
  command.footer(
      "Example: what tells a planner that reaches its goal in 90 % of trials from one that does in "
      "85 %?\n"
      "  avoidbench power --sr 0.9 --detect 0.05");
}

}  // namespace avoidbench
