#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "plugin/planner_instance.hpp"

namespace avoidbench {

/// What is wrong with a planner's table and its parameters: sizes, ABI number, names, bits,
/// pointers, ranges. One line each; empty when sound. Reads no further than struct_size says.
std::vector<std::string> table_problems(const ab_planner& table);

/// Throws InputError with all of them.
void require_sound_table(const std::filesystem::path& file, const ab_planner& table);

/// The table in the host's types, without `file` and `file_digest`. `table` has no problems.
PlannerDescription describe_table(const ab_planner& table);

/// What the planner says is wrong with it as it lies there (AB_CHECK_EXTENSION), "" for nothing.
/// Runs its code. `table` has no problems.
std::string own_problem(const ab_planner& table);

/// Whether the planner sees through cameras at all.
bool sees_images(std::uint32_t needs);

/// What the planner demands of cameras, for people: "one", "90° × 67.4° or more"; "" for nothing.
std::string camera_demand(const PlannerDescription& planner);

/// Why the planner can't fly with the sensor of this setup: it has nothing that the planner sees
/// through, or several cameras for one that handles one, or a camera of too narrow a view. "" where
/// it can.
std::string sensor_problem(const PlannerDescription& planner, const PlannerSetup& setup);

/// Whether it is a filter: it sees the command of the planner below (AB_INPUT_COMMAND).
bool is_filter(const PlannerDescription& planner);

/// Why this can't be flown by itself: it is a filter. "" where it can.
std::string filter_alone_problem(const PlannerDescription& planner);

/// Why commands of this planner can't pass through this filter: it is not a filter, or does not
/// take all of them. "" where they can.
std::string filter_problem(const PlannerDescription& filter, const PlannerDescription& planner);

/// The words of "safe|fast".
std::vector<std::string> choice_words(const std::string& choices);

}  // namespace avoidbench
