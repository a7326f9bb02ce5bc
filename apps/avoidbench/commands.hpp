#pragma once

#include <CLI/CLI.hpp>

namespace avoidbench {

/// Each adds one subcommand to `app`. Its work is done in the subcommand's callback, which throws
/// InputError for bad input; main turns what is thrown into an exit code.
void add_report_command(CLI::App& app);

}  // namespace avoidbench
