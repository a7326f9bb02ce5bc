#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plugin/planner_library.hpp"

namespace avoidbench {

/// What is wrong with a planner's table and its parameters: sizes, ABI number, names, bits,
/// pointers, ranges. One line each; empty when sound. Reads no further than struct_size says.
std::vector<std::string> table_problems(const ab_planner& table);

/// Throws InputError with all of them.
void require_sound_table(const std::filesystem::path& file, const ab_planner& table);

/// The table in the host's types, without `file` and `file_digest`. `table` has no problems.
PlannerDescription describe_table(const ab_planner& table);

/// The words of "safe|fast".
std::vector<std::string> choice_words(const std::string& choices);

}  // namespace avoidbench
