#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/enum_text.hpp"
#include "store/database.hpp"

namespace avoidbench {

enum class TrialFormat { csv, jsonl };
template <>
struct EnumText<TrialFormat> {
  static constexpr std::pair<TrialFormat, std::string_view> entries[] = {
      {TrialFormat::csv, "csv"}, {TrialFormat::jsonl, "jsonl"}};
};

/// Writes the trials of `wanted` sweeps (as chosen_sweeps()) by `write`, a line a call: the columns
/// of the view trial_table, numbers with the fewest digits that read back to the same bits. What is
/// not defined is empty in CSV (RFC 4180, one header line) and null in JSON lines, where infinity
/// is null, too. Order: sweep, revision, planner, planner_key, map_key, mission_index, trial_key,
/// whatever the order of files and flights; a trial that several files have is written once. Rows
/// are held one a file. Throws InputError where the files have different columns.
void export_trials(std::span<const Database> databases, std::string_view wanted, TrialFormat format,
                   const std::function<void(const std::string&)>& write);

}  // namespace avoidbench
