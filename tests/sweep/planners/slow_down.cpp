#include <stdexcept>
#include <string>

#include "avoidbench/planner.hpp"

/// A filter that slows commands down, or fails in a way that it is told.
namespace {

struct Settings {
  double share = 0.0;
  std::string way;
};

class SlowDown {
 public:
  static constexpr const char* name = "slow_down";
  static constexpr const char* version = "2";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_COMMAND;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::parameter<&Settings::share>("share", "", 1.0, 0.0, 1.0, "Of the wanted speed."),
      avoidbench::choice_parameter<&Settings::way>(
          "way", "honest", "honest|no_plan|error|give_up|segfault", "What it does.")};

  explicit SlowDown(const ab_setup& setup)
      : settings_(avoidbench::settings_from(parameters, setup)) {}
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation& seen) const {
    if (settings_.way == "error") throw std::runtime_error("no solution");
    if (settings_.way == "give_up") avoidbench::give_up("too close");
    if (settings_.way == "segfault") *static_cast<volatile int*>(nullptr) = 1;
    if (settings_.way == "no_plan" || seen.wanted == nullptr) return std::nullopt;
    ab_command command = *seen.wanted;
    for (double& v : command.velocity_world_mps) v *= settings_.share;
    return command;
  }

 private:
  Settings settings_;
};

}  // namespace

AVOIDBENCH_PLANNER(SlowDown)
