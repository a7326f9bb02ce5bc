#include <stdexcept>

#include "avoidbench/planner.hpp"

/// Can fly one trial in a process, as a program that was written to run once.
namespace {

int resets = 0;

class GlobalState {
 public:
  static constexpr const char* name = "global_state";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | HOST_IS_TOLD;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;

  explicit GlobalState(const ab_setup&) {}
  void reset(const ab_mission&) {
    if (++resets > 1) throw std::runtime_error("the second trial of this process");
  }
  std::optional<ab_command> plan(const ab_observation&) { avoidbench::give_up("this far"); }
};

}  // namespace

AVOIDBENCH_PLANNER(GlobalState)
