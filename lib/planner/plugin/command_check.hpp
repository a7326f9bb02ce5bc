#pragma once

#include <cstdint>
#include <string>

#include "avoidbench/planner.h"

namespace avoidbench {

inline constexpr std::uint32_t kMostTrajectoryPoints = 10000;

/// No position, speed, acceleration, jerk, rate or angle beyond this, in SI units, is meant: a
/// thousand times what any vehicle does, and far from where the dynamics overflow.
inline constexpr double kMostOfCommand = 1e6;
/// The same of yaws and their rates: beyond it the tracker has no precise sine and cosine.
inline constexpr double kMostYaw = 1e5;

/// The name of one AB_COMMAND_… bit, "velocity", or its number.
std::string command_kind_text(std::uint32_t kind);

/// Why the host can't fly this command of a planner that declares the kinds `declared`; empty when
/// it can. Reads `points`.
std::string command_problem(const ab_command& command, std::uint32_t declared);

}  // namespace avoidbench
