#include "avoidbench/planner.hpp"

/// Gives trajectories.
class Fast {
 public:
  static constexpr const char* name = "fast";
  static constexpr const char* summary = "Has no plan.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY | AB_COMMAND_TRAJECTORY;
  explicit Fast(const ab_setup&) {}
  void reset(const ab_mission&) {}
  static std::optional<ab_command> plan(const ab_observation&) { return std::nullopt; }
};
AVOIDBENCH_PLANNER(Fast)
