#include <sys/utsname.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "metrics/metric_table.hpp"
#include "render/device.hpp"
#include "store/database.hpp"
#include "sweep/allowance.hpp"
#include "sweep/run_sweep.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

constexpr int kExitStopped = 75, kExitInterrupted = 130;

struct RunCommand {
  std::string sweep_file;
  std::vector<std::string> overrides;
  std::string database_file;
  int jobs = 0;
  double plan_timeout_s = 10.0, grace_s = 30.0;
  double memory_limit_mib = 0.0;
  bool dry_run = false, in_process = false, quiet = false;
};

std::atomic<bool> stop_requested{false};
std::atomic<int> stop_signal{0};

void request_stop(int signal_number) {
  if (stop_requested.exchange(true)) ::_exit(128 + signal_number);  // asked twice: at once
  stop_signal = signal_number;
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// The words this process was started with.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline");
  std::string line;
  for (std::string word; std::getline(file, word, '\0');) line += (line.empty() ? "" : " ") + word;
  return line;
}

RunRow provenance() {
  utsname system{};
  ::uname(&system);
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char time_text[32];
  std::strftime(time_text, sizeof time_text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {.started_at = time_text,
          .program_version = kVersion,
          .git_hash = kGitHash,
          .compiler = kCompiler,
          .flags = kCompilerFlags,
          .host = system.nodename,
          .cpu = cpu_model(),
          .isa = embree::ray_tracing_isa(),
          .command_line = command_line()};
}

std::string duration_text(double duration_s) {
  char text[32];
  const int whole_s = static_cast<int>(duration_s);
  if (whole_s >= 3600) {
    std::snprintf(text, sizeof text, "%d h %02d min", whole_s / 3600, whole_s / 60 % 60);
  } else if (whole_s >= 60) {
    std::snprintf(text, sizeof text, "%d min %02d s", whole_s / 60, whole_s % 60);
  } else {
    std::snprintf(text, sizeof text, "%.0f s", duration_s);
  }
  return text;
}

/// Draws progress on stderr: one live line on a terminal, else a line each tenth of the way.
class ProgressLine {
 public:
  explicit ProgressLine(bool is_quiet)
      : is_quiet_(is_quiet), is_live_(::isatty(STDERR_FILENO) == 1) {}

  void draw(const Progress& progress) {
    if (is_quiet_) return;
    const std::int64_t due = progress.total - progress.invalid_missions;
    const auto now = std::chrono::steady_clock::now();
    const bool is_last = progress.done >= due;
    const std::int64_t tenth = due > 0 ? 10 * progress.done / due : 10;
    const bool is_due =
        is_live_ ? is_last || now - drawn_ > std::chrono::milliseconds(200) : tenth > tenth_;
    if (!is_due) return;
    drawn_ = now;
    tenth_ = tenth;
    const double elapsed_s = std::chrono::duration<double>(now - began_).count();
    const auto flown = static_cast<double>(progress.done - progress.done_before);
    std::string line = std::to_string(progress.done) + "/" + std::to_string(due) + " trials";
    if (flown > 0 && !is_last) {
      line += ", " + duration_text(elapsed_s / flown * static_cast<double>(due - progress.done)) +
              " left";
    } else if (is_last) {
      line += " in " + duration_text(elapsed_s);
    }
    for (const auto& [label, planner] : progress.planners) {
      line += " | " + label + " " + std::to_string(planner.reached_goal) + "/" +
              std::to_string(planner.flown);
    }
    std::fprintf(stderr, is_live_ ? "\r\033[K%s%s" : "%s%s", line.c_str(),
                 is_live_ && !is_last ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  bool is_quiet_, is_live_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), drawn_{};
  std::int64_t tenth_ = -1;
};

std::string program_file() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

/// What starts a worker. Without a limit of the user's, workers together stay within nine tenths of
/// the memory that this process may use.
std::vector<std::string> worker_command(const RunCommand& command, int jobs) {
  const double limit_mib =
      command.memory_limit_mib > 0.0 ? command.memory_limit_mib : 0.9 * allowed_memory_mib() / jobs;
  char timeout[32], limit[32];
  std::snprintf(timeout, sizeof timeout, "%.17g", command.plan_timeout_s);
  std::snprintf(limit, sizeof limit, "%.17g", limit_mib);
  return {program_file(), "worker", "--plan-timeout", timeout, "--memory-limit", limit};
}

void print_trials(const SweepSpec& sweep) {
  const std::vector<TrialSpec> trials = expand(sweep);
  for (const TrialSpec& trial : trials) {
    std::cout << trial_key(trial).substr(0, 12) << "  map " << map_key(trial).substr(0, 12)
              << " seed " << trial.map_seed << "  mission " << trial.mission_index << "  "
              << trial.planner.label << '\n';
  }
  std::cerr << trials.size() << " trials\n";
}

void warn(const RunCommand& command, const SweepSpec& sweep, int jobs) {
  if (sweep.trials < 10) {
    std::cerr << "warning: " << sweep.trials
              << " trials a map: success rates of single maps are too coarse to compare\n";
  }
  if (jobs > allowed_cpus()) {
    std::cerr << "warning: " << jobs << " workers on " << allowed_cpus()
              << " CPUs: processing times will be too long (results do not change)\n";
  }
  if (command.in_process) {
    std::cerr << "warning: --in-process: a planner's crash ends the run\n";
  }
}

void run(const RunCommand& command) {
  const SweepSpec sweep = read_sweep(command.sweep_file, command.overrides);
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  if (command.dry_run) return print_trials(sweep);
  const int jobs = command.jobs > 0 ? command.jobs : allowed_cpus();
  std::filesystem::path file = command.database_file;
  if (file.empty()) {
    std::filesystem::create_directories("results");
    file = "results/" + sweep.name + ".db";
  }
  Database database = Database::open_for_run(file, metric_table());
  warn(command, sweep, jobs);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  std::signal(SIGUSR1, request_stop);
  ProgressLine line(command.quiet);
  const RunSummary summary =
      run_sweep(sweep, provenance(), database,
                {.jobs = jobs,
                 .in_process = command.in_process,
                 .worker_command = worker_command(command, jobs),
                 .silence_s = command.plan_timeout_s + 20.0,
                 .grace_s = command.grace_s,
                 .on_progress = [&line](const Progress& progress) { line.draw(progress); },
                 .stop = &stop_requested});
  const Progress& progress = summary.progress;
  if (progress.done_before > 0) {
    std::cerr << progress.done_before << " trials were there already\n";
  }
  if (progress.invalid_missions > 0) {
    std::cerr << progress.invalid_missions
              << " trials have an invalid mission (no free start or goal, or no way between them) "
                 "and are not flown\n";
  }
  if (summary.is_stopped) {
    std::cerr << "stopped; run the same command again to go on\n";
    throw CLI::RuntimeError(stop_signal == SIGINT ? kExitInterrupted : kExitStopped);
  }
  std::cerr << "results are in " << file.string() << "; to see them: avoidbench report "
            << file.string() << '\n';
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<RunCommand>();
  CLI::App* command =
      app.add_subcommand("run", "Fly a sweep's trials and store them in a database");
  command->add_option("sweep", options->sweep_file, "Sweep file (YAML)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "--set", options->overrides,
          "Override one value of the sweep file, as in maps.poisson_radius_m=3.0; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command->add_option("-o,--db", options->database_file, "Database file [results/<sweep name>.db]")
      ->type_name("FILE");
  command->add_option("-j,--jobs", options->jobs, "Worker processes; 0: one per allowed CPU")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--plan-timeout", options->plan_timeout_s,
                   "Wall time after which a plan call counts as hung, s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--memory-limit", options->memory_limit_mib,
                   "Resident memory of a worker, MiB; its trial ends with planner_crashed beyond "
                   "it [nine tenths of what there is, shared by the workers]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--grace", options->grace_s,
                   "Time that trials in flight have after a signal to stop, s")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--dry-run", options->dry_run, "Print the trials and fly none");
  command->add_flag("--in-process", options->in_process, "Fly in this process, for debuggers");
  command->add_flag("-q,--quiet", options->quiet, "No progress on stderr");
  command->footer(
      "The same sweep gives the same rows for any number of workers. Trials that the database has "
      "are skipped, so the\n"
      "same command goes on where it was stopped.\n\n"
      "Examples:\n"
      "  avoidbench run configs/sweeps/quick.yaml\n"
      "  avoidbench run configs/sweeps/forest_small.yaml --set trials=20 --db forest.db --jobs "
      "2\n\n"
      "Exit codes: 0 done, 2 usage or input, 75 stopped by SIGTERM or SIGUSR1, 130 interrupted");
  command->callback([options] { run(*options); });
}

}  // namespace avoidbench
