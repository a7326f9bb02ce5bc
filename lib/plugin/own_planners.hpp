#pragma once

#include <filesystem>

#include "avoidbench/planner.h"

/// Planners of this process itself, which are in no library: a program that embeds these rooms, as
/// the Python package does, flies its own through the same checks as any other.
namespace avoidbench {

/// From now on `file`, wherever a planner's library may be named, is this planner. The file is what
/// the planner is written in: its digest is part of keys. `table` must live until the process ends
/// or the file is registered again. Throws InputError where the table is not sound.
void register_own_planner(const std::filesystem::path& file, const ab_planner& table);

/// The one registered for this file, or null.
const ab_planner* own_planner(const std::filesystem::path& file);

}  // namespace avoidbench
