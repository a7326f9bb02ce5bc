#include "base/data_folder.hpp"
#include "base/number_text.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "export/flown_piece.hpp"
#include "page/flight_recording.hpp"
#include "replay/explained_trial.hpp"
#include "sweep/allowance.hpp"
#include "worker/worker.hpp"

namespace avoidbench {

void add_worker_command(CLI::App& app) {
  const auto [command, options] = add_command<WorkerOptions>(
      app, "worker", "Flies trials for a parent process", [](const WorkerOptions& told) {
        const int code = run_worker(told, {{kCauseLookout, cause_lookout},
                                           {kRecordingLookout, recording_lookout},
                                           {kPiecesLookout, pieces_lookout}});
        if (code != 0) throw CLI::RuntimeError(code);
      });
  command.group("");  // started by `run` only
  command.add_option("--plan-timeout", options.plan_timeout_s);
  command.add_option("--memory-limit", options.memory_limit_mib);
  command.add_option("--sandbox", options.sandbox);
  command.add_option("--allow", options.allowed);
  command.add_option("in_fd", options.in_fd)->required();
  command.add_option("out_fd", options.out_fd)->required();
  command.add_option("notes_fd", options.notes_fd)->required();
  command.add_option("journal_fd", options.journal_fd)->required();
}

std::vector<std::string> worker_words(double plan_timeout_s, std::optional<double> memory_limit_mib,
                                      int jobs) {
  const double limit_mib = memory_limit_mib.value_or(0.9 * allowed_memory_mib() / jobs);
  return {program_file().string(),  "worker",         "--plan-timeout",
          shortest(plan_timeout_s), "--memory-limit", shortest(limit_mib)};
}

}  // namespace avoidbench
