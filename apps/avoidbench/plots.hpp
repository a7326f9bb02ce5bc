#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace avoidbench {

/// Draws the figures of papers (scripts/plot/paper_figures.py) from these databases into
/// `folder`/SWEEP/, as PDF and PNG; `sweep` as `avoidbench report --sweep`. Runs the first of
/// $AVOIDBENCH_PYTHON, python3 on the PATH and /usr/bin/python3 that has matplotlib and pandas.
/// Throws InputError where there is none (with what to install), or where the script fails.
void draw_plots(const std::vector<std::string>& databases, const std::string& sweep,
                const std::filesystem::path& folder);

}  // namespace avoidbench
