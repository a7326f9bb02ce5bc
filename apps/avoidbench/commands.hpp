#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace avoidbench {

/// Each adds one subcommand to `app`. Its work is done in the subcommand's callback, which throws
/// InputError for bad input and CLI::RuntimeError for an exit code of its own; main turns what is
/// thrown into an exit code.
void add_run_command(CLI::App& app);
void add_limit_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_power_command(CLI::App& app);
void add_predict_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_suite_command(CLI::App& app);
void add_grade_command(CLI::App& app);
void add_replay_command(CLI::App& app);
void add_explain_command(CLI::App& app);
void add_merge_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_planners_command(CLI::App& app);
void add_maps_command(CLI::App& app);
void add_sensors_command(CLI::App& app);
void add_metrics_command(CLI::App& app);
void add_config_command(CLI::App& app);
void add_help_command(CLI::App& app);
void add_completion_command(CLI::App& app);
void add_worker_command(CLI::App& app);    ///< hidden
void add_run_page_command(CLI::App& app);  ///< hidden

/// The words that start one of `jobs` workers. Without a limit of the user's, they stay together
/// within nine tenths of the memory that this process may use.
std::vector<std::string> worker_words(double plan_timeout_s, std::optional<double> memory_limit_mib,
                                      int jobs);

/// After so long without a sign of life a worker is ended: it has ended itself before, where a call
/// of its planner takes too long.
inline double silence_limit_s(double plan_timeout_s) { return plan_timeout_s + 20.0; }

/// The report of a database as Markdown, and its page.
void write_report_files(const std::string& database, const std::string& report,
                        const std::string& page);

/// Of `export`.
void add_export_mcap_command(CLI::App& export_command);

/// Of `maps`.
void add_maps_list_command(CLI::App& maps);
void add_maps_find_command(CLI::App& maps);

}  // namespace avoidbench
