#include "avoidbench/planner.hpp"

namespace {

/// Is given depth images, looks at one pixel, and flies ahead: a call costs next to nothing.
class TakesDepth {
 public:
  static constexpr const char* name = "takes_depth";
  static constexpr const char* version = "1";
  static constexpr const char* summary = "Is given depth images and flies ahead.";
  static constexpr std::uint32_t needs = AB_SEES_STATE | AB_SEES_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;

  explicit TakesDepth(const ab_setup&) {}
  void reset(const ab_mission&) {}
  static std::optional<ab_command> plan(const ab_observation& seen) {
    const ab_depth_image* image = avoidbench::newest_depth(seen, 0);
    const bool is_free = image == nullptr || image->depth_m[0] > 0.0F;
    return avoidbench::make_velocity_command({is_free ? 1.0 : 0.0, 0.0, 0.0}, 0.0);
  }
};

}  // namespace

AVOIDBENCH_PLANNER(TakesDepth)
