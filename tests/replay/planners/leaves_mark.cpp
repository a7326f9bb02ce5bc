#include <cstdio>
#include <cstdlib>

#include "avoidbench/planner.hpp"

/// Flies to the goal whatever is in its way, and writes a file where it is let.
class LeavesMark {
 public:
  static constexpr const char* name = "leaves_mark";
  static constexpr const char* version = "1";
  static constexpr const char* summary = "Writes a file when it is reset.";
  static constexpr std::uint32_t needs = AB_INPUT_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_POSITION;

  LeavesMark(const ab_setup&, const ab_host&) {}

  void reset(const ab_mission& mission) {
    mission_ = mission;
    const char* path = std::getenv("AVOIDBENCH_TEST_MARK");
    std::FILE* file = path != nullptr ? std::fopen(path, "w") : nullptr;
    if (file != nullptr) std::fclose(file);
  }

  std::optional<ab_command> plan(const ab_observation&) {
    ab_command command = avoidbench::make_command(AB_COMMAND_POSITION);
    for (int i = 0; i < 3; ++i) command.position_world_m[i] = mission_.goal_world_m[i];
    return command;
  }

 private:
  ab_mission mission_{};
};

AVOIDBENCH_PLANNER(LeavesMark)
