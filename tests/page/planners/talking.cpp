#include "avoidbench/planner.hpp"

/// Sees depth, stands where it is and says so once.
class Talking {
 public:
  static constexpr const char* name = "talking";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  Talking(const ab_setup&, const ab_host& host) : host_(&host) {}
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation& seen) {
    if (seen.time_s == 0.0) host_->log(host_->context, AB_LOG_INFO, "I stand");
    return avoidbench::make_velocity_command({0.0, 0.0, 0.0}, 0.0);
  }

 private:
  const ab_host* host_;
};

AVOIDBENCH_PLANNER(Talking)
