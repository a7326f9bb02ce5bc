#include <iostream>

#include "base/kept_files.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "metrics/metric_table.hpp"
#include "store/merge.hpp"

namespace avoidbench {
namespace {

constexpr int kExitIncomplete = 1;

struct MergeCommand {
  std::string into;
  std::vector<std::string> from;
  bool must_be_complete = false;
};

/// Prints what each sweep lacks; whether all are complete.
bool print_completeness(const Database& database) {
  bool is_complete = true;
  for (const SweepCompleteness& sweep : sweep_completeness(database)) {
    std::cout << "sweep " << visible_line(sweep.name);
    if (sweep.revision > 1) std::cout << " (revision " << sweep.revision << ")";
    std::cout << ": " << sweep.flown << " of " << counted(sweep.wanted, "trial");
    if (sweep.flown < sweep.wanted) {
      is_complete = false;
      std::cout << ", " << sweep.wanted - sweep.flown << " missing";
      for (std::size_t i = 0; i < sweep.lost_shards.size(); ++i) {
        std::cout << (i == 0 ? "; no trials of shard " : ", ") << sweep.lost_shards[i];
      }
    }
    std::cout << '\n';
  }
  return is_complete;
}

void merge(const MergeCommand& command) {
  // Before the first row moves: every file is there and one of ours.
  for (const std::string& file : command.from) Database::open_for_reading(file);
  Database into = Database::open_for_run(command.into, metric_table());
  for (const std::string& file : command.from) {
    const MergeResult result = merge_database(into, file);
    std::cout << file << ": " << counted(result.trials, "trial") << ", " << result.new_trials
              << " new\n";
    for (const std::string& problem : merge_kept_files(command.into, file)) {
      std::cerr << "warning: a kept file is not copied: " << problem << '\n';
    }
  }
  const bool is_complete = print_completeness(into);
  if (!is_complete) {
    std::cerr << "to fly what is missing: avoidbench run SWEEP.yaml --db " << command.into << '\n';
    if (command.must_be_complete) throw CLI::RuntimeError(kExitIncomplete);
  }
}

}  // namespace

void add_merge_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "merge", "Merge databases, such as those of shards, into one", merge);
  command.add_option("OUT", options.into, "Database to merge into; created if it does not exist")
      ->required();
  command.add_option("DB", options.from, "Databases to read; they are not changed")->required();
  command.add_flag("--complete", options.must_be_complete,
                   "Exit code 1 if trials of a sweep are missing");
  command.footer(
      "Existing rows stay: merging twice, or in another order, gives the same database. If two "
      "files have different results\n"
      "for a trial, that is an error, and nothing of that file is merged.\n\n"
      "Example:\n"
      "  avoidbench run sweep.yaml --shard 1/3 --db a.db     # on three machines\n"
      "  avoidbench merge all.db a.db b.db c.db");
}

}  // namespace avoidbench
