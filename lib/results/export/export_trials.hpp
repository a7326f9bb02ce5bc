#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/enum_text.hpp"
#include "export/trial_list.hpp"
#include "store/database.hpp"

namespace avoidbench {

enum class TrialFormat { csv, jsonl };
template <>
struct EnumText<TrialFormat> {
  static constexpr std::pair<TrialFormat, std::string_view> entries[] = {
      {TrialFormat::csv, "csv"}, {TrialFormat::jsonl, "jsonl"}};
};

/// Writes the trials of `wanted` sweeps (as chosen_sweeps()) by `write`, a line a call: the columns
/// of the view trial_table, without those of obstacles where all maps come from files, with one for
/// each thing that these sweeps vary, numbers with the fewest digits that read back to the same
/// bits. What is not defined is empty in CSV (RFC 4180, one header line) and null in JSON lines,
/// where infinity is null, too. Order: sweep, revision, planner, planner_key, map_key,
/// mission_index, trial_key, whatever the order of files and flights, unless `trial_order` sorts by
/// a column; a trial that several files have is written once, and trial_id, which is of one file,
/// is then left out. Rows are held one per file, and all of them where they are sorted. Throws
/// InputError where the files have different columns or none of them is to be sorted by.
void export_trials(std::span<const Database> databases, std::string_view wanted, TrialFormat format,
                   const std::function<void(const std::string&)>& write,
                   const TrialOrder& trial_order = {});

}  // namespace avoidbench
