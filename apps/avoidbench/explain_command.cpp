#include "commands.hpp"
#include "explain.hpp"

namespace avoidbench {

void add_explain_command(CLI::App& app) {
  const auto [command, options] = add_command<ExplainOptions>(
      app, "explain",
      "Why trials failed: the cause of each, what would have cured it, and the smallest map that "
      "still fails",
      [](const ExplainOptions& asked) {
        if (!asked.minimal.empty()) return explain_minimal(asked);
        if (!asked.what_if.empty()) return explain_what_if(asked);
        explain_causes(asked);
      });
  command.footer(
      "Rules find the cause from measurements of the flight; a collision takes one more flight. "
      "Causes are stored in the\n"
      "database: report and compare show them.\n"
      "Flights with changes are stored in the database; the same command resumes where it was "
      "stopped. docs/explain.md\n\n"
      "Examples:\n"
      "  avoidbench explain quick\n"
      "  avoidbench explain quick 23 --png moment.png\n"
      "  avoidbench explain quick --what-if true_depth,no_latency,no_wind\n"
      "  avoidbench explain quick --what-if all --control 20 --format latex\n"
      "  avoidbench explain quick 23 --what-if all\n"
      "  avoidbench explain quick 23 --minimal scene && avoidbench run scene/sweep.yaml\n\n"
      "Exit codes: 0 done, 1 a flight with nothing changed differs from the stored one, or a "
      "worker was killed from outside, 2 usage or input, 75 stopped by SIGTERM, SIGHUP, SIGUSR1 or "
      "SIGXCPU, 130 interrupted");
  command
      .add_option("DB", options.database, "Database, or a sweep's file or name for results/NAME.db")
      ->required();
  command.add_option("TRIAL", options.choice.trial,
                     "Id of a trial, or the beginning of its key: only this one");
  command.add_option("--planner", options.choice.planner,
                     "Only trials of this planner, by its label");
  add_typed(command, "--png", options.png, "FILE",
            "Picture of TRIAL at the decisive moment: the last chance to stop before a collision; "
            "for a time-out, where it came nearest to the goal");
  add_what_if_options(command, options);
  add_replay_options(command, options.flights);
  add_output_options(command, options.output);
}

}  // namespace avoidbench
