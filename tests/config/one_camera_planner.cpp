#include "avoidbench/planner.hpp"

/// Handles one camera of at least 80° × 60°.
class OneCamera {
 public:
  static constexpr const char* name = "one_camera";
  static constexpr const char* summary = "Hovers; sees one camera.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_ONE_CAMERA;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array least_fov_rad{1.3962634, 1.0471975};
  explicit OneCamera(const ab_setup&) {}
  void reset(const ab_mission&) {}
  static std::optional<ab_command> plan(const ab_observation&) { return std::nullopt; }
};
AVOIDBENCH_PLANNER(OneCamera)
