#include "avoidbench/planner.hpp"

/// A filter that takes positions and velocities.
class Careful {
 public:
  static constexpr const char* name = "careful";
  static constexpr const char* summary = "Lets commands pass.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_COMMAND;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY | AB_COMMAND_POSITION;
  static constexpr std::array parameters{
      avoidbench::parameter("margin_m", "m", 0.5, 0.0, 2.0, "Distance kept.")};
  explicit Careful(const ab_setup&) {}
  void reset(const ab_mission&) {}
  static std::optional<ab_command> plan(const ab_observation& seen) {
    if (seen.wanted == nullptr) return std::nullopt;
    return *seen.wanted;
  }
};
AVOIDBENCH_PLANNER(Careful)
