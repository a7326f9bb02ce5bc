#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "worker/worker.hpp"

namespace avoidbench {

void add_worker_command(CLI::App& app) {
  const auto options = std::make_shared<WorkerOptions>();
  CLI::App* command = app.add_subcommand("worker", "Flies trials for a parent process");
  command->group("");  // started by `run` only
  command->add_option("--plan-timeout", options->plan_timeout_s);
  command->add_option("--memory-limit", options->memory_limit_mib);
  command->add_option("--sandbox", options->sandbox);
  command->add_option("--allow", options->allowed);
  command->add_option("in_fd", options->in_fd)->required();
  command->add_option("out_fd", options->out_fd)->required();
  command->add_option("notes_fd", options->notes_fd)->required();
  command->add_option("journal_fd", options->journal_fd)->required();
  command->callback([options] {
    const int code = run_worker(*options);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace avoidbench
